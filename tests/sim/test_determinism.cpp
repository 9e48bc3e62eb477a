// Tests for equal bits from run to run, after a reset, and with reversed invocation order. The number of
// threads of a software device is fixed for a process, so compare_thread_counts.cmake runs this binary once
// for each number.
#include "sim/compile/compile.hpp"
#include "sim/device/gpu_executor.hpp"
#include "sim/runner.hpp"
#include "sim/scenes.hpp"
#include "sim_test_kernels.hpp"

#include <gtest/gtest.h>

#include <cinttypes>

using namespace sinew;
using namespace sinew::sim;

namespace {

constexpr int steps = 20;

// Scenes of several work groups that fall onto planes with friction and restitution.
std::vector<test::NamedScene> scenes() {
    std::vector<test::NamedScene> result{{"block", test::block(6, 0.05f, 1e5f)},
                                         {"sheet", test::sheet(16, 1e-5f)},
                                         {"chain", test::chain(300, {1e-4f, true})}};
    for (test::NamedScene& named : result) {
        test::addRoom(named.scene);
        test::disturb(named.scene, 0.01f, 1);
        named.scene.damping = 0.1f;
    }
    return result;
}

class Determinism : public testing::TestWithParam<Solver> {
protected:
    Settings settings(bool isReversed = false) const {
        return {.solver = GetParam(), .substeps = 9, .iterations = 2, .isReversed = isReversed};
    }
};

// Item of every invocation of a test kernel in a program.
std::vector<std::uint32_t> itemsOf(bool isReversed, std::uint32_t count) {
    ProgramBuilder builder(isReversed);
    const BufferId items = builder.scratch<std::uint32_t>("items", count);
    builder.beginPhase("solve");
    builder.dispatch(test::kernels::itemIndex, count, {items}, count);
    const StepProgram program = builder.finish();
    GpuExecutor executor(test::device(), program);
    test::runOnce(executor);
    return test::queue().download<std::uint32_t>(executor.view(items));
}

} // namespace

TEST(Reversal, RunsTheItemsBackwards) {
    constexpr std::uint32_t count = 300; // the last group is partly idle
    const auto forwards = itemsOf(false, count), backwards = itemsOf(true, count);
    ASSERT_EQ(backwards.size(), count);
    for (std::uint32_t i = 0; i < count; ++i) {
        EXPECT_EQ(forwards[i], i);
        EXPECT_EQ(backwards[i], count - 1 - i);
    }
}

TEST_P(Determinism, ThreeRunsEndInTheSameBits) {
    for (const test::NamedScene& named : scenes()) {
        const std::uint64_t hash = test::hashOfRun(named.scene, settings(), steps);
        EXPECT_EQ(test::hashOfRun(named.scene, settings(), steps), hash) << named.name;
        EXPECT_EQ(test::hashOfRun(named.scene, settings(), steps), hash) << named.name;
        // Output for compare_thread_counts.cmake.
        std::printf("state_hash %s %s %016" PRIx64 "\n", named.name.c_str(), solverName(GetParam()), hash);
    }
}

TEST_P(Determinism, ReversedInvocationsEndInTheSameBits) {
    for (const test::NamedScene& named : scenes()) {
        EXPECT_EQ(test::hashOfRun(named.scene, settings(true), steps),
                  test::hashOfRun(named.scene, settings(), steps))
            << named.name;
    }
}

TEST_P(Determinism, ARunAfterAResetEndsInTheSameBits) {
    for (const test::NamedScene& named : scenes()) {
        test::Runner runner(named.scene, settings());
        runner.run(steps);
        const std::uint64_t hash = runner.stateHash();
        runner.reset();
        EXPECT_NE(runner.stateHash(), hash) << named.name;
        runner.run(steps);
        EXPECT_EQ(runner.stateHash(), hash) << named.name;
    }
}

INSTANTIATE_TEST_SUITE_P(Of, Determinism, testing::Values(Solver::jacobi, Solver::split, Solver::gaussSeidel),
                         [](const auto& parameter) { return solverName(parameter.param); });
