// The block allocator, and the adapter for a host's allocation hook.
#include "vk/allocator.hpp"

#include "sinew/vk/check.hpp"
#include "vk/free_ranges.hpp"

#include <algorithm>
#include <bit>
#include <list>
#include <mutex>
#include <unordered_map>

namespace sinew::vk {

namespace {

constexpr VkDeviceSize firstBlock = 16u << 20, largestBlock = 64u << 20; // [B]

constexpr VkMemoryPropertyFlags hostCoherent =
    VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
constexpr VkMemoryPropertyFlags ordinary =
    VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT | hostCoherent | VK_MEMORY_PROPERTY_HOST_CACHED_BIT;

struct Preference {
    VkMemoryPropertyFlags needed, wanted, unwanted;
};

Preference preferenceOf(MemoryKind kind) noexcept {
    switch (kind) {
    case MemoryKind::upload: // avoids a GPU's small heap that is local and visible
        return {hostCoherent, 0, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT | VK_MEMORY_PROPERTY_HOST_CACHED_BIT};
    case MemoryKind::readback:
        return {hostCoherent, VK_MEMORY_PROPERTY_HOST_CACHED_BIT, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT};
    case MemoryKind::device:
        break;
    }
    return {0, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, hostCoherent | VK_MEMORY_PROPERTY_HOST_CACHED_BIT};
}

struct Block {
    VkDeviceMemory memory = VK_NULL_HANDLE;
    std::byte* mapped = nullptr;
    VkDeviceSize size = 0; ///< [B]
    std::uint32_t type = 0;
    FreeRanges free;
};

struct Placement {
    std::list<Block>::iterator block{};
    VkDeviceSize offset = 0, size = 0; ///< [B]
};

class BlockAllocator final : public Allocator {
public:
    BlockAllocator(VkDevice device, const DeviceFunctions& functions,
                   const VkPhysicalDeviceMemoryProperties& properties)
        : device_(device), functions_(functions), properties_(properties) {}
    ~BlockAllocator() override {
        for (const Block& block : blocks_)
            functions_.vkFreeMemory(device_, block.memory, functions_.allocation);
    }

    BufferAllocation create(const VkBufferCreateInfo& info, MemoryKind kind, const char* name) override;
    void destroy(const BufferAllocation& allocation) noexcept override;
    AllocatorStatistics statistics() const noexcept override;

private:
    Placement place(const VkMemoryRequirements& need, MemoryKind kind, const std::string& name);
    std::optional<Placement> placeInBlocks(const VkMemoryRequirements& need, std::uint32_t type);
    VkResult addBlock(std::uint32_t type, VkDeviceSize size);
    void remove(const BufferAllocation& allocation) noexcept;
    void giveBack(const Placement& placement) noexcept;
    VkDeviceSize nextBlockSize(std::uint32_t type) const noexcept;
    VkDeviceSize freeInHeap(std::uint32_t type) const noexcept;

