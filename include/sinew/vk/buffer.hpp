// A storage buffer with an element count and a stride, both checked against a kernel's declaration.
#pragma once

#include "sinew/export.hpp"
#include "sinew/vk/device.hpp"

#include <span>

namespace sinew::vk {

/// A range of a VkBuffer for a kernel, a copy or a vertex input. Owns nothing.
struct SINEW_API BufferView {
    VkBuffer buffer = VK_NULL_HANDLE;
    VkDeviceSize offset = 0, size = 0; ///< [B]
    std::uint32_t stride = 0;          ///< [B]
    /// A stride that any binding takes: for bindings that a kernel does not access.
    static constexpr std::uint32_t anyStride = 0xffffffffu;
};

struct SINEW_API BufferRequest {
    std::string name{};
    VkDeviceSize count = 0;   ///< elements; at least one is allocated so that a binding is never empty
    std::uint32_t stride = 0; ///< [B]; 4-byte multiple
    MemoryKind kind = MemoryKind::device;
    VkBufferUsageFlags usage = 0;              ///< added to storage + transfer source + transfer destination
    std::span<const std::uint32_t> families{}; ///< different ones that use it at a time; empty = one by one
};

/// RAII buffer. Can be moved, not copied. Must not outlive its Device, which may be moved meanwhile.
class SINEW_API Buffer {
public:
    /// Throws Error(outOfMemory) if count x stride exceeds maxStorageBufferRange, naming the buffer and both
    /// figures; Error(misuse) if the stride is no multiple of 4.
    Buffer(const Device& device, const BufferRequest& request);
    Buffer(Buffer&& other) noexcept;
    Buffer& operator=(Buffer&& other) noexcept;
    ~Buffer();

    /// The whole buffer: max(count, 1) elements.
    BufferView view() const noexcept;
    VkDeviceSize count() const noexcept { return count_; }
    std::uint32_t stride() const noexcept { return stride_; }
    const std::string& name() const noexcept { return name_; }
    /// Host address of a mapped buffer (upload, readback), else null. Host coherent, except for a host's hook
    /// that provides other memory (BufferAllocation::memory): then call flush() after writing and before the
    /// submission that reads, and invalidate() before reading results of a finished submission.
    std::byte* mapped() const noexcept { return allocation_.mapped; }
    bool isCoherent() const noexcept { return allocation_.memory == VK_NULL_HANDLE; } ///< if it is mapped
    /// Make writes of the host visible to the device, and of the device to the host. Do nothing for coherent
    /// memory. `size` [B] from `offset` [B]; ranges grow to whole atoms (Limits::nonCoherentAtom), of which
    /// the other side must not write any part meanwhile.
    void flush(VkDeviceSize offset = 0, VkDeviceSize size = VK_WHOLE_SIZE) const noexcept;
    void invalidate(VkDeviceSize offset = 0, VkDeviceSize size = VK_WHOLE_SIZE) const noexcept;

private:
    void release() noexcept;
    VkMappedMemoryRange atomsOf(VkDeviceSize offset, VkDeviceSize size) const noexcept;
    const Device* device_ = nullptr; ///< anchored
    Allocator* allocator_ = nullptr; ///< null: moved from
    BufferAllocation allocation_;
    VkDeviceSize count_ = 0;
    std::uint32_t stride_ = 0;
    std::string name_;
};

} // namespace sinew::vk
