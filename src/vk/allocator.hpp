// Memory for buffers. Two implementations: blocks, a few large VkDeviceMemory objects per memory type with
// many buffers in each, and a host's own two functions.
#pragma once

#include "sinew/vk/device.hpp"

namespace sinew::vk {

struct AllocatorStatistics {
    std::uint32_t blocks = 0, buffers = 0; ///< a host's hook has no blocks
    VkDeviceSize reserved = 0, used = 0;   ///< [B]
};

/// Allocates and frees bound buffers. Set-up and tear-down only: never called while a step is recorded. Any
/// thread: a simulation may be prepared while another one runs on the same device.
class Allocator {
public:
    virtual ~Allocator() = default;
    /// Throws Error(outOfMemory) that names the buffer. vk::Buffer also sets `name` as the debug name.
    virtual BufferAllocation create(const VkBufferCreateInfo& info, MemoryKind kind, const char* name) = 0;
    virtual void destroy(const BufferAllocation& allocation) noexcept = 0;
    virtual AllocatorStatistics statistics() const noexcept = 0;
};

/// Memory types among the bits `allowed` that suit `kind`, best first. A pure function, so that tests can
/// pass the properties of any device.
std::vector<std::uint32_t> suitableMemoryTypes(const VkPhysicalDeviceMemoryProperties& properties,
                                               std::uint32_t allowed, MemoryKind kind);

/// Makes a block allocator. `functions` must outlive it. Buffers larger than half a block get their own
/// memory; an empty block is freed at once. Rejects blocks that would exceed the size of a heap, since not
/// every driver does.
std::unique_ptr<Allocator> makeBlockAllocator(VkDevice device, const DeviceFunctions& functions,
                                              const VkPhysicalDeviceMemoryProperties& properties);

/// Makes an allocator that calls the hook and checks its results: a buffer, an address for mapped kinds, and
/// that the buffer lies within the memory that it names.
std::unique_ptr<Allocator> makeHookAllocator(const BufferHook& hook);

} // namespace sinew::vk
