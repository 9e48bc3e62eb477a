// Tests the model of a GPU against times worked out by hand, and its tables.
#include "sinew/predict/flushes.hpp"
#include "sinew/predict/predict.hpp"

#include "all_kernels.hpp"
#include "app/guard.hpp"
#include "scenes/load.hpp"
#include "sim/compile/compile.hpp"

#include <gtest/gtest.h>

#include <cmath>

using namespace sinew;
using tools::Bound;
using tools::Card;
using tools::KernelCost;

namespace {

// 10 SIMDs that hold 16 waves of 32 each, 1 GHz, 100 GB/s.
const Card plain{"plain", 10, 32, 16, 1, 100, 5, 4};

std::string errorOf(const std::string& table) {
    try {
        tools::readCards(table, "my.csv");
    } catch (const app::Failure& failure) {
        return failure.code() == app::badInput ? failure.what() : "another code";
    }
    return "none";
}

const std::string heading = "name,simds,lanes,waves,ghz,gb_s,dispatch_us,empty_us\n";

tools::Prediction predictionOf(const char* scene, sim::Recording recording, const Card& card = plain) {
    scenes::LoadedScene loaded = scenes::load(SINEW_SOURCE_FOLDER "/scenes/" + std::string(scene) + ".toml");
    loaded.settings.forms = sim::completed(loaded.settings.forms, sim::DeviceKind::gpu);
    return tools::predict(sim::compile(loaded.scene, loaded.settings), card, tools::shippedKernels(),
                          recording);
}

} // namespace

TEST(PredictWork, IsTheLongestOfLatencyInstructionsAndMemory) {
    Bound bound{};
    // one wave of 1,000 cycles at 1 GHz
    EXPECT_DOUBLE_EQ(tools::workUs(plain, {32, 1000, 100}, 32, 0, bound), 1);
    EXPECT_EQ(bound, Bound::latency);
    // 8 of 32 waves, so 4 of 16, fit into a SIMD: 41 waves need a second round of 40
    EXPECT_DOUBLE_EQ(tools::workUs(plain, {8, 1000, 1}, 40 * 32, 0, bound), 1);
    EXPECT_DOUBLE_EQ(tools::workUs(plain, {8, 1000, 1}, 40 * 32 + 1, 0, bound), 2);
    // 160 waves on 10 SIMDs, each 100 cycles of its SIMD
    EXPECT_DOUBLE_EQ(tools::workUs(plain, {32, 1000, 100}, 160 * 32, 0, bound), 1.6);
    EXPECT_EQ(bound, Bound::issue);
    // 1 MB at 100 GB/s
    EXPECT_DOUBLE_EQ(tools::workUs(plain, {32, 1000, 100}, 32, 1e6, bound), 10);
    EXPECT_EQ(bound, Bound::memory);
}

TEST(PredictCards, AreReadOrRefusedWithTheLine) {
    const auto cards = tools::readCards("# a comment\n" + heading + "mine,1,2,3,4.5,6,7,8\n", "my.csv");
    ASSERT_EQ(cards.size(), 1u);
    EXPECT_EQ(cards[0].name, "mine");
    EXPECT_EQ(cards[0].ghz, 4.5);
    EXPECT_EQ(cards[0].emptyUs, 8);
    EXPECT_EQ(errorOf("name,simds\n"),
              "cannot read cards: my.csv:1: expected the heading " + heading.substr(0, heading.size() - 1));
    EXPECT_EQ(errorOf(heading), "cannot read cards: my.csv:2: there is no card");
    EXPECT_EQ(errorOf(heading + "mine,1,2\n"), "cannot read cards: my.csv:2: expected 8 fields");
    for (const char* wrong : {"0", "-1", "nan", "inf", "", "1x", " 1"})
        EXPECT_EQ(errorOf(heading + "mine,1,2,3,4,5,6," + wrong + "\n"),
                  "cannot read cards: my.csv:2: \"" + std::string(wrong) + "\" is no number above 0");
    EXPECT_THROW(tools::loadCards("/nowhere/cards.csv"), app::Failure);
    EXPECT_THROW(tools::loadCards("/proc/self/mem/cards.csv"), app::Failure);
    EXPECT_THROW(tools::loadCards("/"), app::Failure);
}

TEST(PredictCards, ThatDoNotExistAreAnsweredByThoseThatDo) {
    try {
        tools::findCard(tools::shippedCards(), "h300");
        FAIL();
    } catch (const app::Failure& failure) {
        EXPECT_EQ(failure.code(), app::wrongUsage);
        EXPECT_STREQ(failure.what(), "--predict: no card \"h300\": choose h200, rx6900xt, rtx4060m, xelp96");
    }
}

