// Tests that a step recorded into several command buffers has the bits of a whole one, under validation
// across submissions.
#include "sim/scenes.hpp"
#include "sinew/bodies.hpp"
#include "sinew/simulation.hpp"
#include "sinew/vk/timestamps.hpp"
#include "support/device.hpp"
#include "support/host_device.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <map>

using namespace sinew;
using namespace sinew::sim;

namespace {

constexpr std::uint64_t steps = 3;

struct Played {
    std::vector<float> state;
    Status status;
    std::vector<double> times;
};

// `parts` submissions a step; 0 = the other overload.
Played play(const Scene& scene, const Settings& settings, std::size_t parts) {
    Simulation simulation(test::device(), scene, settings);
    vk::Timestamps times(test::device(), static_cast<std::uint32_t>(simulation.phases().size()));
    const VkCommandBuffer first = test::queue().begin();
    simulation.recordReset(first);
    test::queue().submit(first);
    for (std::uint64_t frame = 0; frame < steps; ++frame) {
        std::vector<VkCommandBuffer> buffers(std::max<std::size_t>(parts, 1));
        for (VkCommandBuffer& commands : buffers) commands = test::queue().begin();
        const Step step{.dt = scene.dt, .gravity = scene.gravity, .frame = frame};
        if (parts == 0)
            simulation.record(buffers[0], step, &times);
        else
            simulation.record(buffers, step, &times);
        for (const VkCommandBuffer commands : buffers) test::queue().submit(commands);
    }
    test::queue().waitIdle();
    Played played{{}, simulation.status(steps - 1), times.milliseconds()};
    for (const vk::BufferView& view : {simulation.positions(), simulation.velocities()})
        for (const float number : test::queue().download<float>(view)) played.state.push_back(number);
    return played;
}

// Dispatches by command buffer.
std::map<VkCommandBuffer, std::size_t> recorded;
PFN_vkCmdDispatch dispatch = nullptr;
PFN_vkCmdDispatchIndirect dispatchIndirect = nullptr;

VKAPI_ATTR void VKAPI_CALL countDispatch(VkCommandBuffer commands, std::uint32_t x, std::uint32_t y,
                                         std::uint32_t z) {
    ++recorded[commands];
    dispatch(commands, x, y, z);
}

VKAPI_ATTR void VKAPI_CALL countIndirect(VkCommandBuffer commands, VkBuffer arguments, VkDeviceSize offset) {
    ++recorded[commands];
    dispatchIndirect(commands, arguments, offset);
}

} // namespace

TEST(StepInParts, AreAboutEquallyLong) {
    test::HostDevice host;
    const auto replace = [&]<typename Function>(const char* name, Function& original, Function counting) {
        original = reinterpret_cast<Function>(host.original(name));
        host.replace(name, reinterpret_cast<PFN_vkVoidFunction>(counting));
    };
    replace("vkCmdDispatch", dispatch, &countDispatch);
    replace("vkCmdDispatchIndirect", dispatchIndirect, &countIndirect);
    Scene scene;
    addLattice(scene, {.cells = {5, 5, 5}, .spacing = 0.1f});
    constexpr std::size_t parts = 4;
    {
        const vk::Device device = vk::Device::borrow(host.handles());
        Simulation simulation(device, scene, {.substeps = 16});
        const vk::DeviceFunctions& functions = host.functions();
        const VkCommandPoolCreateInfo poolInfo{.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO,
                                               .queueFamilyIndex = host.queueFamily()};
        VkCommandPool pool = VK_NULL_HANDLE;
        ASSERT_EQ(functions.vkCreateCommandPool(host.handles().device, &poolInfo, nullptr, &pool),
                  VK_SUCCESS);
        const VkCommandBufferAllocateInfo info{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
                                               .commandPool = pool,
                                               .level = VK_COMMAND_BUFFER_LEVEL_PRIMARY,
                                               .commandBufferCount = parts};
        std::vector<VkCommandBuffer> buffers(parts);
        ASSERT_EQ(functions.vkAllocateCommandBuffers(host.handles().device, &info, buffers.data()),
                  VK_SUCCESS);
        const VkCommandBufferBeginInfo begin{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
        for (const VkCommandBuffer commands : buffers)
            ASSERT_EQ(functions.vkBeginCommandBuffer(commands, &begin), VK_SUCCESS);
        simulation.recordReset(buffers[0]);
        recorded.clear();
        simulation.record(buffers, {.dt = scene.dt, .gravity = scene.gravity});
        std::size_t all = 0;
        for (const auto& [commands, count] : recorded) all += count;
        EXPECT_EQ(recorded.size(), parts);
        EXPECT_GE(all, 16u);
        for (const VkCommandBuffer commands : buffers) {
            EXPECT_GT(2 * parts * recorded[commands], all) << "more than half of the mean";
            EXPECT_LT(parts * recorded[commands], 2 * all);
            functions.vkEndCommandBuffer(commands);
        }
        functions.vkDestroyCommandPool(host.handles().device, pool, nullptr);
    }
    for (const std::string& message : host.finish()) ADD_FAILURE() << message;
}

TEST(StepInParts, HasTheBitsOfAWholeOne) {
    for (const test::NamedScene& named : test::allScenes()) {
        SCOPED_TRACE(named.name);
        const Settings settings{.substeps = 4};
        const Played whole = play(named.scene, settings, 0);
        for (const std::size_t parts : {1u, 2u, 5u, 32u}) {
            const Played played = play(named.scene, settings, parts);
            EXPECT_EQ(std::memcmp(played.state.data(), whole.state.data(), 4 * whole.state.size()), 0)
                << parts << " parts";
            EXPECT_TRUE(played.status.isFinished);
            EXPECT_EQ(played.status.nonFinite, whole.status.nonFinite);
            EXPECT_EQ(played.times.size(), whole.times.size());
        }
    }
}
