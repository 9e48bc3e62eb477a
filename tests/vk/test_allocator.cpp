// Tests of the block allocator: free lists against a reference, choice of memory on simulated devices, and a
// host's own functions.
#include "support/device.hpp"
#include "support/host_device.hpp"

#include "sinew/vk/check.hpp"
#include "vk/allocator.hpp"
#include "vk/free_ranges.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace sinew::test {

namespace {

constexpr VkDeviceSize mebibyte = 1u << 20; // [B]

constexpr VkMemoryPropertyFlags local = VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT;
constexpr VkMemoryPropertyFlags coherent =
    VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
constexpr VkMemoryPropertyFlags cached = VK_MEMORY_PROPERTY_HOST_CACHED_BIT;

VkPhysicalDeviceMemoryProperties memoryWith(const std::vector<VkMemoryPropertyFlags>& types) {
    VkPhysicalDeviceMemoryProperties properties{};
    for (const VkMemoryPropertyFlags flags : types)
        properties.memoryTypes[properties.memoryTypeCount++] = {flags, 0};
    properties.memoryHeapCount = 1;
    properties.memoryHeaps[0].size = 1024 * mebibyte;
    return properties;
}

std::uint32_t best(const VkPhysicalDeviceMemoryProperties& memory, vk::MemoryKind kind) {
    return suitableMemoryTypes(memory, ~0u, kind).at(0);
}

VkBufferCreateInfo bufferOf(VkDeviceSize size) {
    return {.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO,
            .size = size,
            .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
            .sharingMode = VK_SHARING_MODE_EXCLUSIVE};
}

/// A separate allocator on the shared device, with one heap of this size.
std::unique_ptr<vk::Allocator> allocatorWithHeap(VkDeviceSize size) {
    VkPhysicalDeviceMemoryProperties memory;
    device().instanceFunctions().vkGetPhysicalDeviceMemoryProperties(device().physical(), &memory);
    memory.memoryHeapCount = 1;
    memory.memoryHeaps[0].size = size;
    for (VkMemoryType& type : memory.memoryTypes) type.heapIndex = 0;
    return makeBlockAllocator(device().handle(), device().functions(), memory);
}

} // namespace

TEST(FreeRanges, NeverOverlapAndMergeCompletely) {
    constexpr std::uint64_t size = 4096;
    std::mt19937 random(1);
    vk::FreeRanges free(size);
    std::vector<bool> isTaken(size, false);
    std::vector<std::pair<std::uint64_t, std::uint64_t>> taken;
    for (int turn = 0; turn < 20000; ++turn) {
        if (random() % 2 == 0) {
            const std::uint64_t length = 1 + random() % 300, alignment = std::uint64_t{1} << random() % 9;
            const auto offset = free.take(length, alignment);
            if (!offset) continue;
            ASSERT_EQ(*offset % alignment, 0u);
            ASSERT_LE(*offset + length, size);
            for (std::uint64_t at = *offset; at < *offset + length; ++at) {
                ASSERT_FALSE(isTaken[at]) << "turn " << turn;
                isTaken[at] = true;
            }
            taken.emplace_back(*offset, length);
        } else if (!taken.empty()) {
            std::swap(taken[random() % taken.size()], taken.back());
            const auto [offset, length] = taken.back();
            taken.pop_back();
            free.give(offset, length);
            std::fill_n(isTaken.begin() + static_cast<std::ptrdiff_t>(offset), length, false);
        }
        std::uint64_t freeBytes = 0, previousEnd = ~std::uint64_t{0};
        for (const auto& [offset, length] : free.ranges()) {
            ASSERT_NE(offset, previousEnd) << "neighbours were not merged";
            previousEnd = offset + length;
            freeBytes += length;
        }
        ASSERT_EQ(freeBytes, static_cast<std::uint64_t>(std::count(isTaken.begin(), isTaken.end(), false)));
    }
    for (const auto& [offset, length] : taken) free.give(offset, length);
    EXPECT_TRUE(free.isAllFree());
}

TEST(FreeRanges, FindTheLastByteAndRefuseOneMore) {
    vk::FreeRanges free(64);
    EXPECT_EQ(free.take(63, 1), 0u);
    EXPECT_EQ(free.take(1, 1), 63u);
    EXPECT_FALSE(free.take(1, 1).has_value());
}

TEST(FreeRanges, SkipWhatAlignmentLeavesTooSmall) {
    vk::FreeRanges free(96);
    EXPECT_EQ(free.take(1, 1), 0u);
    EXPECT_FALSE(free.take(48, 64).has_value()); // at this alignment only 64 to 96 is free
    EXPECT_EQ(free.take(32, 64), 64u);
    EXPECT_EQ(free.take(63, 1), 1u); // the padding is still free
}

