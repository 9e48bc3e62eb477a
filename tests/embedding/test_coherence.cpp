// Tests a host with mapped memory that is cached and not coherent. The host side of every buffer is a copy,
// which is synchronised with the device memory only where Sinew flushes or invalidates.
#include "embedding/soft_bodies.hpp"
#include "sinew/vk/check.hpp"
#include "support/host_device.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <map>

namespace sinew::test {
namespace {

struct Memory {
    std::byte* real = nullptr;
    std::vector<std::byte> seen; // copy visible to the host
};

// Global state of the replaced Vulkan functions, which have no user pointer.
struct Incoherent {
    std::map<VkDeviceMemory, Memory> memories;
    VkDeviceSize atom = 1;
    int flushes = 0, invalidations = 0, wrongRanges = 0;
};
Incoherent incoherent;

template <typename Use>
VkResult forEach(std::uint32_t count, const VkMappedMemoryRange* ranges, const Use& use) {
    for (const VkMappedMemoryRange& range : std::span(ranges, count)) {
        Memory& memory = incoherent.memories.at(range.memory);
        const VkDeviceSize whole = memory.seen.size();
        const bool isValid = range.offset % incoherent.atom == 0 && range.offset + range.size <= whole &&
                             (range.size % incoherent.atom == 0 || range.offset + range.size == whole);
        if (isValid)
            use(memory.real + range.offset, memory.seen.data() + range.offset, range.size);
        else
            ++incoherent.wrongRanges;
    }
    return VK_SUCCESS;
}

VkResult VKAPI_CALL flush(VkDevice, std::uint32_t count, const VkMappedMemoryRange* ranges) {
    ++incoherent.flushes;
    return forEach(count, ranges,
                   [](std::byte* real, std::byte* seen, std::size_t size) { std::memcpy(real, seen, size); });
}

VkResult VKAPI_CALL invalidate(VkDevice, std::uint32_t count, const VkMappedMemoryRange* ranges) {
    ++incoherent.invalidations;
    return forEach(count, ranges,
                   [](std::byte* real, std::byte* seen, std::size_t size) { std::memcpy(seen, real, size); });
}

// An allocator that places buffers into blocks, as VMA does: neighbours share memory but no atom, and a block
// is mapped as a whole.
class IncoherentHost {
public:
    IncoherentHost() {
        VkPhysicalDeviceProperties properties;
        host.instanceFunctions().vkGetPhysicalDeviceProperties(host.handles().physicalDevice, &properties);
        incoherent = {.memories = {}, .atom = properties.limits.nonCoherentAtomSize};
        host.replace("vkFlushMappedMemoryRanges", reinterpret_cast<PFN_vkVoidFunction>(&flush));
        host.replace("vkInvalidateMappedMemoryRanges", reinterpret_cast<PFN_vkVoidFunction>(&invalidate));
    }

    vk::HostDevice handles() {
        vk::HostDevice handles = host.handles();
        handles.buffers = {
            .create = [this](const VkBufferCreateInfo& info, vk::MemoryKind kind,
                             const char*) { return create(info, kind); },
            .destroy = [this](const vk::BufferAllocation& allocation) { destroy(allocation); }};
        return handles;
    }

    HostDevice host;
    bool namesReadback = true;

private:
    static constexpr VkDeviceSize blockSize = 16 << 20;

    struct Block {
        VkDeviceMemory memory = VK_NULL_HANDLE;
        VkDeviceSize size = 0, used = 0;
        std::size_t buffers = 0;
    };

    vk::BufferAllocation create(const VkBufferCreateInfo& info, vk::MemoryKind kind) {
        const vk::DeviceFunctions& functions = host.functions();
        const vk::HostDevice handles = host.handles();
        vk::BufferAllocation made;
        vk::check(functions.vkCreateBuffer(handles.device, &info, nullptr, &made.buffer), "vkCreateBuffer",
                  "");
        VkMemoryRequirements need;
        functions.vkGetBufferMemoryRequirements(handles.device, made.buffer, &need);
        const VkDeviceSize step = std::max(need.alignment, incoherent.atom);
        const auto place = [step](VkDeviceSize used) { return (used + step - 1) / step * step; };
        auto block = std::ranges::find_if(blocks_, [&](const Block& candidate) {
            return place(candidate.used) + need.size <= candidate.size;
        });
        if (block == blocks_.end()) block = blocks_.insert(blocks_.end(), makeBlock(3 * step, need));
        const VkDeviceSize offset = place(block->used);
        block->used = (offset + need.size + incoherent.atom - 1) / incoherent.atom * incoherent.atom;
        ++block->buffers;
        blockOf_[made.buffer] = block->memory;
        vk::check(functions.vkBindBufferMemory(handles.device, made.buffer, block->memory, offset),
                  "vkBindBufferMemory", "");
        if (kind == vk::MemoryKind::device) return made;
        made.mapped = incoherent.memories.at(block->memory).seen.data() + offset;
        if (kind == vk::MemoryKind::readback && !namesReadback) return made;
        made.memory = block->memory;
        made.memoryOffset = offset;
        made.memorySize = block->size;
        return made;
    }

    /// Mapped, with contents that nobody has written; the first buffer begins at `begin`.
    Block makeBlock(VkDeviceSize begin, const VkMemoryRequirements& need) {
        const vk::DeviceFunctions& functions = host.functions();
        const VkDevice device = host.handles().device;
        Block block{.size = std::max(blockSize, begin + need.size), .used = begin};
        const VkMemoryAllocateInfo allocate{.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO,
                                            .allocationSize = block.size,
                                            .memoryTypeIndex = mappedType(need.memoryTypeBits)};
        vk::check(functions.vkAllocateMemory(device, &allocate, nullptr, &block.memory), "vkAllocateMemory",
                  "");
        void* real = nullptr;
        vk::check(functions.vkMapMemory(device, block.memory, 0, VK_WHOLE_SIZE, 0, &real), "vkMapMemory", "");
        Memory& mapped = incoherent.memories[block.memory];
        mapped = {static_cast<std::byte*>(real), std::vector<std::byte>(block.size, std::byte{0xcd})};
        std::memset(mapped.real, 0xab, block.size);
        return block;
    }