    VkDevice device_;
    const DeviceFunctions& functions_;
    VkPhysicalDeviceMemoryProperties properties_;
    std::list<Block> blocks_;
    std::unordered_map<std::uint64_t, Placement> placements_; ///< by token
    std::uint64_t nextToken_ = 1;
    mutable std::mutex mutex_; // guards all members that change
};

BufferAllocation BlockAllocator::create(const VkBufferCreateInfo& info, MemoryKind kind, const char* name) {
    if ((info.usage & VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT) != 0)
        throw Error(Failure::misuse, std::string("buffer ") + name +
                                         ": a device address needs memory from the host: set a BufferHook");
    const std::lock_guard lock(mutex_);
    BufferAllocation allocation{.token = nextToken_++};
    Placement& placement = placements_[allocation.token]; // first: what has a place must be found again
    try {
        check(functions_.vkCreateBuffer(device_, &info, functions_.allocation, &allocation.buffer),
              "vkCreateBuffer", name);
        VkMemoryRequirements need;
        functions_.vkGetBufferMemoryRequirements(device_, allocation.buffer, &need);
        placement = place(need, kind, name);
        if (placement.block->mapped != nullptr)
            allocation.mapped = placement.block->mapped + placement.offset;
        check(functions_.vkBindBufferMemory(device_, allocation.buffer, placement.block->memory,
                                            placement.offset),
              "vkBindBufferMemory", name);
    } catch (...) {
        remove(allocation);
        throw;
    }
    return allocation;
}

void BlockAllocator::destroy(const BufferAllocation& allocation) noexcept {
    const std::lock_guard lock(mutex_);
    remove(allocation);
}

void BlockAllocator::remove(const BufferAllocation& allocation) noexcept {
    functions_.vkDestroyBuffer(device_, allocation.buffer, functions_.allocation);
    const auto placement = placements_.find(allocation.token);
    if (placement->second.size > 0)
        giveBack(placement->second); // else create() failed before it found a place
    placements_.erase(placement);
}

void BlockAllocator::giveBack(const Placement& placement) noexcept {
    placement.block->free.give(placement.offset, placement.size);
    if (!placement.block->free.isAllFree()) return;
    functions_.vkFreeMemory(device_, placement.block->memory, functions_.allocation);
    blocks_.erase(placement.block);
}

Placement BlockAllocator::place(const VkMemoryRequirements& need, MemoryKind kind, const std::string& name) {
    VkResult result = VK_ERROR_OUT_OF_DEVICE_MEMORY;
    for (const std::uint32_t type : suitableMemoryTypes(properties_, need.memoryTypeBits, kind)) {
        const VkDeviceSize blockSize = nextBlockSize(type);
        const bool isShared = need.size <= blockSize / 2;
        if (const auto found = isShared ? placeInBlocks(need, type) : std::nullopt) return *found;
        result = isShared ? addBlock(type, blockSize) : VK_ERROR_OUT_OF_DEVICE_MEMORY;
        if (result != VK_SUCCESS && result != VK_ERROR_DEVICE_LOST) result = addBlock(type, need.size);
        if (result == VK_ERROR_DEVICE_LOST) break;
        if (result == VK_SUCCESS) {
            const auto block = std::prev(blocks_.end());
            return {block, block->free.take(need.size, need.alignment).value(), need.size};
        }
    }
    const Failure failure = result == VK_ERROR_DEVICE_LOST ? Failure::deviceLost : Failure::outOfMemory;
    throw Error(failure, "buffer " + name + ": no memory for " + std::to_string(need.size) +
                             " bytes: " + resultName(result));
}

std::optional<Placement> BlockAllocator::placeInBlocks(const VkMemoryRequirements& need, std::uint32_t type) {
    for (auto block = blocks_.begin(); block != blocks_.end(); ++block)
        if (block->type == type)
            if (const auto offset = block->free.take(need.size, need.alignment))
                return Placement{block, *offset, need.size};
    return std::nullopt;
}

VkResult BlockAllocator::addBlock(std::uint32_t type, VkDeviceSize size) {
    if (size > freeInHeap(type)) return VK_ERROR_OUT_OF_DEVICE_MEMORY;
    const VkMemoryAllocateInfo info{
        .sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, .allocationSize = size, .memoryTypeIndex = type};
    Block& block = blocks_.emplace_back(Block{.size = size, .type = type, .free = FreeRanges(size)});
    if (const VkResult result =
            functions_.vkAllocateMemory(device_, &info, functions_.allocation, &block.memory);
        result < 0) {
        blocks_.pop_back();
        return result;
    }
    if ((properties_.memoryTypes[type].propertyFlags & hostCoherent) == hostCoherent) {
        void* mapped = nullptr;
        const VkResult result = functions_.vkMapMemory(device_, block.memory, 0, VK_WHOLE_SIZE, 0, &mapped);
        if (result < 0) {
            functions_.vkFreeMemory(device_, block.memory, functions_.allocation);
            blocks_.pop_back();
            return result;
        }
        block.mapped = static_cast<std::byte*>(mapped);
    }
    return VK_SUCCESS;
}

VkDeviceSize BlockAllocator::nextBlockSize(std::uint32_t type) const noexcept {
    VkDeviceSize size = firstBlock;
    for (const Block& block : blocks_)
        if (block.type == type) size = std::min(2 * size, largestBlock);
    return size;
}

VkDeviceSize BlockAllocator::freeInHeap(std::uint32_t type) const noexcept {
    const std::uint32_t heap = properties_.memoryTypes[type].heapIndex;
    VkDeviceSize reserved = 0;
    for (const Block& block : blocks_)
        if (properties_.memoryTypes[block.type].heapIndex == heap) reserved += block.size;
    const VkDeviceSize size = properties_.memoryHeaps[heap].size;
    return size > reserved ? size - reserved : 0;
}

AllocatorStatistics BlockAllocator::statistics() const noexcept {
    const std::lock_guard lock(mutex_);
    AllocatorStatistics statistics{.blocks = static_cast<std::uint32_t>(blocks_.size()),
                                   .buffers = static_cast<std::uint32_t>(placements_.size())};
    for (const Block& block : blocks_) statistics.reserved += block.size;
    for (const auto& [token, placement] : placements_) statistics.used += placement.size;
    return statistics;
}

class HookAllocator final : public Allocator {
public:
    explicit HookAllocator(const BufferHook& hook) : hook_(hook) {}