TEST(MemoryChoice, OnADiscreteGpuKeepsKernelsLocalAndUploadsOffTheSmallHeap) {
    const auto memory = memoryWith({0, local, coherent, coherent | cached, local | coherent});
    EXPECT_EQ(best(memory, vk::MemoryKind::device), 1u);
    EXPECT_EQ(best(memory, vk::MemoryKind::upload), 2u);
    EXPECT_EQ(best(memory, vk::MemoryKind::readback), 3u);
}

TEST(MemoryChoice, OnAnIntegratedGpuReadsBackThroughTheCache) {
    const auto memory = memoryWith({local, local | coherent, local | coherent | cached});
    EXPECT_EQ(best(memory, vk::MemoryKind::device), 0u);
    EXPECT_EQ(best(memory, vk::MemoryKind::upload), 1u);
    EXPECT_EQ(best(memory, vk::MemoryKind::readback), 2u);
}

TEST(MemoryChoice, TakesTheOnlyTypeThereIs) {
    const auto memory = memoryWith({local | coherent | cached});
    for (const auto kind : {vk::MemoryKind::device, vk::MemoryKind::upload, vk::MemoryKind::readback})
        EXPECT_EQ(best(memory, kind), 0u);
}

TEST(MemoryChoice, NeverTakesLazyProtectedIncoherentOrForbiddenTypes) {
    const auto memory =
        memoryWith({local | VK_MEMORY_PROPERTY_LAZILY_ALLOCATED_BIT, local | VK_MEMORY_PROPERTY_PROTECTED_BIT,
                    VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | cached, local | coherent,
                    local | coherent | VK_MEMORY_PROPERTY_DEVICE_UNCACHED_BIT_AMD});
    EXPECT_EQ(suitableMemoryTypes(memory, ~0u, vk::MemoryKind::upload), std::vector<std::uint32_t>{3});
    EXPECT_EQ(suitableMemoryTypes(memory, ~0u, vk::MemoryKind::device), (std::vector<std::uint32_t>{3, 2}));
    EXPECT_TRUE(suitableMemoryTypes(memory, 1u << 4, vk::MemoryKind::device).empty());
}

TEST(BlockAllocator, HandsOutDisjointMemoryUnderRandomUse) {
    struct Live {
        vk::BufferAllocation allocation;
        VkDeviceSize size;
        std::byte pattern;
    };
    const auto allocator = allocatorWithHeap(1024 * mebibyte);
    std::mt19937 random(2);
    std::vector<Live> live;
    const auto holdsItsPattern = [](const Live& buffer) {
        return std::all_of(buffer.allocation.mapped, buffer.allocation.mapped + buffer.size,
                           [&](std::byte byte) { return byte == buffer.pattern; });
    };
    for (int turn = 0; turn < 2000; ++turn) {
        if (random() % 5 < 3 || live.empty()) {
            const VkDeviceSize size = 4 * (1 + random() % (turn % 100 == 0 ? 3000000 : 4000));
            const auto allocation = allocator->create(bufferOf(size), vk::MemoryKind::upload, "random");
            live.push_back({allocation, size, static_cast<std::byte>(turn)});
            std::fill_n(allocation.mapped, size, static_cast<std::byte>(turn));
        } else {
            std::swap(live[random() % live.size()], live.back());
            ASSERT_TRUE(holdsItsPattern(live.back())) << "turn " << turn;
            allocator->destroy(live.back().allocation);
            live.pop_back();
        }
    }
    EXPECT_EQ(allocator->statistics().buffers, live.size());
    for (const Live& buffer : live) {
        EXPECT_TRUE(holdsItsPattern(buffer));
        allocator->destroy(buffer.allocation);
    }
    const vk::AllocatorStatistics end = allocator->statistics();
    EXPECT_EQ(end.buffers, 0u);
    EXPECT_EQ(end.blocks, 0u) << "empty blocks go back";
    EXPECT_EQ(end.reserved, 0u);
}

TEST(BlockAllocator, PutsSmallBuffersIntoOneBlockAndLargeOnesAlone) {
    const auto allocator = allocatorWithHeap(1024 * mebibyte);
    std::vector<vk::BufferAllocation> buffers;
    for (int i = 0; i < 100; ++i)
        buffers.push_back(allocator->create(bufferOf(64 << 10), vk::MemoryKind::device, "small"));
    EXPECT_EQ(allocator->statistics().blocks, 1u);
    EXPECT_EQ(allocator->statistics().reserved, 16 * mebibyte);
    buffers.push_back(allocator->create(bufferOf(40 * mebibyte), vk::MemoryKind::device, "large"));
    EXPECT_EQ(allocator->statistics().blocks, 2u);
    EXPECT_LT(allocator->statistics().reserved, 57 * mebibyte);
    for (const vk::BufferAllocation& buffer : buffers) allocator->destroy(buffer);
}

