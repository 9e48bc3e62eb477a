// Tests of the number of levels that "auto" takes.
#include "sim/motion_error.hpp"
#include "sim/reference/trajectory.hpp"
#include "sim/runner.hpp"
#include "sinew/bodies.hpp"
#include "sinew/material.hpp"
#include "sinew/substeps.hpp"
#include "sinew/validate.hpp"
#include "sinew/world.hpp"

#include <gtest/gtest.h>

#include <map>

namespace sinew::sim {
namespace {

const Settings bySum{.hasSharpClamp = false}, sharp{.hasSharpClamp = true};

using Numbers = std::map<std::uint32_t, std::uint32_t>; // levels by substeps

// A sheet of one metre, hung by two corners; with a skip stiffness that of scenes/cloth_study.toml.
Scene sheet(std::uint32_t cells, float compliance = 1e-3f, float skipStiffness = 0) {
    Scene scene;
    addCloth(scene, {.size = {cells + 1, cells + 1},
                     .spacing = 1 / static_cast<float>(cells),
                     .stretchCompliance = compliance,
                     .shearCompliance = 10 * compliance,
                     .skipStiffness = skipStiffness,
                     .pinned = {0, cells}});
    return scene;
}

Scene box(std::array<std::uint32_t, 3> cells, float spacing = 0.02f) {
    Scene scene;
    addLattice(scene, {.cells = cells, .spacing = spacing, .youngModulus = 1e5f});
    return scene;
}

Numbers chosenFor(const Scene& scene, std::initializer_list<std::uint32_t> substeps, Settings settings = {}) {
    Numbers numbers;
    settings.levels = autoLevels;
    for (const std::uint32_t n : substeps) {
        settings.substeps = n;
        const SubstepChoice choice = chooseSubsteps(scene, settings);
        EXPECT_EQ(choice.substeps, n);
        EXPECT_EQ(choice.reason, SubstepReason::asked);
        numbers[n] = choice.levels;
    }
    return numbers;
}

// The rows of docs/levels.md, "The choice by auto".
TEST(LevelChoice, IsWhatWinsAtEqualError) {
    for (const bool isSharp : {false, true}) { // which makes no difference in sheets
        EXPECT_EQ(chosenFor(sheet(32, 1e-3f, 10), {4, 8, 16, 23, 32, 64, 128}, {.hasSharpClamp = isSharp}),
                  (Numbers{{4, 3}, {8, 3}, {16, 2}, {23, 1}, {32, 1}, {64, 0}, {128, 0}}));
        EXPECT_EQ(chosenFor(sheet(64, 1e-3f, 10), {8, 16, 32, 64, 128, 256}, {.hasSharpClamp = isSharp}),
                  (Numbers{{8, 4}, {16, 3}, {32, 2}, {64, 1}, {128, 0}, {256, 0}}));
    }
    EXPECT_EQ(chosenFor(box({15, 15, 15}), {4, 8, 11, 16, 23}, bySum),
              (Numbers{{4, 2}, {8, 2}, {11, 1}, {16, 0}, {23, 0}}));
    EXPECT_EQ(chosenFor(box({31, 31, 31}, 0.01f), {4, 8, 16, 32}, bySum),
              (Numbers{{4, 3}, {8, 2}, {16, 2}, {32, 0}}));
    EXPECT_EQ(chosenFor(box({7, 7, 7}, 0.04f), {1, 2, 4}), (Numbers{{1, 0}, {2, 0}, {4, 0}})) << "too small";
}

// The sharp clamp, which levels cannot have, reaches the same error in 0.63 times the time in a solid.
TEST(LevelChoice, IsComparedWithTheSharpClampWhereThereIsOne) {
    EXPECT_EQ(chosenFor(box({15, 15, 15}), {4, 6, 8, 11, 16}, sharp),
              (Numbers{{4, 2}, {6, 2}, {8, 0}, {11, 0}, {16, 0}}));
    EXPECT_EQ(chosenFor(box({31, 31, 31}, 0.01f), {4, 8, 11, 16}, sharp),
              (Numbers{{4, 3}, {8, 2}, {11, 2}, {16, 0}}));
    for (const Scene& scene : {box({15, 15, 15}), box({47, 11, 11})}) {
        const SubstepChoice choice = chooseSubsteps(scene, {.levels = autoLevels, .hasSharpClamp = true});
        EXPECT_EQ(choice.levels, 0u);
        EXPECT_EQ(choice.substeps, chooseSubsteps(scene, sharp).substeps);
        EXPECT_LT(choice.substeps, chooseSubsteps(scene, bySum).substeps);
    }
}

// A beam in 11 substeps with two levels is 0.48 % off, and takes as long as in 20 substeps with the sharp
// clamp (docs/levels.md, docs/clamp.md).
TEST(LevelChoice, OfASolidIsNoneWhereTheSharpClampIsNearerInTheSameTime) {
    Scene scene;
    const LatticeCorners corners =
        addLattice(scene, {.cells = {23, 5, 5}, .spacing = 0.02f, .youngModulus = 2e5f});
    for (std::uint32_t y = 0; y <= 5; ++y)
        for (std::uint32_t z = 0; z <= 5; ++z) scene.fixed.push_back({corners.at(0, y, z)});
    EXPECT_EQ(chosenFor(scene, {11}, bySum)[11], 2u);
    EXPECT_EQ(chosenFor(scene, {11}, sharp)[11], 0u);
    const reference::Trajectory truth = reference::trueTrajectory(scene, {.frames = 30, .tolerance = 1e-4});
    const double ofLevels = test::errorOf(scene, {.substeps = 11, .levels = 2}, truth),
                 ofSharp = test::errorOf(scene, {.substeps = 20, .hasSharpClamp = true}, truth);
    std::printf("11 substeps with two levels: %.3g %% of the motion, 20 with the sharp clamp: %.3g %%\n",
                100 * ofLevels, 100 * ofSharp);
    EXPECT_LT(2 * ofSharp, ofLevels);
}

TEST(LevelChoice, TakesAThirdOfTheSubstepsWhereThatIsToBeChosenToo) {
    const Settings automatic{.levels = autoLevels, .hasSharpClamp = false};
    for (const auto& [scene, levels] : {std::pair{box({15, 15, 15}), 2u}, std::pair{sheet(32), 1u}}) {
        const SubstepChoice choice = chooseSubsteps(scene, automatic);
        EXPECT_EQ(choice.levels, levels);
        EXPECT_NEAR(choice.substeps, chooseSubsteps(scene, bySum).substeps / 3.0, 1);
        const Settings chosen = withSubsteps(scene, automatic);
        EXPECT_EQ(chosen.substeps, choice.substeps);
        EXPECT_EQ(chosen.levels, levels);
        EXPECT_EQ(inspectStiffness(scene, chosen).soft, 0u) << "levels carry the rest";
    }
    const Scene small = box({4, 4, 4});
    EXPECT_EQ(chooseSubsteps(small, automatic).levels, 0u);
    EXPECT_EQ(chooseSubsteps(small, automatic).substeps, chooseSubsteps(small, bySum).substeps);
    EXPECT_EQ(toText(Settings{.substeps = 16, .levels = 2}), "16 substeps and 2 levels");
    EXPECT_EQ(toText(Settings{.substeps = 16}), "16 substeps");
}

// One level, which suits most particles, carries less of a solid than two do.
TEST(LevelChoice, TakesSubstepsForTheLevelsThatItTakes) {
    Scene scene = box({15, 15, 15});
    addLattice(scene, {.origin = {1, 0, 0}, .cells = {8, 8, 8}, .spacing = 0.02f, .youngModulus = 2e5f});
    const Settings chosen = withSubsteps(scene, {.levels = autoLevels, .hasSharpClamp = false});
    EXPECT_EQ(chosen.levels, 1u);
    EXPECT_EQ(inspectStiffness(scene, chosen).soft, 0u);
}

TEST(LevelChoice, IsNoneWhereLevelsCannotBe) {
    Scene scene = sheet(32);
    EXPECT_EQ(chosenFor(scene, {8}, {.solver = Solver::jacobi}), (Numbers{{8, 0}}));
    EXPECT_EQ(chosenFor(scene, {8}, {.omega = 3.1f}), (Numbers{{8, 0}}));
    EXPECT_EQ(chosenFor(scene, {8}, {.keepsForces = true}), (Numbers{{8, 0}}));
    EXPECT_EQ(chosenFor(sheet(32, 0), {8}), (Numbers{{8, 0}})) << "rigid links";
    scene.dampingTime = 0.01f;
    EXPECT_EQ(chosenFor(scene, {8}), (Numbers{{8, 0}}));
    EXPECT_TRUE(validate(scene, {.substeps = 8, .levels = autoLevels}).empty());
    EXPECT_EQ(chosenFor({}, {8}), (Numbers{{8, 0}})) << "nothing";
}

// A large body decides, not a small one beside it.
TEST(LevelChoice, IsThatOfMostParticles) {
    Scene scene = sheet(64);
    addLattice(scene, {.origin = {3, 0, 0}, .cells = {4, 4, 4}, .spacing = 0.02f, .youngModulus = 1e5f});
    EXPECT_EQ(chosenFor(scene, {32}), (Numbers{{32, 2}}));
    addLattice(scene, {.origin = {5, 0, 0}, .cells = {24, 24, 24}, .spacing = 0.02f, .youngModulus = 1e4f});
    EXPECT_EQ(chosenFor(scene, {32}), (Numbers{{32, 0}}));
}

TEST(LevelChoice, RunsAsTheNumberThatItIs) {
    const Scene scene = sheet(24);
    const std::uint32_t levels = chooseSubsteps(scene, {.substeps = 8, .levels = autoLevels}).levels;
    ASSERT_GT(levels, 0u);
    EXPECT_EQ(test::hashOfRun(scene, {.substeps = 8, .levels = autoLevels}, 10),
              test::hashOfRun(scene, {.substeps = 8, .levels = levels}, 10));
}

// Parts of a world bring levels, which stay.
TEST(LevelChoice, OfAWorldGrowsWithItsParts) {
    Scene ground;
    ground.planes.push_back({});
    World world(test::device(), ground, {.substeps = 8, .levels = autoLevels});
    EXPECT_EQ(world.settings().levels, 0u);
    const auto settle = [&] {
        do {
            const VkCommandBuffer commands = test::queue().begin();
            world.recordChanges(commands);
            test::queue().wait(test::queue().submit(commands));
        } while (world.isChanging());
    };
    const VkCommandBuffer commands = test::queue().begin();
    world.simulation().recordReset(commands);
    test::queue().wait(test::queue().submit(commands));
    const PartId part = world.add(sheet(32));
    settle();
    EXPECT_EQ(world.settings().levels,
              chooseSubsteps(sheet(32), {.substeps = 8, .levels = autoLevels}).levels);
    world.remove(part);
    settle();
    EXPECT_GT(world.settings().levels, 0u);
}

} // namespace
} // namespace sinew::sim
