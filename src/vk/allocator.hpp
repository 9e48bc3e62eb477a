// Where buffers get their memory. Two implementations: blocks of a few large VkDeviceMemory per memory type
// with buffers side by side inside them, and a host's own two functions.
#pragma once

#include "vk/device.hpp"

namespace sinew::vk {

struct AllocatorStatistics {
    std::uint32_t blocks = 0, buffers = 0; ///< a host's hook counts no blocks
    VkDeviceSize reserved = 0, used = 0;   ///< [B]
};

/// Hands out bound buffers. Set-up and tear-down only: no call is made while a step is recorded. Any thread:
/// what is prepared while something else plays shares its device.
class Allocator {
public:
    virtual ~Allocator() = default;
    /// Throws Error(outOfMemory) naming the buffer. vk::Buffer gives it `name` as its debug name as well.
    virtual BufferAllocation create(const VkBufferCreateInfo& info, MemoryKind kind, const char* name) = 0;
    virtual void destroy(const BufferAllocation& allocation) noexcept = 0;
    virtual AllocatorStatistics statistics() const noexcept = 0;
};

/// Memory types out of the bits `allowed` that serve `kind`, best first. Pure, so that tests can pretend any
/// device.
std::vector<std::uint32_t> suitableMemoryTypes(const VkPhysicalDeviceMemoryProperties& properties,
                                               std::uint32_t allowed, MemoryKind kind);

/// `functions` must outlive the allocator. Buffers larger than half a block get memory of their own; an empty
/// block is returned at once. Refuses what its blocks would reserve beyond a heap's size, since not every
/// driver does.
std::unique_ptr<Allocator> makeBlockAllocator(VkDevice device, const DeviceFunctions& functions,
                                              const VkPhysicalDeviceMemoryProperties& properties);

/// Checks what the hook returns: a buffer, an address for the kinds that are mapped, and that the buffer lies
/// in the memory that it names.
std::unique_ptr<Allocator> makeHookAllocator(const BufferHook& hook);

} // namespace sinew::vk