    BufferAllocation create(const VkBufferCreateInfo& info, MemoryKind kind, const char* name) override {
        const std::lock_guard lock(mutex_);
        const BufferAllocation allocation = hook_.create(info, kind, name);
        const bool isInMemory = allocation.memoryOffset <= allocation.memorySize &&
                                info.size <= allocation.memorySize - allocation.memoryOffset;
        if (allocation.buffer == VK_NULL_HANDLE)
            throw Error(Failure::outOfMemory,
                        std::string("buffer ") + name + ": the host's hook returned no buffer");
        if (kind != MemoryKind::device && allocation.mapped == nullptr) {
            hook_.destroy(allocation);
            throw Error(Failure::misuse, std::string("buffer ") + name + ": the host's hook did not map it");
        }
        if (allocation.memory != VK_NULL_HANDLE && !isInMemory) {
            hook_.destroy(allocation);
            throw Error(Failure::misuse, std::string("buffer ") + name + ": the host's hook says that its " +
                                             std::to_string(info.size) + " bytes begin at " +
                                             std::to_string(allocation.memoryOffset) + " of memory of " +
                                             std::to_string(allocation.memorySize) +
                                             " bytes: set memoryOffset and memorySize");
        }
        sizes_.emplace(allocation.buffer, info.size);
        return allocation;
    }

    void destroy(const BufferAllocation& allocation) noexcept override {
        const std::lock_guard lock(mutex_);
        sizes_.erase(allocation.buffer);
        hook_.destroy(allocation);
    }

    AllocatorStatistics statistics() const noexcept override {
        const std::lock_guard lock(mutex_);
        AllocatorStatistics statistics{.buffers = static_cast<std::uint32_t>(sizes_.size())};
        for (const auto& [buffer, size] : sizes_) statistics.used += size;
        statistics.reserved = statistics.used;
        return statistics;
    }

private:
    BufferHook hook_;
    std::unordered_map<VkBuffer, VkDeviceSize> sizes_; ///< [B]
    mutable std::mutex mutex_;                         // guards sizes_ and the host's two functions
};

} // namespace

std::vector<std::uint32_t> suitableMemoryTypes(const VkPhysicalDeviceMemoryProperties& properties,
                                               std::uint32_t allowed, MemoryKind kind) {
    const Preference preference = preferenceOf(kind);
    const auto flagsOf = [&](std::uint32_t type) { return properties.memoryTypes[type].propertyFlags; };
    std::vector<std::uint32_t> types;
    for (std::uint32_t type = 0; type < properties.memoryTypeCount; ++type) {
        const bool isSuitable = (flagsOf(type) & preference.needed) == preference.needed;
        const bool isOrdinary = (flagsOf(type) & ~ordinary) == 0; // not lazy, protected or vendors' uncached
        if ((allowed >> type & 1) != 0 && isSuitable && isOrdinary) types.push_back(type);
    }
    const auto penalty = [&](std::uint32_t type) {
        const bool lacksWanted = (flagsOf(type) & preference.wanted) != preference.wanted;
        return (lacksWanted ? 100 : 0) + std::popcount(flagsOf(type) & preference.unwanted);
    };
    std::stable_sort(types.begin(), types.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return penalty(a) < penalty(b); });
    return types;
}

std::unique_ptr<Allocator> makeBlockAllocator(VkDevice device, const DeviceFunctions& functions,
                                              const VkPhysicalDeviceMemoryProperties& properties) {
    return std::make_unique<BlockAllocator>(device, functions, properties);
}

std::unique_ptr<Allocator> makeHookAllocator(const BufferHook& hook) {
    return std::make_unique<HookAllocator>(hook);
}

} // namespace sinew::vk