    /// A host-visible, coherent memory type. The functions above make it behave as incoherent memory.
    std::uint32_t mappedType(std::uint32_t allowed) const {
        constexpr VkMemoryPropertyFlags wanted =
            VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
        VkPhysicalDeviceMemoryProperties memory;
        const vk::HostDevice handles = host.handles();
        host.instanceFunctions().vkGetPhysicalDeviceMemoryProperties(handles.physicalDevice, &memory);
        for (std::uint32_t type = 0; type < memory.memoryTypeCount; ++type)
            if ((allowed >> type & 1) != 0 && (memory.memoryTypes[type].propertyFlags & wanted) == wanted)
                return type;
        throw std::runtime_error("no memory for a mapped buffer");
    }

    void destroy(const vk::BufferAllocation& allocation) {
        const VkDeviceMemory memory = blockOf_.at(allocation.buffer);
        blockOf_.erase(allocation.buffer);
        host.functions().vkDestroyBuffer(host.handles().device, allocation.buffer, nullptr);
        const auto block = std::ranges::find(blocks_, memory, &Block::memory);
        if (--block->buffers > 0) return;
        host.functions().vkFreeMemory(host.handles().device, memory, nullptr);
        incoherent.memories.erase(memory);
        blocks_.erase(block);
    }

    std::vector<Block> blocks_;
    std::map<VkBuffer, VkDeviceMemory> blockOf_;
};

struct Fall {
    std::vector<std::array<float, 4>> positions;
    std::vector<sim::Status> statuses;
};

// Runs the README's body for some steps, with one submission each.
Fall fall(HostDevice& host, const vk::HostDevice& handles) {
    SoftBodies bodies(handles);
    Fall result;
    const vk::BufferView view = bodies.simulation.positions();
    vk::Buffer readback(bodies.device, {.name = "readback",
                                        .count = view.size / view.stride,
                                        .stride = view.stride,
                                        .kind = vk::MemoryKind::readback});
    for (std::uint64_t frame = 0; frame < 6; ++frame) {
        host.submit([&](VkCommandBuffer commands) { bodies.recordFrame(commands, frame); });
        // Every second frame: between two looks the host flushes what is older than the device's memory.
        if (frame % 2 == 1)
            for (const std::uint64_t finished : {frame - 1, frame})
                result.statuses.push_back(bodies.simulation.status(finished));
    }
    host.submit([&](VkCommandBuffer buffer) {
        vk::Commands commands(bodies.device, buffer);
        commands.copy(view, readback.view());
        commands.hostBarrier();
    });
    readback.invalidate();
    result.positions.resize(view.size / view.stride);
    std::memcpy(result.positions.data(), readback.mapped(), view.size);
    return result;
}

TEST(Coherence, IsMadeWhereTheHostsMemoryHasNone) {
    Fall coherent;
    {
        HostDevice host;
        coherent = fall(host, host.handles());
    }
    IncoherentHost made;
    const Fall fallen = fall(made.host, made.handles());
    EXPECT_EQ(fallen.positions, coherent.positions);
    for (std::size_t frame = 0; frame < fallen.statuses.size(); ++frame) {
        EXPECT_TRUE(fallen.statuses[frame].isFinished) << frame;
        EXPECT_EQ(fallen.statuses[frame].frame, frame);
    }
    EXPECT_GT(incoherent.flushes, 0);
    EXPECT_GT(incoherent.invalidations, 0);
    EXPECT_EQ(incoherent.wrongRanges, 0);
    EXPECT_EQ(made.host.finish(), std::vector<std::string>{});
}

// The allocator hook hides that its memory is not coherent. A status that never becomes visible must not be
// taken for that of a finished step.
TEST(Coherence, IsNeverReadIntoAStatusThatDidNotArrive) {
    IncoherentHost made;
    made.namesReadback = false;
    for (const sim::Status& status : fall(made.host, made.handles()).statuses)
        EXPECT_FALSE(status.isFinished);
}

TEST(Coherence, IsCheckedWhereTheHookSaysWhereABufferLies) {
    HostDevice host;
    vk::HostDevice handles = host.handles();
    std::uint64_t anything = 0;
    std::byte byte{};
    vk::BufferAllocation answer{.buffer = reinterpret_cast<VkBuffer>(&anything),
                                .mapped = &byte,
                                .memory = reinterpret_cast<VkDeviceMemory>(&anything)};
    int destroyed = 0;
    handles.buffers = {
        .create = [&](const VkBufferCreateInfo&, vk::MemoryKind, const char*) { return answer; },
        .destroy = [&](const vk::BufferAllocation&) { ++destroyed; }};
    const vk::Device borrowed = vk::Device::borrow(handles);
    for (const VkDeviceSize offset : {0, 64, 1000}) {
        answer.memoryOffset = offset;
        answer.memorySize = offset + 39;
        try {
            vk::Buffer(borrowed, {.name = "a", .count = 10, .stride = 4, .kind = vk::MemoryKind::upload});
            ADD_FAILURE() << "accepted";
        } catch (const vk::Error& error) {
            EXPECT_EQ(error.failure(), vk::Failure::misuse);
            EXPECT_NE(std::string(error.what()).find("set memoryOffset and memorySize"), std::string::npos);
        }
    }
    EXPECT_EQ(destroyed, 3);
}

} // namespace
} // namespace sinew::test
