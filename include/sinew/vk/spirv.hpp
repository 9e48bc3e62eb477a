// Reads a kernel's interface from its SPIR-V 1.5: bindings with access and stride, push constants, group
// size. Pure: includes no Vulkan header, so that sim/program can plan barriers from it without a device.
#pragma once

#include "sinew/export.hpp"
#include "sinew/vk/shader_code.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace sinew::vk {

enum class Access : std::uint8_t { read = 1, write = 2, readWrite = 3 };

/// Kinds of work that a barrier orders besides compute shaders before it and after it: transfers (fills,
/// copies, updates) before it, and transfers and reads of the arguments of indirect dispatches after it.
struct BarrierScope {
    bool afterTransfers = true, beforeTransfers = true, beforeArguments = true;
    bool operator==(const BarrierScope&) const = default;
};

/// Kind of a binding. `uniform`: a block with equal values for all invocations, never written; software
/// devices read it once a group, not once a lane. At most 16 KiB, which every device allows. `texels`: a
/// samplerBuffer (float32) or usamplerBuffer (uint32): a storage buffer read element by element through the
/// texture path, which some devices gather from faster. Its elements have 4 or 8 bytes, or a multiple of 16,
/// of which a texel is 16.
enum class BlockKind : std::uint8_t { storage, uniform, texels };

/// Binding n + texelTwins holds texels of the storage block with binding n: one buffer that a kernel reads in
/// either way (shaders/glsl/common/fetched.glsl).
constexpr std::uint32_t texelTwins = 32;
/// Bindings from here to the twins need not follow the one before them: RECEIVED_BINDING and those after it
/// in shaders/glsl/common/bindings.h.
constexpr std::uint32_t firstLoose = 26;

struct SINEW_API KernelBinding {
    std::uint32_t binding = 0;
    std::string name;                  ///< the block's name in GLSL, such as "Positions"
    Access access = Access::readWrite; ///< from readonly / writeonly, the only declaration of access
    /// [B]: of the run-time array, or the size of a fixed struct rounded up to its std430 alignment; 0 for
    /// texels, whose kernels declare none
    std::uint32_t stride = 0;
    BlockKind kind = BlockKind::storage;
    bool isFloat = false; ///< texels: float32, else uint32
    /// True if decorated Aliased: its buffer may be bound to another such binding too, even if one of both
    /// writes it.
    bool isAliased = false;

    /// True if this reads the buffer of another binding, `binding - texelTwins`, as texels.
    bool isTwin() const { return binding >= texelTwins; }
    /// True if a buffer with elements of `bytes` may be bound here.
    bool takes(std::uint32_t bytes) const {
        if (kind != BlockKind::texels) return bytes == stride;
        return bytes == 4 || bytes == 8 || (bytes > 0 && bytes % 16 == 0);
    }
    /// Number of texels in a buffer of `bytes`, with elements of `elementBytes`, a size that takes() accepts.
    static std::uint64_t texelsIn(std::uint64_t bytes, std::uint32_t elementBytes) {
        return bytes / std::min(elementBytes, 16u);
    }
};

struct SINEW_API SpecialisationConstant {
    std::uint32_t id = 0, value = 0; ///< bools and floats are passed as their 32 bits
};

struct SINEW_API KernelInterface {
    std::vector<KernelBinding> bindings;             ///< descriptor set 0, sorted; no gaps below firstLoose
    std::uint32_t pushConstantSize = 0;              ///< [B], rounded up to the block's std430 alignment
    std::array<std::uint32_t, 3> groupSize{1, 1, 1}; ///< with the values of the specialisation constants
    /// The specialisation constant for a dimension of the group size; empty = fixed.
    std::array<std::optional<std::uint32_t>, 3> groupSizeIds;
    std::vector<std::uint32_t> specialisationIds; ///< sorted
    std::uint32_t sharedMemory = 0;               ///< [B], workgroup storage; as specialised

    bool hasConstant(std::uint32_t id) const { return std::ranges::binary_search(specialisationIds, id); }
};

/// The SPIR-V of `code`. Throws std::runtime_error with the shader's name if its packed bytes are damaged.
SINEW_API std::vector<std::uint32_t> wordsOf(const ShaderCode& code);

/// Reads the interface of `code`. `constants` replace the defaults in the module; unknown ids are ignored.
/// Throws std::runtime_error with the shader's name if the module breaks a rule: a set other than 0, a gap in
/// the bindings, anything but buffers, a block of fixed members and a run-time array, a row-major matrix, a
/// capability that is an optional feature, an unknown opcode in a type, a truncated module.
SINEW_API KernelInterface readInterface(const ShaderCode& code,
                                        std::span<const SpecialisationConstant> constants = {});

} // namespace sinew::vk
