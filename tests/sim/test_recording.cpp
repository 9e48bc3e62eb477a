// Tests of recording: it must not allocate, create buffers, or cost more than its dispatches. Runs without
// the validation layer, which allocates memory of its own.
#include "sim/count_allocations.hpp"
#include "sim/program/program.hpp"
#include "sim/scenes.hpp"
#include "sinew/bodies.hpp"
#include "sinew/simulation.hpp"
#include "sinew/vk/loader.hpp"
#include "sinew/vk/queue.hpp"
#include "support/host_device.hpp"
#include "vk/allocator.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <optional>
#include <utility>

using namespace sinew;
using namespace sinew::sim;

namespace {

// A device without validation, as in an application.
struct Application {
    vk::Loader loader;
    vk::Device device = vk::Device::create(loader.getInstanceProcAddr(), {});
    vk::Queue queue{device};

    void reset(Simulation& simulation) {
        const VkCommandBuffer commands = queue.begin();
        simulation.recordReset(commands);
        queue.wait(queue.submit(commands));
    }
};

Scene everything() {
    Scene scene = test::sheet(6, 1e-5f);
    test::addRoom(scene);
    scene.colliders = {
        {.radius = 0.1f, .restitution = 0.5f, .path = {{0, {}}, {1, {{1, 0, 0}, {0, 1, 0, 0}}}}}};
    return scene;
}

// A device that stops in the middle of a command buffer: copies after the first `most` are skipped. The state
// is global because Vulkan functions have no user pointer.
struct Stopping {
    PFN_vkCmdCopyBuffer copy = nullptr;
    PFN_vkCmdPipelineBarrier barrier = nullptr;
    int copies = 0, most = 0;
    bool isVisible = false;        // a barrier after the last copy makes it visible to the host
    bool isLastBehindThat = false; // such a barrier precedes the last copy
};
Stopping stopping;

void VKAPI_CALL copyWhileItGoes(VkCommandBuffer commands, VkBuffer from, VkBuffer to, std::uint32_t count,
                                const VkBufferCopy* regions) {
    stopping.isLastBehindThat = std::exchange(stopping.isVisible, false);
    if (stopping.copies++ < stopping.most) stopping.copy(commands, from, to, count, regions);
}

void VKAPI_CALL lookAtBarrier(VkCommandBuffer commands, VkPipelineStageFlags from, VkPipelineStageFlags to,
                              VkDependencyFlags flags, std::uint32_t count, const VkMemoryBarrier* barriers,
                              std::uint32_t buffers, const VkBufferMemoryBarrier* bufferBarriers,
                              std::uint32_t images, const VkImageMemoryBarrier* imageBarriers) {
    constexpr VkPipelineStageFlags transfer = VK_PIPELINE_STAGE_TRANSFER_BIT,
                                   later = transfer | VK_PIPELINE_STAGE_HOST_BIT;
    stopping.isVisible =
        stopping.isVisible || ((from & transfer) != 0 && (to & later) == later && count == 1 &&
                               (barriers->srcAccessMask & VK_ACCESS_TRANSFER_WRITE_BIT) != 0 &&
                               (barriers->dstAccessMask & VK_ACCESS_HOST_READ_BIT) != 0);
    stopping.barrier(commands, from, to, flags, count, barriers, buffers, bufferBarriers, images,
                     imageBarriers);
}

} // namespace

TEST(Recording, AllocatesNothing) {
    if (!test::canCountAllocations()) GTEST_SKIP() << "AddressSanitizer needs operator new for itself";
    std::unique_ptr<int> kept;
    EXPECT_EQ(test::countAllocations([&] { kept = std::make_unique<int>(1); }), 1u) << "the counter counts";
    Application application;
    for (const Solver solver : {Solver::jacobi, Solver::split, Solver::gaussSeidel}) {
        Simulation simulation(application.device, everything(), {.solver = solver});
        application.reset(simulation);
        vk::Timestamps timestamps(application.device, static_cast<std::uint32_t>(simulation.phases().size()));
        for (std::uint64_t frame = 0; frame < 3; ++frame) {
            const VkCommandBuffer commands = application.queue.begin();
            EXPECT_EQ(test::countAllocations([&] {
                          simulation.record(commands, {.frame = frame, .repeats = true}, &timestamps);
                          simulation.recordSkin(commands);
                      }),
                      0u);
            application.queue.wait(application.queue.submit(commands));
            EXPECT_EQ(simulation.status(frame).nonFinite, 0u);
        }
    }
}

