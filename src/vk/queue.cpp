// One queue with one timeline semaphore.
#include "sinew/vk/queue.hpp"

#include "sinew/vk/check.hpp"

#include <algorithm>
#include <cstring>
#include <limits>

namespace sinew::vk {

namespace {

constexpr VkDeviceSize stagingSize = 8u << 20; // [B]; larger transfers are split

BufferView part(const BufferView& view, VkDeviceSize offset, VkDeviceSize size) {
    return {view.buffer, view.offset + offset, size, view.stride};
}

Buffer staging(const Device& device, VkDeviceSize size, MemoryKind kind) {
    return Buffer(device, {.name = kind == MemoryKind::upload ? "staging.upload" : "staging.readback",
                           .count = std::min(size, stagingSize) / 4,
                           .stride = 4,
                           .kind = kind});
}

void checkTransfer(const BufferView& view, VkDeviceSize size) {
    if (size > view.size || size % 4 != 0)
        throw Error(Failure::misuse, "a transfer of " + std::to_string(size) +
                                         " bytes to or from a buffer view of " + std::to_string(view.size) +
                                         " bytes");
}

} // namespace

Queue::Queue(const Device& device) : device_(device.anchored()) {
    const DeviceFunctions& functions = device.functions();
    functions.vkGetDeviceQueue(device.handle(), device.queueFamily(), 0, &queue_);
    device.name(VK_OBJECT_TYPE_QUEUE, handleValue(queue_), "sinew.queue");
    const VkCommandPoolCreateInfo poolInfo{.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO,
                                           .flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT,
                                           .queueFamilyIndex = device.queueFamily()};
    const VkSemaphoreTypeCreateInfo type{.sType = VK_STRUCTURE_TYPE_SEMAPHORE_TYPE_CREATE_INFO,
                                         .semaphoreType = VK_SEMAPHORE_TYPE_TIMELINE};
    const VkSemaphoreCreateInfo semaphoreInfo{.sType = VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO,
                                              .pNext = &type};
    check(functions.vkCreateCommandPool(device.handle(), &poolInfo, functions.allocation, &pool_),
          "vkCreateCommandPool", "the queue");
    device.name(VK_OBJECT_TYPE_COMMAND_POOL, handleValue(pool_), "sinew.commands");
    const VkResult result =
        functions.vkCreateSemaphore(device.handle(), &semaphoreInfo, functions.allocation, &timeline_);
    if (result < 0) release();
    check(result, "vkCreateSemaphore", "the queue");
    device.name(VK_OBJECT_TYPE_SEMAPHORE, handleValue(timeline_), "sinew.timeline");
}

Queue::~Queue() {
    drain();
    release();
}

void Queue::release() noexcept {
    device_.functions().vkDestroySemaphore(device_.handle(), timeline_, device_.functions().allocation);
    device_.functions().vkDestroyCommandPool(device_.handle(), pool_, device_.functions().allocation);
}

VkCommandBuffer Queue::begin() {
    const DeviceFunctions& functions = device_.functions();
    std::uint64_t finished = 0;
    check(functions.vkGetSemaphoreCounterValue(device_.handle(), timeline_, &finished),
          "vkGetSemaphoreCounterValue", "the queue");
    VkCommandBuffer commands = VK_NULL_HANDLE;
    if (!submissions_.empty() && submissions_.front().value <= finished) {
        commands = submissions_.front().commands;
        submissions_.erase(submissions_.begin());
    } else {
        const VkCommandBufferAllocateInfo info{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
                                               .commandPool = pool_,
                                               .level = VK_COMMAND_BUFFER_LEVEL_PRIMARY,
                                               .commandBufferCount = 1};
        check(functions.vkAllocateCommandBuffers(device_.handle(), &info, &commands),
              "vkAllocateCommandBuffers", "the queue");
        device_.name(VK_OBJECT_TYPE_COMMAND_BUFFER, handleValue(commands), "sinew.commands");
    }
    const VkCommandBufferBeginInfo info{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO,
                                        .flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT};
    check(functions.vkBeginCommandBuffer(commands, &info), "vkBeginCommandBuffer", "the queue");
    return commands;
}

std::uint64_t Queue::submit(VkCommandBuffer commands) {
    const DeviceFunctions& functions = device_.functions();
    check(functions.vkEndCommandBuffer(commands), "vkEndCommandBuffer", "the queue");
    const std::uint64_t value = submitted_ + 1;
    const VkTimelineSemaphoreSubmitInfo timeline{.sType = VK_STRUCTURE_TYPE_TIMELINE_SEMAPHORE_SUBMIT_INFO,
                                                 .signalSemaphoreValueCount = 1,
                                                 .pSignalSemaphoreValues = &value};
    const VkSubmitInfo info{.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO,
                            .pNext = &timeline,
                            .commandBufferCount = 1,
                            .pCommandBuffers = &commands,
                            .signalSemaphoreCount = 1,
                            .pSignalSemaphores = &timeline_};
    check(functions.vkQueueSubmit(queue_, 1, &info, VK_NULL_HANDLE), "vkQueueSubmit", "the queue");
    submitted_ = value;
    submissions_.push_back({commands, value});
    return value;
}

void Queue::wait(std::uint64_t value) {
    const VkSemaphoreWaitInfo info{.sType = VK_STRUCTURE_TYPE_SEMAPHORE_WAIT_INFO,
                                   .semaphoreCount = 1,
                                   .pSemaphores = &timeline_,
                                   .pValues = &value};
    constexpr std::uint64_t forever = std::numeric_limits<std::uint64_t>::max();
    const VkResult result = device_.functions().vkWaitSemaphores(device_.handle(), &info, forever);
    if (result < 0) // the caller will free resources of the submission
        device_.functions().vkQueueWaitIdle(queue_);
    check(result, "vkWaitSemaphores", "the queue");
}

void Queue::waitIdle() {
    check(device_.functions().vkQueueWaitIdle(queue_), "vkQueueWaitIdle", "the queue");
}

void Queue::drain() noexcept {
    device_.functions().vkQueueWaitIdle(queue_); // returns at once for a lost device
}

void Queue::transfer(const BufferView& from, const BufferView& to) {
    VkCommandBuffer handle = begin();
    Commands commands(device_, handle);
    commands.beginStep();
    commands.copy(from, to);
    commands.endStep();
    commands.hostBarrier();
    wait(submit(handle));
}

void Queue::upload(const BufferView& target, const void* bytes, VkDeviceSize size) {
    checkTransfer(target, size);
    const Buffer buffer = staging(device_, size, MemoryKind::upload);
    for (VkDeviceSize at = 0; at < size; at += stagingSize) {
        const VkDeviceSize length = std::min(size - at, stagingSize);
        std::memcpy(buffer.mapped(), static_cast<const std::byte*>(bytes) + at, length);
        buffer.flush(0, length);
        transfer(part(buffer.view(), 0, length), part(target, at, length));
    }
}

void Queue::download(const BufferView& source, void* bytes, VkDeviceSize size) {
    checkTransfer(source, size);
    const Buffer buffer = staging(device_, size, MemoryKind::readback);
    for (VkDeviceSize at = 0; at < size; at += stagingSize) {
        const VkDeviceSize length = std::min(size - at, stagingSize);
        transfer(part(source, at, length), part(buffer.view(), 0, length));
        buffer.invalidate(0, length);
        std::memcpy(static_cast<std::byte*>(bytes) + at, buffer.mapped(), length);
    }
}

} // namespace sinew::vk
