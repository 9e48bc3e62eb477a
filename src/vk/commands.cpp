// All pipeline stages and access masks of the core. Synchronisation 1, since Vulkan 1.2 has no other without
// an optional feature (docs/performance/drivers.md has what it would change); global memory barriers,
// since a planned barrier covers several buffers.
#include "sinew/vk/commands.hpp"

#include <algorithm>
#include <cassert>
#include <cstddef>

namespace sinew::vk {

namespace {

constexpr VkPipelineStageFlags shaderStage = VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT;
constexpr VkPipelineStageFlags writerStages = shaderStage | VK_PIPELINE_STAGE_TRANSFER_BIT;
constexpr VkPipelineStageFlags stepStages = writerStages | VK_PIPELINE_STAGE_DRAW_INDIRECT_BIT;
constexpr VkPipelineStageFlags drawingStages =
    VK_PIPELINE_STAGE_VERTEX_INPUT_BIT | VK_PIPELINE_STAGE_VERTEX_SHADER_BIT;
constexpr VkAccessFlags writeAccess = VK_ACCESS_SHADER_WRITE_BIT | VK_ACCESS_TRANSFER_WRITE_BIT;
constexpr VkAccessFlags shaderAccess =
    VK_ACCESS_SHADER_WRITE_BIT | VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_UNIFORM_READ_BIT;
constexpr VkAccessFlags transferAccess = VK_ACCESS_TRANSFER_WRITE_BIT | VK_ACCESS_TRANSFER_READ_BIT;
constexpr VkAccessFlags stepAccess = shaderAccess | transferAccess | VK_ACCESS_INDIRECT_COMMAND_READ_BIT;
constexpr VkAccessFlags drawingAccess = VK_ACCESS_INDEX_READ_BIT | VK_ACCESS_VERTEX_ATTRIBUTE_READ_BIT;

} // namespace

Commands::Commands(const Device& device, VkCommandBuffer commands) noexcept
    : functions_(&device.functions()),
      allStages_((device.queueFlags() & VK_QUEUE_GRAPHICS_BIT) != 0 ? stepStages | drawingStages
                                                                    : stepStages),
      commands_(commands) {}

void Commands::bind(const Kernel& kernel, VkDescriptorSet set) noexcept {
    const bool isOtherPipeline = kernel.pipeline() != boundPipeline_;
    if (isOtherPipeline)
        functions_->vkCmdBindPipeline(commands_, VK_PIPELINE_BIND_POINT_COMPUTE, kernel.pipeline());
    if (isOtherPipeline || set != boundSet_) // another pipeline's layout may have disturbed the set
        functions_->vkCmdBindDescriptorSets(commands_, VK_PIPELINE_BIND_POINT_COMPUTE, kernel.layout(), 0, 1,
                                            &set, 0, nullptr);
    boundPipeline_ = kernel.pipeline();
    boundSet_ = set;
}

void Commands::push(const Kernel& kernel, const void* bytes, std::uint32_t size) noexcept {
    assert(size <= kernel.interface().pushConstantSize && size % 4 == 0);
    functions_->vkCmdPushConstants(commands_, kernel.layout(), VK_SHADER_STAGE_COMPUTE_BIT, 0, size, bytes);
}

void Commands::dispatch(std::uint32_t groupsX) noexcept {
    functions_->vkCmdDispatch(commands_, groupsX, 1, 1);
}

void Commands::dispatchIndirect(const BufferView& arguments, std::uint32_t index) noexcept {
    const VkDeviceSize offset = arguments.offset + VkDeviceSize{index} * arguments.stride;
    assert(arguments.stride >= sizeof(VkDispatchIndirectCommand) && offset % 4 == 0);
    assert(VkDeviceSize{index} * arguments.stride < arguments.size);
    functions_->vkCmdDispatchIndirect(commands_, arguments.buffer, offset);
}

void Commands::fill(const BufferView& target, std::uint32_t value) noexcept {
    functions_->vkCmdFillBuffer(commands_, target.buffer, target.offset, target.size, value);
}

void Commands::copy(const BufferView& from, const BufferView& to) noexcept {
    assert(from.size == to.size);
    const VkBufferCopy region{from.offset, to.offset, from.size};
    functions_->vkCmdCopyBuffer(commands_, from.buffer, to.buffer, 1, &region);
}

void Commands::update(const BufferView& target, const void* bytes, VkDeviceSize size) noexcept {
    assert(size <= target.size && size % 4 == 0);
    constexpr VkDeviceSize most = 65536; // of one command
    for (VkDeviceSize done = 0; done < size; done += most)
        functions_->vkCmdUpdateBuffer(commands_, target.buffer, target.offset + done,
                                      std::min(most, size - done),
                                      static_cast<const std::byte*>(bytes) + done);
}

void Commands::memoryBarrier(VkPipelineStageFlags from, VkAccessFlags written, VkPipelineStageFlags to,
                             VkAccessFlags access) noexcept {
    const VkMemoryBarrier barrier{
        .sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER, .srcAccessMask = written, .dstAccessMask = access};
    functions_->vkCmdPipelineBarrier(commands_, from, to, 0, 1, &barrier, 0, nullptr, 0, nullptr);
}

// Reads of arguments come before compute shaders in the pipeline, so the stages before need not name them.
void Commands::barrier(BarrierScope scope) noexcept {
    VkPipelineStageFlags from = shaderStage, to = shaderStage;
    VkAccessFlags written = VK_ACCESS_SHADER_WRITE_BIT, access = shaderAccess;
    if (scope.afterTransfers) {
        from |= VK_PIPELINE_STAGE_TRANSFER_BIT;
        written |= VK_ACCESS_TRANSFER_WRITE_BIT;
    }
    if (scope.beforeTransfers) {
        to |= VK_PIPELINE_STAGE_TRANSFER_BIT;
        access |= transferAccess;
    }
    if (scope.beforeArguments) {
        to |= VK_PIPELINE_STAGE_DRAW_INDIRECT_BIT;
        access |= VK_ACCESS_INDIRECT_COMMAND_READ_BIT;
    }
    memoryBarrier(from, written, to, access);
}

void Commands::continueIn(VkCommandBuffer commands) noexcept {
    commands_ = commands;
    boundPipeline_ = VK_NULL_HANDLE;
    boundSet_ = VK_NULL_HANDLE;
}

void Commands::beginStep() noexcept {
    memoryBarrier(allStages_, writeAccess, stepStages, stepAccess);
}

void Commands::endStep(VkPipelineStageFlags moreStages, VkAccessFlags moreAccess) noexcept {
    const bool isDrawing = (allStages_ & drawingStages) != 0;
    memoryBarrier(writerStages, writeAccess, allStages_ | moreStages,
                  (isDrawing ? stepAccess | drawingAccess : stepAccess) | moreAccess);
}

void Commands::endStep() noexcept {
    endStep(0, 0);
}

void Commands::endStepForHost() noexcept {
    endStep(VK_PIPELINE_STAGE_HOST_BIT, VK_ACCESS_HOST_READ_BIT);
}

void Commands::hostBarrier() noexcept {
    memoryBarrier(writerStages, writeAccess, VK_PIPELINE_STAGE_HOST_BIT, VK_ACCESS_HOST_READ_BIT);
}

void Commands::beginLabel(const char* label) noexcept {
    if (functions_->vkCmdBeginDebugUtilsLabelEXT == nullptr) return;
    const VkDebugUtilsLabelEXT info{.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_LABEL_EXT, .pLabelName = label};
    functions_->vkCmdBeginDebugUtilsLabelEXT(commands_, &info);
}

void Commands::endLabel() noexcept {
    if (functions_->vkCmdEndDebugUtilsLabelEXT != nullptr) functions_->vkCmdEndDebugUtilsLabelEXT(commands_);
}

void Commands::resetTimestamps(VkQueryPool pool, std::uint32_t count) noexcept {
    functions_->vkCmdResetQueryPool(commands_, pool, 0, count);
}

void Commands::timestamp(VkQueryPool pool, std::uint32_t index) noexcept {
    functions_->vkCmdWriteTimestamp(commands_, VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT, pool, index);
}

} // namespace sinew::vk
