// Tests of material changes during a run: they act from the next step on, and before any motion they give the
// bits of a scene made with that material.
#include "sim/runner.hpp"
#include "sim/scenes.hpp"
#include "sinew/bodies.hpp"
#include "sinew/material.hpp"

#include <gtest/gtest.h>

using namespace sinew;
using namespace sinew::sim;

namespace {

constexpr Solver everySolver[] = {Solver::split, Solver::jacobi, Solver::gaussSeidel};

Settings settingsOf(Solver solver, std::uint32_t substeps = 8) {
    return {.solver = solver, .substeps = substeps, .iterations = solver == Solver::split ? 1u : 3u};
}

// A lattice that hangs from one end, with cell volumes for Poisson ratios above 1/4.
Scene beam(float youngModulus, float poissonRatio = 0.25f) {
    Scene scene{.name = "beam"};
    addLattice(
        scene,
        {.cells = {6, 2, 2}, .spacing = 0.1f, .youngModulus = youngModulus, .poissonRatio = poissonRatio});
    for (std::uint32_t i = 0; i < scene.particles.size(); ++i)
        if (scene.particles[i].position.x < 0.05f) scene.fixed.push_back({i});
    return scene;
}

Scene clothInARoom() {
    Scene scene = test::sheet(12, 1e-5f);
    test::addRoom(scene);
    return scene;
}

double lowest(const test::Runner& runner) {
    double y = HUGE_VAL;
    for (const Eigen::Vector3d& x : runner.positions()) y = std::min(y, x.y());
    return y;
}

// Changes the material before the first step and after a reset; expects the bits of a scene made with it.
void expectAsMadeSo(const Scene& scene, const Material& material, const Settings& settings) {
    const Scene turned = withMaterial(scene, material);
    const std::uint64_t wanted = test::hashOfRun(turned, settings, 20);
    EXPECT_NE(test::hashOfRun(scene, settings, 20), wanted) << "nothing was turned";
    test::Runner runner(scene, settings);
    ASSERT_TRUE(runner.change(turned));
    runner.run(20);
    EXPECT_EQ(runner.stateHash(), wanted);
    runner.reset();
    runner.run(20);
    EXPECT_EQ(runner.stateHash(), wanted) << "after a reset";
    ASSERT_TRUE(runner.change(scene));
    runner.reset();
    runner.run(20);
    EXPECT_EQ(runner.stateHash(), test::hashOfRun(scene, settings, 20)) << "turned back";
}

} // namespace

TEST(Material, TurnedBeforeTheFirstStepHasTheBitsOfASceneMadeSo) {
    for (const Solver solver : everySolver) {
        SCOPED_TRACE(::testing::PrintToString(solver));
        expectAsMadeSo(clothInARoom(), {.stiffness = 0.3f}, settingsOf(solver));
        expectAsMadeSo(clothInARoom(), {.damping = 2.0f, .friction = 0.9f}, settingsOf(solver));
        expectAsMadeSo(beam(1e6f), {.stiffness = 0.1f}, settingsOf(solver));
    }
}

TEST(Material, OfBodiesOnGridsWithVolumesAndOfWhatIsResident) {
    expectAsMadeSo(beam(1e5f, 0.45f), {.stiffness = 3.7f}, settingsOf(Solver::split));
    Settings resident = settingsOf(Solver::split);
    resident.forms.residentBytes = 32768;
    expectAsMadeSo(test::block(5, 0.1f, 1e5f, 0.05f), {.stiffness = 0.05f}, resident);
}

TEST(Material, OfBodiesIsTurnedOneByOne) {
    Scene scene = beam(1e5f);
    addLattice(scene, {.origin = {0, 1, 0}, .cells = {3, 3, 3}, .spacing = 0.1f, .youngModulus = 4e5f});
    expectAsMadeSo(scene, {.bodies = {1, 0.25f}}, settingsOf(Solver::jacobi));
    expectAsMadeSo(scene, {.bodies = {0.5f, 2}}, settingsOf(Solver::split));
}

TEST(Material, OfATenthOfTheStiffnessSagsTenTimesAsFar) {
    Scene scene = beam(4e6f);
    scene.gravity = {0, -0.5f, 0}; // bends only slightly
    scene.damping = 8;
    const Settings settings = settingsOf(Solver::split, 64);
    test::Runner runner(scene, settings), soft(withMaterial(scene, {.stiffness = 0.1f}), settings);
    runner.run(120);
    const double stiffSag = -lowest(runner);
    ASSERT_GT(stiffSag, 1e-5);
    ASSERT_TRUE(runner.change(withMaterial(scene, {.stiffness = 0.1f})));
    runner.run(240);
    soft.run(240);
    EXPECT_NEAR(-lowest(runner) / stiffSag, 10, 0.5);
    const auto changed = runner.positions(), made = soft.positions();
    for (std::size_t i = 0; i < made.size(); ++i) ASSERT_LT((changed[i] - made[i]).norm(), 2e-6) << i;
}

