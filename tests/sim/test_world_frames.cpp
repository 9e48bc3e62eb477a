// Take-overs of a world between frames: with steps in flight, and on devices whose memory the host does not
// see.
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

// Records a step and asks for the take-over behind it, before anything of that is submitted.
bool isTakenBehind(World& world, vk::Queue& queue, const Step& step) {
    while (!world.isReady()) {
        const VkCommandBuffer commands = queue.begin();
        EXPECT_FALSE(world.recordChanges(commands) && !world.isReady());
        queue.wait(queue.submit(commands));
    }
    const VkCommandBuffer commands = queue.begin();
    world.simulation().record(commands, step);
    EXPECT_EQ(world.simulation().oldestInFlight(), step.frame);
    const bool isTaken = world.recordChanges(commands);
    queue.wait(queue.submit(commands));
    return isTaken;
}

} // namespace

TEST(World, TakesOverBehindStepsInFlightWithTheSameBits) {
    const Settings settings{.substeps = 6, .contactRoom = 64};
    std::array<Words, 2> results;
    for (const bool isInFlight : {false, true}) {
        vk::Queue& queue = test::queue();
        World world(test::device(), ground(), settings);
        const PartId part = world.add(slidingBoxes());
        std::uint64_t frame = 0;
        const auto submit = [&](const auto& record) {
            const VkCommandBuffer commands = queue.begin();
            record(commands);
            queue.wait(queue.submit(commands));
        };
        const auto step = [&](VkCommandBuffer commands) {
            world.simulation().record(commands, {.dt = ground().dt, .frame = frame++});
        };
        submit([&](VkCommandBuffer commands) { world.simulation().recordReset(commands); });
        while (!world.find(part)) submit([&](VkCommandBuffer commands) { world.recordChanges(commands); });
        for (int s = 0; s < 10; ++s) submit(step);
        const PartId far = world.add(stranger());
        // recorded, and neither submitted nor finished, when the other simulation takes over
        const auto change = [&](VkCommandBuffer commands) {
            if (isInFlight) {
                EXPECT_EQ(world.simulation().oldestInFlight(), 10u);
            }
            EXPECT_TRUE(world.recordChanges(commands));
        };
        submit([&](VkCommandBuffer commands) { EXPECT_FALSE(world.recordChanges(commands)) << "it begins"; });
        while (!world.isReady()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
        if (isInFlight) {
            submit([&](VkCommandBuffer commands) {
                for (int s = 0; s < 3; ++s) step(commands);
                change(commands);
                step(commands);
            });
        } else {
            for (int s = 0; s < 3; ++s) submit(step);
            submit(change);
            submit(step);
        }
        for (std::uint64_t f = 10; f < frame; ++f) EXPECT_TRUE(world.status(f).isFinished) << "step " << f;
        EXPECT_TRUE(world.find(far));
        for (int s = 0; s < 10; ++s) submit(step);
        for (const vk::BufferView& view : {world.simulation().positions(), world.simulation().velocities()}) {
            const Words words = test::wordsOf(view);
            results[isInFlight].insert(results[isInFlight].end(), words.begin(), words.end());
        }
    }
    EXPECT_TRUE(results[0] == results[1]);
}

// The host cannot know yet what such a step leaves behind.
TEST(World, WaitsForStepsInFlightWhoseEndMayDiffer) {
    const float dt = ground().dt;
    const HostCollider ball{.radius = 0.05f, .pose = {.position = {3, 3, 3}}};
    const std::array<Step, 4> steps{{{.dt = dt},
                                     {.dt = dt, .repeats = true},
                                     {.dt = 0.5f * dt},
                                     {.dt = dt, .hostColliders = std::span(&ball, 1)}}};
    for (std::size_t kind = 0; kind < steps.size(); ++kind) {
        SCOPED_TRACE(kind);
        const bool hasColliders = kind == 3;
        Play play(ground(), {.substeps = 4, .contactRoom = 64, .hostColliders = hasColliders ? 1u : 0u});
        play.add(stranger());
        play.run(3);
        play.world().add(stranger(50));
        Step step = steps[kind];
        step.frame = play.steps();
        EXPECT_EQ(isTakenBehind(play.world(), test::queue(), step), kind == 0);
        play.settle();
        EXPECT_EQ(play.world().scene().bodies.size(), 2u);
    }
}

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