TEST(Recording, OfAStepWithABladeAllocatesNothing) {
    if (!test::canCountAllocations()) GTEST_SKIP() << "AddressSanitizer needs operator new for itself";
    Application application;
    Scene scene{.name = "cube"};
    const Lattice lattice{.cells = {4, 4, 4}, .spacing = 0.1f, .radius = 0.05f, .isCuttable = true};
    addLatticeSkin(scene, lattice, addLattice(scene, lattice), {0.5f, 0.5f, 0.5f});
    Simulation simulation(application.device, scene, {.substeps = 2, .contactRoom = 64});
    application.reset(simulation);
    const vk::AllocatorStatistics before = application.device.allocator().statistics();
    for (std::uint64_t frame = 0; frame < 4; ++frame) {
        const float x = 0.05f + 0.1f * static_cast<float>(frame);
        const std::array from{Vec3{x, -1, -1}, Vec3{x, -1, 1}}, to{Vec3{x, 1, -1}, Vec3{x, 1, 1}};
        const VkCommandBuffer commands = application.queue.begin();
        EXPECT_EQ(test::countAllocations([&] {
                      simulation.record(commands, {.frame = frame, .blade = {.from = from, .to = to}});
                      simulation.recordSkin(commands);
                  }),
                  0u);
        application.queue.wait(application.queue.submit(commands));
        EXPECT_EQ(simulation.status(frame).pieces, frame + 2);
    }
    const vk::AllocatorStatistics after = application.device.allocator().statistics();
    EXPECT_EQ(after.used, before.used);
    EXPECT_EQ(after.reserved, before.reserved);
}

// A host may ask for the status while a step is running. The step counts as finished only after all data for
// the host have arrived.
TEST(Recording, OfAStepEndsWithTheMarkThatItHasFinished) {
    test::HostDevice host;
    stopping = {reinterpret_cast<PFN_vkCmdCopyBuffer>(host.original("vkCmdCopyBuffer")),
                reinterpret_cast<PFN_vkCmdPipelineBarrier>(host.original("vkCmdPipelineBarrier"))};
    host.replace("vkCmdCopyBuffer", reinterpret_cast<PFN_vkVoidFunction>(&copyWhileItGoes));
    host.replace("vkCmdPipelineBarrier", reinterpret_cast<PFN_vkVoidFunction>(&lookAtBarrier));
    Scene scene{.name = "cube"};
    addLattice(scene, {.cells = {2, 2, 2}, .spacing = 0.1f, .isCuttable = true});
    {
        const vk::Device device = vk::Device::borrow(host.handles());
        Simulation simulation(device, scene, {.substeps = 2});
        std::uint64_t frame = 0;
        const auto play = [&](int lost) { // of the copies of a whole step
            const int whole = std::exchange(stopping.copies, 0);
            stopping.most = whole - lost;
            host.submit([&](VkCommandBuffer commands) { simulation.record(commands, {.frame = frame}); });
        };
        stopping.most = 1000;
        host.submit([&](VkCommandBuffer commands) { simulation.recordReset(commands); });
        stopping.copies = 1000;
        play(0);
        ASSERT_LT(stopping.copies, 1000);
        EXPECT_TRUE(stopping.isLastBehindThat) << "else the mark may overtake what it marks";
        EXPECT_EQ(simulation.oldestInFlight(), std::nullopt);
        for (const int lost : {3, 2, 1}) { // counts, status, mark, in any order
            ++frame;
            play(lost);
            EXPECT_FALSE(simulation.status(frame).isFinished) << "without the last " << lost << " copies";
            EXPECT_EQ(simulation.oldestInFlight(), frame - (3u - static_cast<unsigned>(lost)));
        }
        ++frame;
        play(0);
        EXPECT_TRUE(simulation.status(frame).isFinished);
        EXPECT_EQ(simulation.status(frame).pieces, 1u);
    }
    EXPECT_EQ(host.finish(), std::vector<std::string>{}) << "validation";
}

