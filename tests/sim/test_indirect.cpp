// Tests of passes that a kernel switches on or off: errors of the builder, the printed form, and execution on
// the device under validation.
#include "common/layout.h"
#include "sim/device/gpu_executor.hpp"
#include "sim/runner.hpp"
#include "sim/scenes.hpp"
#include "sim_indirect_kernels.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

using namespace sinew;
using namespace sinew::sim;

namespace {

constexpr std::uint32_t count = 300; // the last group is partly idle

// A program with two switches and two runs a step, of which exactly one is executed.
struct Toggled {
    ProgramBuilder builder{false};
    BufferId arguments = builder.scratch<layout::DispatchArguments>("arguments", 2);
    BufferId runs = builder.scratch<std::uint32_t>("runs", count);
    IndirectItems items{arguments, 1, count};

    void addTurn() {
        builder.dispatch(test::kernels::toggleGroups, 1, {arguments}, layout::CountPush{count});
        builder.dispatchIndirect(test::kernels::countRuns, items, {runs}, layout::CountPush{count});
    }
};

} // namespace

TEST(Indirect, RunsAsManyGroupsAsAKernelSaysAndNoneWhereItSaysNone) {
    Toggled toggled;
    toggled.builder.beginPhase("solve");
    toggled.addTurn();
    const StepProgram program = toggled.builder.finish();
    GpuExecutor executor(test::device(), program);
    for (std::uint32_t step = 0; step < 5; ++step) {
        const VkCommandBuffer buffer = test::queue().begin();
        vk::Commands commands(test::device(), buffer);
        if (step == 0) executor.upload(commands);
        executor.step(commands, {}, {}, nullptr);
        test::queue().wait(test::queue().submit(buffer));
        const auto runs = test::queue().download<std::uint32_t>(executor.view(toggled.runs));
        EXPECT_EQ(runs, std::vector<std::uint32_t>(count, step / 2 + 1)) << "step " << step;
    }
}

TEST(Indirect, WaitsForItsArgumentsAndIsWaitedForBeforeTheyChange) {
    Toggled toggled;
    toggled.builder.beginPhase("solve");
    for (int turn = 0; turn < 4; ++turn) toggled.addTurn();
    const StepProgram program = toggled.builder.finish();
    for (std::size_t p = 1; p < program[List::step].size(); ++p)
        EXPECT_TRUE(hasBarrier({}, program[List::step][p])) << "pass " << p;
    GpuExecutor executor(test::device(), program);
    test::runOnce(executor);
    EXPECT_EQ(test::queue().download<std::uint32_t>(executor.view(toggled.runs)),
              std::vector<std::uint32_t>(count, 2));
}

TEST(Indirect, PrintsWhereItsNumberOfGroupsComesFrom) {
    Toggled toggled;
    toggled.builder.beginPhase("solve");
    toggled.addTurn();
    const std::string text = describe(toggled.builder.finish());
    const char* line = "count_runs               0..x300    runs:rw arguments[1]:i\n";
    EXPECT_NE(text.find(line), std::string::npos) << text;
}

TEST(Indirect, RefusesArgumentsThatAreNone) {
    Toggled toggled;
    toggled.builder.beginPhase("solve");
    const auto add = [&](const IndirectItems& items) {
        return test::refusal([&] {
            toggled.builder.dispatchIndirect(test::kernels::countRuns, items, {toggled.runs},
                                             layout::CountPush{count});
        });
    };
    EXPECT_NE(add({BufferId{}, 0, count}).find("does not exist"), std::string::npos);
    EXPECT_NE(add({toggled.runs, 0, count}).find("stride 4, must be 16"), std::string::npos);
    EXPECT_NE(add({toggled.arguments, 2, count}).find("argument 2 of buffer arguments, which has 2"),
              std::string::npos);
    EXPECT_NE(add({toggled.arguments, 0, 0}).find("nothing to do"), std::string::npos);
}

TEST(Indirect, RefusesAKernelThatWritesItsOwnArguments) {
    Toggled toggled;
    toggled.builder.beginPhase("solve");
    const std::string message = test::refusal([&] {
        toggled.builder.dispatchIndirect(test::kernels::toggleGroups, toggled.items, {toggled.arguments},
                                         layout::CountPush{count});
    });
    EXPECT_NE(message.find("toggle_groups: writes its own arguments"), std::string::npos) << message;
}