TEST(PredictKernels, AreKnownAll) {
    const tools::KernelCosts known = tools::shippedKernels();
    for (const vk::ShaderCode* code : sim::kernels::all)
        EXPECT_TRUE(known.contains(std::string_view(code->name)))
            << code->name << " is not in kernels.csv: tools/kernel_costs.py makes it";
}

// The links of a cube: its gathers wait for each other, so the step takes at least their dispatches.
TEST(Predict, CountsDependentDispatchesOfAStep) {
    const tools::Prediction cube = predictionOf("cube", sim::plainStep);
    EXPECT_TRUE(cube.unknown.empty());
    EXPECT_EQ(cube.indirect, 0u);
    EXPECT_DOUBLE_EQ(cube.leastUs, cube.mostUs);
    EXPECT_GE(cube.barriers, 32u); // its substeps
    EXPECT_GT(cube.mostUs, plain.dispatchUs * static_cast<double>(cube.barriers));
    Card quick = plain;
    quick.dispatchUs = 1;
    EXPECT_NEAR(cube.mostUs - predictionOf("cube", sim::plainStep, quick).mostUs,
                4 * static_cast<double>(cube.barriers), 1e-6);
    double sum = 0;
    for (const tools::PassCost& pass : cube.passes) sum += pass.mostUs;
    EXPECT_NEAR(sum, cube.mostUs, 1e-9 * sum);
}

TEST(Predict, NamesTheLongestDispatchAndWarnsOfOneTooLong) {
    const tools::Prediction cube = predictionOf("cube", sim::plainStep);
    EXPECT_EQ(cube.longest, "gather_node");
    EXPECT_GT(cube.longestUs, 0);
    Card slow = plain;
    slow.ghz = 1e-3 * cube.longestUs / tools::longestAllowedUs;
    const auto textOn = [](const Card& card) {
        scenes::LoadedScene loaded = scenes::load(SINEW_SOURCE_FOLDER "/scenes/cube.toml");
        loaded.settings.forms = sim::completed(loaded.settings.forms, sim::DeviceKind::gpu);
        return tools::predictionText(sim::compile(loaded.scene, loaded.settings), card,
                                     tools::shippedKernels());
    };
    EXPECT_NE(textOn(plain).find("longest dispatch: gather_node, "), std::string::npos);
    EXPECT_EQ(textOn(plain).find("warning"), std::string::npos);
    EXPECT_NE(textOn(slow).find("warning: a dispatch of more than 100 ms"), std::string::npos);
}

TEST(Flushes, AreThoseOfTheKindsOfWorkBesideABarrier) {
    const auto programOf = [](const char* scene) {
        scenes::LoadedScene loaded =
            scenes::load(SINEW_SOURCE_FOLDER "/scenes/" + std::string(scene) + ".toml");
        loaded.settings.forms = sim::completed(loaded.settings.forms, sim::DeviceKind::gpu);
        return sim::compile(loaded.scene, loaded.settings);
    };
    const sim::StepProgram cubeProgram = programOf("cube");
    const tools::FlushCount cube = tools::countFlushes(cubeProgram, sim::plainStep);
    EXPECT_EQ(cube.barriers, 34u);
    EXPECT_EQ(cube.afterTransfers, 1u) << "behind the data of the step";
    EXPECT_EQ(cube.beforeArguments, 0u);
    EXPECT_EQ(cube.radv, 5 * 34u + 5);
    EXPECT_EQ(cube.anv, 4 * 34u + 2);
    const tools::FlushCount clutter = tools::countFlushes(programOf("clutter"), sim::plainStep);
    EXPECT_EQ(clutter.radv, 5 * (clutter.barriers + clutter.afterTransfers));
    EXPECT_EQ(clutter.anv, 4 * (clutter.barriers + clutter.beforeArguments) + 2 * clutter.afterTransfers);
    EXPECT_LT(clutter.beforeArguments, clutter.barriers);
    EXPECT_LT(clutter.afterTransfers, 4u);
    const std::string text = tools::flushText(cubeProgram);
    EXPECT_NE(text.find("if each ordered all kinds of work: 340 on RADV, 340 on ANV"), std::string::npos)
        << text;
}

TEST(Predict, SaysHowMuchDependsOnIndirectDispatches) {
    const tools::Prediction whole = predictionOf("clutter", sim::plainStep);
    const tools::Prediction calm = predictionOf("clutter", sim::calmStep);
    EXPECT_GT(whole.indirect, 0u);
    EXPECT_LT(whole.leastUs, whole.mostUs);
    EXPECT_LT(calm.dispatches, whole.dispatches);
    EXPECT_LT(calm.leastUs, whole.leastUs);
}
