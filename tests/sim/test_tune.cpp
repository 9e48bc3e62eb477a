// Tests of the measurement at start: it takes the fastest of the tried forms for any clock, and changes no
// bit.
#include "sim/compile/compile.hpp"
#include "sim/device/gpu_compile.hpp"
#include "sim/runner.hpp"
#include "sim/scenes.hpp"
#include "sinew/bodies.hpp"
#include "sinew/gpu_tune.hpp"

#include <gtest/gtest.h>

#include <algorithm>

using namespace sinew;
using namespace sinew::sim;

namespace {

// Runs the recorded commands and returns the next of the given times, then 1 ms.
class Clock {
public:
    explicit Clock(std::function<double(std::size_t trial)> ms) : ms_(std::move(ms)) {}
    TimedSubmit submit() {
        return [this](const std::function<void(VkCommandBuffer)>& record) {
            const VkCommandBuffer commands = test::queue().begin();
            record(commands);
            test::queue().wait(test::queue().submit(commands));
            constexpr std::size_t submissionsOfATrial = 6; // reset, warm-up, four measured
            return ms_(submissions_++ / submissionsOfATrial);
        };
    }

private:
    std::function<double(std::size_t)> ms_;
    std::size_t submissions_ = 0;
};

} // namespace

TEST(Tuning, TakesTheFastestTrial) {
    const Scene scene = test::block(6, 0.05f, 1e5f);
    for (std::size_t fastest = 0; fastest < 5; ++fastest) {
        Clock clock([&](std::size_t trial) { return trial == fastest ? 1.0 : 2.0; });
        const Tuning tuning = tune(test::device(), scene, {}, clock.submit(), DeviceKind::software);
        ASSERT_GE(tuning.trials.size(), 5u) << "as given and: texels, two chunks, columns, shared memory; on "
                                               "a GPU: three marches, shared memory";
        EXPECT_EQ(tuning.fastest, tuning.trials[fastest].forms) << "trial " << fastest;
    }
}

TEST(Tuning, TriesNoFormOutOfRange) {
    Clock clock([](std::size_t) { return 1.0; });
    const Tuning tuning = tune(test::device(), test::block(2, 0.05f, 1e5f), {.forms = {.chunk = 65535}},
                               clock.submit(), DeviceKind::software);
    EXPECT_EQ(tuning.trials.size(), 5u) << "as given, texels, half the chunk, columns, shared memory";
}

TEST(Tuning, OfAGpuBeginsWithOneNodeAnInvocation) {
    Clock clock([](std::size_t) { return 1.0; });
    const Tuning tuning =
        tune(test::device(), test::block(3, 0.05f, 1e5f), {}, clock.submit(), DeviceKind::gpu);
    EXPECT_EQ(tuning.fastest, (Forms{.columns = 1, .chunk = 1}));
    const auto triesNode = [](const Trial& trial) {
        return trial.forms.columns == 1 && trial.forms.chunk == 1;
    };
    EXPECT_EQ(std::ranges::count_if(tuning.trials, triesNode), 2) << "from global and from shared memory";
    const Tuning given = tune(test::device(), test::block(3, 0.05f, 1e5f),
                              {.forms = {.columns = 2, .chunk = 16}}, clock.submit(), DeviceKind::gpu);
    EXPECT_EQ(given.fastest, (Forms{.columns = 2, .chunk = 16})) << "what a host gives is kept";
    EXPECT_TRUE(std::ranges::any_of(given.trials, triesNode)) << "and more is tried";
}

TEST(Tuning, LeavesOpenFormsToTheDevice) {
    EXPECT_EQ(completed({}, DeviceKind::software), (Forms{.columns = 2, .chunk = 16}));
    EXPECT_EQ(completed({}, DeviceKind::gpu), (Forms{.columns = 1, .chunk = 1}));
    EXPECT_EQ(completed({.chunk = 3}, DeviceKind::gpu), (Forms{.columns = 1, .chunk = 3}));
    EXPECT_EQ(completed({.columns = 2, .chunk = 5}, DeviceKind::gpu), (Forms{.columns = 2, .chunk = 5}));
}

TEST(Tuning, KeepsWhatWasGivenWithinTheNoise) {
    Clock clock([](std::size_t trial) { return trial == 0 ? 1.0 : 0.98; });
    const Tuning tuning = tune(test::device(), test::block(6, 0.05f, 1e5f), {}, clock.submit());
    EXPECT_EQ(tuning.fastest, completed({}, kindOf(test::device())));
}

TEST(Tuning, TriesNothingWhereThereIsNoChoice) {
    Clock clock([](std::size_t) { return 1.0; });
    EXPECT_TRUE(tune(test::device(), test::block(3, 0.05f, 1e5f), {.solver = Solver::jacobi}, clock.submit())
                    .trials.empty());
    EXPECT_EQ(tune(test::device(), test::chain(20, {1e-4f}), {}, clock.submit()).trials.size(), 2u)
        << "texels or loads";
}

TEST(Tuning, ChoosesForColoredSweepsToo) {
    const Scene scene = test::block(4, 0.05f, 1e5f);
    for (const float warmStart : {0.9f, 0.0f})
        for (std::size_t fastest = 0; fastest < 2; ++fastest) {
            Clock clock([&](std::size_t trial) { return trial == fastest ? 1.0 : 2.0; });
            const Tuning tuning =
                tune(test::device(), scene, {.solver = Solver::gaussSeidel, .warmStart = warmStart},
                     clock.submit());
            ASSERT_EQ(tuning.trials.size(), 2u) << "texels or loads";
            EXPECT_NE(tuning.trials[0].forms.usesTexels, tuning.trials[1].forms.usesTexels);
            EXPECT_EQ(tuning.fastest, tuning.trials[fastest].forms) << "trial " << fastest;
        }
}

TEST(Tuning, TimesBothFormsOfLinksWithBendsAndDamping) {
    Clock clock([](std::size_t) { return 1.0; });
    Scene damped = test::chain(20, {1e-4f});
    damped.dampingTime = 0.01f;
    EXPECT_EQ(tune(test::device(), damped, {}, clock.submit()).trials.size(), 2u);
    Scene bent = test::chain(20, {1e-4f});
    bent.bends.push_back({0, 1, 2, 1e-3f});
    for (const Solver solver : {Solver::split, Solver::gaussSeidel})
        EXPECT_EQ(tune(test::device(), bent, {.solver = solver}, clock.submit()).trials.size(), 2u);
}

TEST(Tuning, EveryFormItTriesGivesTheSameBits) {
    const Scene scene = test::block(6, 0.05f, 1e5f);
    for (const Solver solver : {Solver::split, Solver::gaussSeidel}) {
        Clock clock([](std::size_t trial) { return 1.0 / static_cast<double>(trial + 1); });
        std::vector<std::uint64_t> hashes;
        const Tuning tuning = tune(test::device(), scene, {.solver = solver}, clock.submit());
        for (const Trial& trial : tuning.trials) {
            test::Runner runner(scene, {.solver = solver, .substeps = 5, .forms = trial.forms});
            runner.run(3);
            hashes.push_back(runner.stateHash());
        }
        ASSERT_GE(hashes.size(), 2u) << solverName(solver);
        EXPECT_EQ(std::ranges::count(hashes, hashes.front()), static_cast<std::ptrdiff_t>(hashes.size()))
            << solverName(solver);
    }
}
