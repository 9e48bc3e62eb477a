// Records commands into a caller's command buffer. The only place that names pipeline stages and barriers.
#pragma once

#include "sinew/export.hpp"
#include "sinew/vk/kernel.hpp"

namespace sinew::vk {

/// A thin view of a recording VkCommandBuffer; owns nothing, never throws.
class SINEW_API Commands {
public:
    Commands(const Device& device, VkCommandBuffer commands) noexcept;

    /// Binds pipeline and set; both stay bound until the next call. Skips what is bound already.
    void bind(const Kernel& kernel, VkDescriptorSet set) noexcept;
    /// `size` <= the kernel's push constant block; multiple of 4 [B].
    void push(const Kernel& kernel, const void* bytes, std::uint32_t size) noexcept;
    void dispatch(std::uint32_t groupsX) noexcept;
    /// Dispatches the group counts in element `index` of `arguments` (three uint32 at its start). The buffer
    /// must have VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT and a stride that is a multiple of 4 and at least 12
    /// [B].
    void dispatchIndirect(const BufferView& arguments, std::uint32_t index) noexcept;
    void fill(const BufferView& target, std::uint32_t value) noexcept;
    void copy(const BufferView& from, const BufferView& to) noexcept; ///< sizes must agree
    void update(const BufferView& target, const void* bytes,
                VkDeviceSize size) noexcept; ///< in commands of up to 65,536 bytes

    /// Orders compute shaders recorded so far, and what else `scope` names, before compute shaders after and
    /// what else it names: one memory barrier. Barriers chain through compute shaders, which all of them
    /// name.
    void barrier(BarrierScope scope = {}) noexcept;
    /// Goes on in another command buffer, submitted later to the same queue: nothing is bound there.
    void continueIn(VkCommandBuffer commands) noexcept;
    /// Opens a step: waits for earlier reads by vertex input, vertex shaders, transfer and compute of this
    /// queue.
    void beginStep() noexcept;
    /// Closes a step: makes all writes visible to indirect, index and vertex fetch, vertex and compute
    /// shaders, and transfers. Leaves out stages that the queue family lacks.
    void endStep() noexcept;
    /// endStep() that makes all writes visible to the host too: the host sees writes of commands recorded
    /// later no sooner than these.
    void endStepForHost() noexcept;
    /// Makes transfer and compute writes visible to the host; validation layers do not report a missing one.
    void hostBarrier() noexcept;

    void beginLabel(const char* label) noexcept; ///< does nothing without VK_EXT_debug_utils
    void endLabel() noexcept;
    void resetTimestamps(VkQueryPool pool, std::uint32_t count) noexcept;
    void timestamp(VkQueryPool pool, std::uint32_t index) noexcept; ///< after all earlier work

    VkCommandBuffer handle() const noexcept { return commands_; }

private:
    void endStep(VkPipelineStageFlags moreStages, VkAccessFlags moreAccess) noexcept;
    void memoryBarrier(VkPipelineStageFlags from, VkAccessFlags written, VkPipelineStageFlags to,
                       VkAccessFlags access) noexcept;
    const DeviceFunctions* functions_;
    VkPipelineStageFlags
        allStages_; ///< stages of a step and of its readers, as far as the queue family has them
    VkCommandBuffer commands_;
    VkPipeline boundPipeline_ = VK_NULL_HANDLE;
    VkDescriptorSet boundSet_ = VK_NULL_HANDLE;
};

} // namespace sinew::vk
