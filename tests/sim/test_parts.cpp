// Tests that a step recorded into several command buffers has the bits of a whole one, under validation
// across submissions.
#include "sim/scenes.hpp"
#include "sinew/simulation.hpp"
#include "sinew/vk/timestamps.hpp"
#include "support/device.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

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

} // namespace

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