TEST(BlockAllocator, RefusesWhatTheHeapCannotHoldByName) {
    const auto allocator = allocatorWithHeap(64 * mebibyte);
    try {
        allocator->create(bufferOf(65 * mebibyte), vk::MemoryKind::device, "too.large");
        FAIL() << "it was made";
    } catch (const vk::Error& error) {
        EXPECT_EQ(error.failure(), vk::Failure::outOfMemory);
        EXPECT_NE(std::string(error.what()).find("too.large"), std::string::npos) << error.what();
    }
    EXPECT_EQ(allocator->statistics().buffers, 0u);
}

TEST(BlockAllocator, FallsBackToAnExactBlockWhereTheHeapIsNearlyFull) {
    const auto allocator = allocatorWithHeap(18 * mebibyte);
    std::vector<vk::BufferAllocation> buffers;
    buffers.push_back(allocator->create(bufferOf(8 * mebibyte), vk::MemoryKind::device, "first"));
    buffers.push_back(allocator->create(bufferOf(8 * mebibyte), vk::MemoryKind::device, "second"));
    EXPECT_EQ(allocator->statistics().reserved, 16 * mebibyte);
    buffers.push_back(allocator->create(bufferOf(1 * mebibyte), vk::MemoryKind::device, "third"));
    EXPECT_EQ(allocator->statistics().reserved, 17 * mebibyte);
    EXPECT_THROW(allocator->create(bufferOf(2 * mebibyte), vk::MemoryKind::device, "fourth"), vk::Error);
    for (const vk::BufferAllocation& buffer : buffers) allocator->destroy(buffer);
}

TEST(BufferHook, GetsEveryBufferAndEveryDestruction) {
    HostDevice host;
    vk::HostDevice handles = host.handles();
    VkPhysicalDeviceMemoryProperties memory;
    host.instanceFunctions().vkGetPhysicalDeviceMemoryProperties(handles.physicalDevice, &memory);
    const auto engine = vk::makeBlockAllocator(handles.device, host.functions(), memory); // as in an engine
    std::vector<std::string> created;
    std::size_t destroyed = 0;
    handles.buffers = {.create =
                           [&](const VkBufferCreateInfo& info, vk::MemoryKind kind, const char* name) {
                               created.push_back(name);
                               return engine->create(info, kind, name);
                           },
                       .destroy =
                           [&](const vk::BufferAllocation& allocation) {
                               ++destroyed;
                               engine->destroy(allocation);
                           }};
    {
        const vk::Device borrowed = vk::Device::borrow(handles);
        const vk::Buffer a(borrowed, {.name = "a", .count = 10, .stride = 4});
        const vk::Buffer b(borrowed, {.name = "b", .count = 10, .stride = 4, .kind = vk::MemoryKind::upload});
        EXPECT_EQ(borrowed.allocator().statistics().buffers, 2u);
        EXPECT_EQ(borrowed.allocator().statistics().used, 80u);
        EXPECT_NE(b.mapped(), nullptr);
        EXPECT_EQ(destroyed, 0u);
    }
    EXPECT_EQ(created, (std::vector<std::string>{"a", "b"}));
    EXPECT_EQ(destroyed, 2u);
    EXPECT_EQ(host.finish(), std::vector<std::string>{});
}

TEST(BufferHook, ThatReturnsNothingOrDoesNotMapIsReportedByName) {
    HostDevice host;
    vk::HostDevice handles = host.handles();
    std::size_t destroyed = 0;
    VkBuffer answer = VK_NULL_HANDLE;
    handles.buffers = {.create = [&](const VkBufferCreateInfo&, vk::MemoryKind,
                                     const char*) { return vk::BufferAllocation{answer}; },
                       .destroy = [&](const vk::BufferAllocation&) { ++destroyed; }};
    const vk::Device borrowed = vk::Device::borrow(handles);
    EXPECT_THROW(vk::Buffer(borrowed, {.name = "a", .count = 1, .stride = 4}), vk::Error);
    EXPECT_EQ(destroyed, 0u);
    std::uint64_t anything = 0;
    answer = reinterpret_cast<VkBuffer>(&anything);
    EXPECT_THROW(vk::Buffer(borrowed, {.name = "a", .count = 1, .stride = 4, .kind = vk::MemoryKind::upload}),
                 vk::Error);
    EXPECT_EQ(destroyed, 1u);
}

} // namespace sinew::test