TEST(Material, DampsFromTheNextStepOn) {
    Scene scene = test::particleAt({0, 0, 0}, {1, 0, 0});
    scene.gravity = {};
    scene.damping = 1;
    for (const Solver solver : everySolver) {
        SCOPED_TRACE(::testing::PrintToString(solver));
        test::Runner runner(scene, settingsOf(solver));
        runner.run(30);
        ASSERT_TRUE(runner.change(withMaterial(scene, {.damping = 4.0f})));
        runner.run(30);
        EXPECT_NEAR(runner.velocities()[0].x(), std::exp(-0.5 - 2), 1e-4);
    }
}

TEST(Material, OfAStateGoneBackToIsThatOfNow) {
    const Scene scene = beam(1e6f), soft = withMaterial(scene, {.stiffness = 0.02f});
    const Settings settings = settingsOf(Solver::split);
    test::Runner runner(scene, settings);
    runner.run(5);
    const test::Runner::Saved saved = runner.save();
    ASSERT_TRUE(runner.change(soft));
    runner.run(10);
    const std::uint64_t wanted = runner.stateHash();
    runner.load(saved);
    runner.run(10);
    EXPECT_EQ(runner.stateHash(), wanted);
}

TEST(Material, OfASheetThatWasCutLeavesTheCut) {
    const Scene scene = test::cuttableSheet();
    const Settings settings = settingsOf(Solver::split);
    test::Runner runner(scene, settings);
    EXPECT_GT(runner.cut(test::bladeAcrossSheet()).linksCut, 0u);
    runner.run(1);
    const Status before = runner.run(1);
    ASSERT_EQ(before.pieces, 2u);
    const test::Runner::Saved saved = runner.save();
    ASSERT_TRUE(runner.change(withMaterial(scene, {.stiffness = 0.5f})));
    EXPECT_EQ(runner.run(4).pieces, 2u);
    test::Runner other(withMaterial(scene, {.stiffness = 0.5f}), settings);
    other.cut(test::bladeAcrossSheet());
    other.run(6);
    const auto x = runner.positions(), y = other.positions(); // at rest, so that only the cut differs
    for (std::size_t i = 0; i < x.size(); ++i) ASSERT_LT((x[i] - y[i]).norm(), 1e-5) << i;
    const std::uint64_t wanted = runner.stateHash();
    runner.load(saved);
    runner.run(4);
    EXPECT_EQ(runner.stateHash(), wanted);
}

TEST(Material, WakesWhatSleeps) {
    Scene scene = test::block(3, 0.1f, 1e5f, 0);
    scene.planes = {{.friction = 0.5f}};
    scene.damping = 2;
    Settings settings = settingsOf(Solver::split);
    settings.sleeps = true;
    test::Runner runner(scene, settings);
    ASSERT_GT(runner.run(400).sleeping, 0u);
    ASSERT_TRUE(runner.change(withMaterial(scene, {.stiffness = 0.1f})));
    EXPECT_EQ(runner.run(1).sleeping, 0u);
}

TEST(Material, ThatNeedsOtherPassesIsNoChange) {
    Scene scene = test::chain(4, {.compliance = 1e-4f});
    const test::Runner runner(scene, settingsOf(Solver::jacobi));
    test::Runner other(scene, settingsOf(Solver::jacobi));
    EXPECT_FALSE(other.change(withMaterial(scene, {.damping = 1.0f}))) << "a pass more";
    scene.dampingTime = 0.01f;
    EXPECT_FALSE(other.change(scene));
}

TEST(Material, OfOtherParticlesIsRefused) {
    Scene scene = test::chain(4, {.compliance = 1e-4f});
    test::Runner runner(scene, settingsOf(Solver::split));
    scene.particles[2].position.x += 0.01f;
    EXPECT_THROW(runner.change(scene), std::invalid_argument);
    scene = test::chain(4, {.compliance = 1e-4f});
    scene.distances[0].compliance = -1;
    EXPECT_THROW(runner.change(scene), std::invalid_argument);
}

TEST(Material, PreparedBeforeAnotherOneWasRecordedIsOutOfDate) {
    const Scene scene = test::chain(4, {.compliance = 1e-4f});
    test::Runner runner(scene, settingsOf(Solver::split));
    auto late = runner.simulation().prepareChange(withMaterial(scene, {.stiffness = 3}));
    ASSERT_TRUE(late && runner.change(withMaterial(scene, {.stiffness = 2})));
    const VkCommandBuffer commands = test::queue().begin();
    EXPECT_FALSE(runner.simulation().recordChange(commands, *late));
    test::queue().wait(test::queue().submit(commands));
    runner.run(10);
    EXPECT_EQ(runner.stateHash(),
              test::hashOfRun(withMaterial(scene, {.stiffness = 2}), settingsOf(Solver::split), 10));
}
