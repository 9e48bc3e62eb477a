// Checks sizes before a request reaches the allocator.
#include "sinew/vk/buffer.hpp"

#include "sinew/vk/check.hpp"
#include "vk/allocator.hpp"

#include <algorithm>
#include <utility>

namespace sinew::vk {

namespace {

void checkRequest(const BufferRequest& request, VkDeviceSize largest) {
    if (request.stride == 0 || request.stride % 4 != 0)
        throw Error(Failure::misuse, "buffer " + request.name + ": a stride of " +
                                         std::to_string(request.stride) + " bytes is no multiple of 4");
    if (request.count > largest / request.stride)
        throw Error(Failure::outOfMemory, "buffer " + request.name + ": " + std::to_string(request.count) +
                                              " elements of " + std::to_string(request.stride) +
                                              " bytes exceed the device's maxStorageBufferRange of " +
                                              std::to_string(largest) + " bytes: use a smaller scene");
}

} // namespace

Buffer::Buffer(const Device& device, const BufferRequest& request)
    : device_(&device.anchored()), allocator_(&device.allocator()), count_(request.count),
      stride_(request.stride), name_(request.name) {
    checkRequest(request, device.limits().maxStorageBufferRange);
    const VkBufferCreateInfo info{
        .sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO,
        .size = std::max<VkDeviceSize>(count_, 1) * stride_,
        .usage = request.usage | VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT |
                 VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT |
                 VK_BUFFER_USAGE_TRANSFER_DST_BIT,
        .sharingMode = request.families.empty() ? VK_SHARING_MODE_EXCLUSIVE : VK_SHARING_MODE_CONCURRENT,
        .queueFamilyIndexCount = static_cast<std::uint32_t>(request.families.size()),
        .pQueueFamilyIndices = request.families.data()};
    allocation_ = allocator_->create(info, request.kind, name_.c_str());
    device.name(VK_OBJECT_TYPE_BUFFER, handleValue(allocation_.buffer), name_);
}

Buffer::Buffer(Buffer&& other) noexcept
    : device_(other.device_), allocator_(std::exchange(other.allocator_, nullptr)),
      allocation_(std::exchange(other.allocation_, {})), count_(other.count_), stride_(other.stride_),
      name_(std::move(other.name_)) {}

Buffer& Buffer::operator=(Buffer&& other) noexcept {
    if (this != &other) {
        release();
        device_ = other.device_;
        allocator_ = std::exchange(other.allocator_, nullptr);
        allocation_ = std::exchange(other.allocation_, {});
        count_ = other.count_;
        stride_ = other.stride_;
        name_ = std::move(other.name_);
    }
    return *this;
}

Buffer::~Buffer() {
    release();
}

void Buffer::release() noexcept {
    if (allocator_ != nullptr) allocator_->destroy(allocation_);
    allocator_ = nullptr;
}

// The range extended to whole atoms, as Vulkan requires, except at the end of the memory.
VkMappedMemoryRange Buffer::atomsOf(VkDeviceSize offset, VkDeviceSize size) const noexcept {
    const VkDeviceSize atom = std::max<VkDeviceSize>(device_->limits().nonCoherentAtom, 1);
    const VkDeviceSize whole = view().size, from = std::min(offset, whole);
    const VkDeviceSize first = (allocation_.memoryOffset + from) / atom * atom;
    const VkDeviceSize end = allocation_.memoryOffset + from + std::min(size, whole - from);
    const VkDeviceSize last = std::min((end + atom - 1) / atom * atom, allocation_.memorySize);
    return {.sType = VK_STRUCTURE_TYPE_MAPPED_MEMORY_RANGE,
            .pNext = nullptr,
            .memory = allocation_.memory,
            .offset = first,
            .size = last - first};
}

// Results are ignored: a failure here means that memory or device are lost for the next submission too, which
// reports it.
void Buffer::flush(VkDeviceSize offset, VkDeviceSize size) const noexcept {
    if (allocation_.memory == VK_NULL_HANDLE || allocation_.mapped == nullptr) return;
    const VkMappedMemoryRange range = atomsOf(offset, size);
    device_->functions().vkFlushMappedMemoryRanges(device_->handle(), 1, &range);
}

void Buffer::invalidate(VkDeviceSize offset, VkDeviceSize size) const noexcept {
    if (allocation_.memory == VK_NULL_HANDLE || allocation_.mapped == nullptr) return;
    const VkMappedMemoryRange range = atomsOf(offset, size);
    device_->functions().vkInvalidateMappedMemoryRanges(device_->handle(), 1, &range);
}

BufferView Buffer::view() const noexcept {
    return {allocation_.buffer, 0, std::max<VkDeviceSize>(count_, 1) * stride_, stride_};
}

} // namespace sinew::vk
