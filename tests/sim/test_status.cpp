// Tests of the status of a step: a state that is not finite is reported and never published.
#include "sim/compile/compile.hpp"
#include "sim/runner.hpp"
#include "sim/scenes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

using namespace sinew;
using namespace sinew::sim;
using Eigen::Vector3d;

namespace {

class StatusOf : public testing::TestWithParam<Solver> {
protected:
    Settings settings() const { return {.solver = GetParam(), .substeps = 4}; }
};

// 300 free particles, two of which exceed the range of float within a step of 0.1 s.
Scene absurdParticles() {
    Scene scene = test::chain(300);
    scene.distances.clear();
    for (const std::size_t i : {131, 260}) {
        scene.particles[i].position = {3.3e38f, 0, 0};
        scene.particles[i].velocity = {3.3e38f, 0, 0};
    }
    return scene;
}

} // namespace

TEST_P(StatusOf, AFiniteStepNamesItsFrameAndNobody) {
    test::Runner runner(test::chain(6), settings());
    for (std::uint32_t frame = 0; frame < 6; ++frame) {
        const Status status = runner.run(1);
        EXPECT_EQ(status.frame, frame);
        EXPECT_EQ(status.nonFinite, 0u);
    }
}

TEST_P(StatusOf, AnAbsurdStepCountsTheBadParticlesAndNamesTheFirst) {
    test::Runner runner(absurdParticles(), settings());
    const Status status = runner.step(0.1f);
    EXPECT_EQ(status.nonFinite, 2u);
    EXPECT_EQ(status.firstBadParticle, 131u);
}

TEST_P(StatusOf, ADivergedSimulationKeepsItsLastFiniteState) {
    Scene scene = test::chain(6, {1e-4f});
    scene.particles[5].velocity = {1e37f, 0, 0}; // overflows after some finite steps
    scene.distances.pop_back();
    scene.gravity = {3e37f, 0, 0};
    test::Runner runner(scene, settings());
    std::vector<Vector3d> x = runner.positions(), v = runner.velocities();
    int step = 0;
    while (runner.run(1).nonFinite == 0) {
        ASSERT_LT(++step, 100000);
        x = runner.positions(), v = runner.velocities();
    }
    EXPECT_EQ(runner.positions(), x);
    EXPECT_EQ(runner.velocities(), v);
    for (const Vector3d& p : x) EXPECT_TRUE(p.cast<float>().allFinite());
    EXPECT_GT(runner.run(1).nonFinite, 0u) << "it stays reported";
    EXPECT_EQ(runner.positions(), x);
}

TEST_P(StatusOf, AResetSimulationIsFiniteAgain) {
    test::Runner runner(absurdParticles(), settings());
    const std::uint64_t start = runner.stateHash();
    ASSERT_GT(runner.step(0.1f).nonFinite, 0u);
    runner.reset();
    EXPECT_EQ(runner.stateHash(), start);
    EXPECT_EQ(runner.step(1e-6f).nonFinite, 0u);
}

TEST_P(StatusOf, AStepThatANaNHasSpoiltIsUndoneAndTheBodyGoesOn) {
    for (const Scene& scene : {test::chain(6, {1e-4f}), test::block(3, 0.1f, 1e5f)}) {
        test::Runner calm(scene, settings()), runner(scene, settings());
        calm.run(20);
        runner.run(10);
        const auto x = runner.positions(), v = runner.velocities();
        runner.writePosition(3, std::numeric_limits<float>::quiet_NaN());
        const Status spoilt = runner.run(1);
        EXPECT_GE(spoilt.nonFinite, 1u);
        EXPECT_EQ(runner.positions(), x) << "the last finite state";
        EXPECT_EQ(runner.velocities(), v);
        EXPECT_EQ(runner.run(10).nonFinite, 0u) << "nothing is left of it";
        const auto expected = calm.positions(), reached = runner.positions();
        for (std::size_t i = 0; i < expected.size(); ++i)
            EXPECT_LE((reached[i] - expected[i]).norm(), 1e-5)
                << "particle " << i; // rounding of y = x + theta h v
    }
}

