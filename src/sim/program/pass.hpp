// A pass of a step: buffers, kernels, and how a dispatch knows its groups, without Vulkan handles.
#pragma once

#include "sinew/vk/spirv.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#pragma push_macro("interface") // windows.h defines it
#undef interface

namespace sinew::sim {

struct BufferId {
    std::uint32_t index = 0xffffffffu;
    bool operator==(const BufferId&) const = default;
};

/// Leaves a binding empty: that of a feature which the constants of a dispatch switch off.
inline constexpr BufferId unbound{0xfffffffeu};
/// The buffer, or none.
constexpr BufferId boundIf(bool isBound, BufferId buffer) {
    return isBound ? buffer : unbound;
}

struct BufferSpec {
    std::string label;
    std::uint64_t count = 0;        ///< elements
    std::uint32_t stride = 0;       ///< [B]
    std::vector<std::byte> initial; ///< count x stride bytes, or empty = zeros
    /// Index of another buffer: this one has no memory of its own but reads that one's initial contents, as
    /// resets copy them.
    std::optional<std::uint32_t> initialOf = {};
    std::uint64_t bytes() const { return initialOf ? 0 : count * stride; }
};

struct BufferUse {
    BufferId buffer;
    vk::Access access = vk::Access::readWrite;
    std::uint32_t binding = 0; ///< of a dispatch: the binding of the kernel
};

/// A kernel with the specialisation constants that make it a pipeline.
struct KernelUse {
    const vk::ShaderCode* code = nullptr;
    vk::KernelInterface interface;
    std::map<std::uint32_t, std::uint32_t> constants; ///< specialisation id -> 32 bits
};

enum class PassKind : std::uint8_t {
    dispatch,
    fill,   ///< sets every word of uses[0] to `value`
    copy,   ///< uses[0] to uses[1], whole buffers of equal size
    update, ///< writes the host's data of this step into uses[0]; `value` says which of HostData
};

/// Host data that update passes can write.
enum class HostData : std::uint32_t {
    parameters,
    anchors,
    colliders,
    hostColliders,
    hostColliderArguments,
    grabs,
    blade,
    bladePoints,
    fields,
    fieldArguments,
    motions,
    motionArguments
};
constexpr std::size_t hostDataCount = 12;

/// One of the ways to record a step, each with its own barriers.
struct Recording {
    bool hasBlade = true; ///< with the passes of cuts
    bool isCalm = false;  ///< without passes that rebuild contact lists after the first substep
    constexpr std::size_t index() const { return std::size_t{!hasBlade} + 2 * std::size_t{isCalm}; }
};
constexpr std::size_t recordingCount = 4;
constexpr std::array<Recording, recordingCount> allRecordings{
    {{true, false}, {false, false}, {true, true}, {false, true}}};
/// Steps without a blade: one that may rebuild contact lists in any substep, and a calm one.
constexpr Recording plainStep{.hasBlade = false, .isCalm = false},
    calmStep{.hasBlade = false, .isCalm = true};

/// The steps that record a pass.
enum class When : std::uint8_t {
    always,
    cut,     ///< only those with a blade
    surface, ///< these too; the pass rewrites the surface of cuts from the state of cells
};

/// An entry of a pass list.
struct Pass {
    PassKind kind = PassKind::dispatch;
    std::string label;
    std::uint32_t kernel = 0; ///< index into StepProgram::kernels (dispatch)
    std::uint32_t items = 0;  ///< invocations wanted (dispatch); the maximum if indirect
    /// In binding order, without bindings of a feature that is off and without texel twins; then the
    /// arguments of an indirect dispatch.
    std::vector<BufferUse> uses;
    std::vector<std::byte> push;
    std::uint32_t value = 0;
    bool isIndirect = false;   ///< groups come from the device: element `value` of the last use
    std::uint32_t phase = 0;   ///< index into StepProgram::phases
    std::uint32_t substep = 0; ///< 1-based; 0 = outside the substeps
    When when = When::always;
    bool isOfCut() const { return when != When::always; }
    bool isOfLists = false; ///< rebuilds contact lists after the first substep: not in a calm step
    /// By Recording, set by planBarriers: whether a barrier precedes the pass, and what it orders.
    std::array<bool, recordingCount> barriers{};
    std::array<vk::BarrierScope, recordingCount> scopes{};
};

/// Whether `pass` is part of a recording, and whether it is and a barrier precedes it.
inline bool isIn(Recording recording, const Pass& pass) {
    return (recording.hasBlade || !pass.isOfCut()) && (!recording.isCalm || !pass.isOfLists);
}
inline bool hasBarrier(Recording recording, const Pass& pass) {
    return isIn(recording, pass) && pass.barriers[recording.index()];
}

/// The uses of a dispatch other than its arguments.
inline std::span<const BufferUse> boundUses(const Pass& pass) {
    return std::span(pass.uses).first(pass.uses.size() - (pass.isIndirect ? 1 : 0));
}

/// Location of the group count that a kernel writes for a later dispatch: an element of a buffer of
/// layout::DispatchArguments. With 0 groups the device skips the pass at almost no cost.
struct IndirectItems {
    BufferId arguments;
    std::uint32_t element = 0;
    std::uint32_t most = 0; ///< largest number of invocations that the arguments can ask for
    bool isOfLists = false; ///< 0 groups unless contact lists are rebuilt
};

/// A list of items, whole work groups, out of `all`; 0 items = there is none.
struct Slots {
    BufferId list{};
    std::uint32_t items = 0, all = 0;
};

/// Replacement of a direct dispatch by an indirect one: its groups, and the list of groups that run.
struct IndirectForm {
    IndirectItems items;
    BufferId listed; ///< groups that run; invalid = all
};

} // namespace sinew::sim

#pragma pop_macro("interface")