TEST(Recording, OfAThousandSubstepsCostsSoMuchADispatch) {
    Application application;
    Simulation simulation(application.device, test::block(2, 0.1f, 1e5f), {.substeps = 1000});
    application.reset(simulation);
    std::size_t dispatches = 0;
    for (const Pass& pass : simulation.program()[List::step]) dispatches += pass.kind == PassKind::dispatch;
    ASSERT_EQ(dispatches, 1002u);
    double best = 1e30;
    for (std::uint64_t frame = 0; frame < 20; ++frame) {
        const VkCommandBuffer commands = application.queue.begin();
        const auto start = std::chrono::steady_clock::now();
        simulation.record(commands, {.frame = frame});
        const std::chrono::duration<double, std::nano> time = std::chrono::steady_clock::now() - start;
        best = std::min(best, time.count() / static_cast<double>(dispatches));
        application.queue.wait(application.queue.submit(commands));
        ASSERT_EQ(simulation.status(frame).nonFinite, 0u);
    }
    std::printf("recording takes %.0f ns a dispatch, barrier and push constants included\n", best);
}

TEST(Recording, GoesOnWhereTheDeviceHasMoved) {
    Application application;
    const auto create = [&] { return vk::Device::create(application.loader.getInstanceProcAddr(), {}); };
    vk::Device moved = create(), first = create();
    Simulation simulation(first, everything(), {.solver = Solver::split, .substeps = 4}),
        kept(application.device, everything(), {.solver = Solver::split, .substeps = 4});
    vk::Queue queue(first);
    moved = std::move(first);
    const auto play = [](vk::Queue& on, Simulation& played) {
        VkCommandBuffer commands = on.begin();
        played.recordReset(commands);
        for (std::uint64_t frame = 0; frame < 3; ++frame) played.record(commands, {.frame = frame});
        on.wait(on.submit(commands));
        std::optional<SceneChange> change = played.prepareChange(everything());
        commands = on.begin();
        EXPECT_TRUE(played.recordChange(commands, change.value()));
        played.record(commands, {.frame = 3});
        on.wait(on.submit(commands));
        return on.download<float>(played.positions());
    };
    EXPECT_EQ(play(queue, simulation), play(application.queue, kept));
}

TEST(Recording, AsksTheHostForBuffersOnlyWhenConstructed) {
    test::HostDevice host;
    VkPhysicalDeviceMemoryProperties memory;
    vk::HostDevice handles = host.handles();
    host.instanceFunctions().vkGetPhysicalDeviceMemoryProperties(handles.physicalDevice, &memory);
    auto allocator = vk::makeBlockAllocator(handles.device, host.functions(), memory);
    std::size_t created = 0, destroyed = 0;
    handles.buffers.create = [&](const VkBufferCreateInfo& info, vk::MemoryKind kind, const char* name) {
        ++created;
        return allocator->create(info, kind, name);
    };
    handles.buffers.destroy = [&](const vk::BufferAllocation& allocation) {
        ++destroyed;
        allocator->destroy(allocation);
    };
    {
        const vk::Device device = vk::Device::borrow(handles);
        Simulation simulation(device, everything(), {});
        const std::size_t atStart = created;
        EXPECT_GE(atStart, simulation.program().buffers.size());
        host.submit([&](VkCommandBuffer commands) { simulation.recordReset(commands); });
        for (std::uint64_t frame = 0; frame < 5; ++frame) {
            host.submit([&](VkCommandBuffer commands) {
                simulation.record(commands, {.frame = frame});
                simulation.recordSkin(commands);
            });
            EXPECT_EQ(simulation.status(frame).nonFinite, 0u);
        }
        EXPECT_EQ(created, atStart);
        EXPECT_EQ(destroyed, 0u);
    }
    EXPECT_EQ(destroyed, created);
    EXPECT_EQ(allocator->statistics().buffers, 0u);
    allocator.reset();
    EXPECT_EQ(host.finish(), std::vector<std::string>{}) << "validation";
}