TEST_P(StatusOf, WithoutPublicVelocitiesBodiesMoveAlikeAndAnUndoneStepLeavesThemAtRest) {
    for (const Scene& scene : {test::chain(6, {1e-4f}), test::block(3, 0.1f, 1e5f)}) {
        Settings lean = settings();
        lean.publishesVelocities = false;
        test::Runner full(scene, settings()), runner(scene, lean);
        EXPECT_TRUE(runner.velocities().empty());
        full.run(10);
        runner.run(10);
        const auto x = runner.positions();
        EXPECT_EQ(x, full.positions());
        runner.writePosition(3, std::numeric_limits<float>::quiet_NaN());
        EXPECT_GE(runner.run(1).nonFinite, 1u);
        EXPECT_EQ(runner.positions(), x) << "the last finite state";
        EXPECT_EQ(runner.run(1).nonFinite, 0u);
        EXPECT_LE((runner.positions()[0] - x[0]).norm(), 9.81 * double{scene.dt} * double{scene.dt} + 1e-4)
            << "from rest, not on with its velocity";
        lean.isReversed = true;
        test::Runner reversed(scene, lean);
        reversed.run(10);
        EXPECT_EQ(reversed.positions(), x);
    }
}

TEST_P(StatusOf, AStepThatHasNotFinishedIsToldFromOneThatHas) {
    Simulation simulation(test::device(), test::chain(6), settings());
    EXPECT_FALSE(simulation.status(0).isFinished) << "nothing ran";
    vk::Queue& queue = test::queue();
    for (int round = 0; round < 2; ++round) { // frames count from 0 again after a reset
        VkCommandBuffer commands = queue.begin();
        simulation.recordReset(commands);
        queue.wait(queue.submit(commands));
        for (std::uint64_t frame = 0; frame < 6; ++frame) {
            commands = queue.begin();
            simulation.record(commands, {.frame = frame});
            EXPECT_FALSE(simulation.status(frame).isFinished) << "recorded, whatever the round before left";
            EXPECT_EQ(simulation.oldestInFlight(), frame);
            queue.wait(queue.submit(commands));
            EXPECT_TRUE(simulation.status(frame).isFinished);
            EXPECT_FALSE(simulation.status(frame).isUndone);
            EXPECT_EQ(simulation.oldestInFlight(), std::nullopt);
            EXPECT_FALSE(simulation.status(frame + Simulation::framesInFlight).isFinished) << "not recorded";
            const std::uint64_t older = frame - Simulation::framesInFlight; // frame 0 has none
            EXPECT_FALSE(simulation.status(older).isFinished) << "its place was taken";
        }
    }
}

TEST_P(StatusOf, UndoneStepsAreCounted) {
    test::Runner runner(absurdParticles(), settings());
    for (std::uint64_t undone = 1; undone < 7; ++undone) {
        const Status status = runner.step(0.1f);
        EXPECT_TRUE(status.isUndone);
        EXPECT_EQ(status.stepsUndone, undone);
    }
}

INSTANTIATE_TEST_SUITE_P(A, StatusOf, testing::Values(Solver::jacobi, Solver::split, Solver::gaussSeidel),
                         [](const auto& parameter) { return solverName(parameter.param); });

TEST(Status, OfASceneWithoutParticlesIsFinished) {
    test::Runner runner{Scene{}};
    for (std::uint32_t frame = 0; frame < 6; ++frame) {
        const Status status = runner.run(1);
        EXPECT_TRUE(status.isFinished);
        EXPECT_FALSE(status.isUndone);
        EXPECT_EQ(status.frame, frame);
    }
    EXPECT_FALSE(runner.simulation().oldestInFlight());
}
