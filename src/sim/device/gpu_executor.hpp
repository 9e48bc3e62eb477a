// Executor of a StepProgram: creates buffers, pipelines and descriptor sets once, then records any number of
// times.
#pragma once

#include "sim/device/output_use.hpp"
#include "sim/program/program.hpp"
#include "sinew/vk/commands.hpp"
#include "sinew/vk/kernel_store.hpp"
#include "sinew/vk/timestamps.hpp"

#include <map>
#include <optional>

namespace sinew::sim {

/// Throws vk::Error if a dispatch has more than `most` groups, with both figures.
void requireGroups(const vk::Kernel& kernel, std::uint32_t groups, std::uint32_t most);

/// Owns every device object of one program. Must not outlive the Device or the program.
class GpuExecutor {
public:
    /// Creates everything; throws vk::Error naming the buffer or kernel. Submits nothing: upload() fills the
    /// buffers. `use` is that of the outputs.
    GpuExecutor(const vk::Device& device, const StepProgram& program, const OutputUse& use = {});

    /// Records the copies that put every buffer into its initial state (also a reset). Ends with a barrier.
    void upload(vk::Commands& commands) noexcept;
    /// Writes the initial state from the host into all buffers whose memory it sees; uploadRest() records the
    /// copies for the others. Returns whether there are none. On any thread, before anything else is
    /// recorded.
    bool fill() noexcept;
    /// Records copies for the next `most` bytes of the buffers that fill() left, without a barrier. Returns
    /// whether none is left. `most`: a multiple of 4 [B].
    bool uploadRest(vk::Commands& commands, VkDeviceSize most) noexcept;
    /// Host data of update passes, by HostData.
    using HostBytes = std::array<std::span<const std::byte>, hostDataCount>;
    /// Records the passes of a step with the planned barriers. `timestamps` receives one span per phase. Goes
    /// on in the buffers of `later`, at barriers, so that each has about as many passes as the first, and
    /// ends in the last of them.
    void step(vk::Commands& commands, std::span<const VkCommandBuffer> later, const HostBytes& host,
              vk::Timestamps* timestamps, Recording recording = {}) noexcept;
    /// Records the passes of a list other than the step.
    void record(vk::Commands& commands, List list) noexcept;
    /// Copies a buffer's initial contents into it, if it has some.
    void restore(vk::Commands& commands, BufferId buffer) noexcept;
    /// Replaces a buffer's initial contents by `contents`, of equal size; the buffer itself changes too
    /// unless it `isOfState`.
    void replace(vk::Commands& commands, BufferId buffer, const vk::BufferView& contents,
                 bool isOfState) noexcept;
    /// Records only those passes of a step that write the surface of cuts.
    void surface(vk::Commands& commands) noexcept;

    vk::BufferView view(BufferId buffer) const noexcept;                ///< empty for an invalid id
    const std::byte* mapped(const vk::BufferView& view) const noexcept; ///< Simulation::mapped
    /// Phases of the step list that contain a pass, in order: the spans of `timestamps`.
    const std::vector<std::uint32_t>& timedPhases() const noexcept { return timedPhases_; }

private:
    // A pass with all lookups done, so that recording is a plain loop.
    struct Recorded {
        PassKind kind;
        std::array<bool, recordingCount> isIn, hasBarrier; // by Recording
        std::array<vk::BarrierScope, recordingCount> scopes;
        When when;
        bool isIndirect;
        std::uint32_t phase, groups, value;
        const vk::Kernel* kernel;
        VkDescriptorSet set;
        const std::vector<std::byte>* push;
        vk::BufferView first, second; // the first of an indirect dispatch is its arguments
    };
    std::vector<Recorded> resolve(const std::vector<Pass>& passes, std::size_t& nextSet) const;
    static void checkGroups(const std::vector<Recorded>& passes, std::uint32_t most);
    void record(vk::Commands& commands, std::span<const VkCommandBuffer> later,
                const std::vector<Recorded>& passes, const HostBytes& host, vk::Timestamps* timestamps,
                Recording recording = {}) noexcept;
    void recordPass(vk::Commands& commands, const Recorded& pass, const HostBytes& host) noexcept;
    const vk::Buffer* stagingOf(BufferId buffer) const noexcept;

    std::vector<vk::Buffer> buffers_;
    std::vector<std::pair<std::uint32_t, vk::BufferView>>
        unfilled_;                                              // buffer index, what uploadRest() records
    std::optional<vk::Buffer> empty_;                           // for bindings that a dispatch leaves empty
    std::vector<std::pair<std::uint32_t, vk::Buffer>> staging_; // buffer index, its initial contents
    std::map<std::uint32_t, std::uint32_t> initialOf_;          // BufferSpec::initialOf, by buffer
    std::vector<std::shared_ptr<const vk::Kernel>> kernels_;
    std::vector<vk::BindingSets> sets_;
    std::vector<std::size_t> setOfPass_;
    std::array<std::vector<Recorded>, listCount> lists_; // by List
    std::vector<std::uint32_t> timedPhases_;
};

} // namespace sinew::sim
