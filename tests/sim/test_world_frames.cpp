// Take-overs of a world on devices whose memory the host does not see.
#include "sim/device/gpu_executor.hpp"
#include "sim/world_play.hpp"
#include "support/host_device.hpp"
#include "vk/allocator.hpp"

using namespace sinew;
using namespace sinew::sim;
using test::ground, test::Play, test::slidingBoxes, test::stranger, test::Words;

namespace {

// A device whose buffers for kernels are hidden from the host, as on most GPUs.
class HiddenMemory {
public:
    HiddenMemory() {
        vk::HostDevice handles = host_.handles();
        VkPhysicalDeviceMemoryProperties memory;
        host_.instanceFunctions().vkGetPhysicalDeviceMemoryProperties(handles.physicalDevice, &memory);
        allocator_ = vk::makeBlockAllocator(handles.device, host_.functions(), memory);
        handles.buffers.create = [&](const VkBufferCreateInfo& info, vk::MemoryKind kind, const char* name) {
            vk::BufferAllocation allocation = allocator_->create(info, kind, name);
            if (kind == vk::MemoryKind::device) allocation.mapped = nullptr;
            return allocation;
        };
        handles.buffers.destroy = [&](const vk::BufferAllocation& allocation) {
            allocator_->destroy(allocation);
        };
        device_.emplace(vk::Device::borrow(handles));
    }
    const vk::Device& device() const { return *device_; }
    template <typename Record> void submit(const Record& record) { host_.submit(record); }
    Words read(const vk::BufferView& view) {
        const vk::Buffer copy(
            *device_,
            {.name = "copy", .count = view.size / 4, .stride = 4, .kind = vk::MemoryKind::readback});
        submit([&](VkCommandBuffer buffer) {
            vk::Commands commands(*device_, buffer);
            commands.beginStep();
            commands.copy(view, copy.view());
            commands.hostBarrier();
        });
        Words words(view.size / 4);
        std::memcpy(words.data(), copy.mapped(), view.size);
        return words;
    }

private:
    test::HostDevice host_;
    std::unique_ptr<vk::Allocator> allocator_;
    std::optional<vk::Device> device_;
};

} // namespace

TEST(World, RecordsFirstContentsWhereTheHostDoesNotSeeTheMemory) {
    Play seen(ground(), {.substeps = 4, .contactRoom = 64});
    const PartId expected = seen.add(slidingBoxes());
    seen.run(8);
    HiddenMemory hidden;
    World world(hidden.device(), ground(), {.substeps = 4, .contactRoom = 64});
    hidden.submit([&](VkCommandBuffer commands) { world.simulation().recordReset(commands); });
    const PartId part = world.add(slidingBoxes());
    while (!world.find(part)) hidden.submit([&](VkCommandBuffer commands) { world.recordChanges(commands); });
    for (std::uint64_t frame = 0; frame < 8; ++frame)
        hidden.submit([&](VkCommandBuffer commands) {
            world.simulation().record(commands, {.dt = ground().dt, .frame = frame});
        });
    const Words positions = hidden.read(world.simulation().positions());
    EXPECT_TRUE(positions == test::wordsOf(seen.world().simulation().positions()));
    EXPECT_EQ(seen.at(expected).count.particles, world.find(part)->count.particles);

    // The same contents in many small copies.
    const StepProgram& program = world.simulation().program();
    GpuExecutor executor(hidden.device(), program);
    ASSERT_FALSE(executor.fill());
    int slices = 0;
    for (bool isFilled = false; !isFilled; ++slices)
        hidden.submit([&](VkCommandBuffer buffer) {
            vk::Commands commands(hidden.device(), buffer);
            isFilled = executor.uploadRest(commands, 40004);
        });
    EXPECT_GT(slices, 10);
    for (std::uint32_t b = 0; b < program.buffers.size(); ++b) {
        if (program.buffers[b].initialOf) continue;
        Words contents(executor.view({b}).size / 4);
        const std::vector<std::byte>& initial = program.buffers[b].initial;
        std::memcpy(contents.data(), initial.data(), initial.size());
        EXPECT_TRUE(hidden.read(executor.view({b})) == contents) << program.buffers[b].label;
    }
}
