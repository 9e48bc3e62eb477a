// Tests of held and driven particles (sinew/holds.hpp) of all kinds of bodies.
#include "sinew/holds.hpp"

#include "sim/collision/collider_shapes.hpp"
#include "sim/runner.hpp"
#include "sim/scenes.hpp"
#include "sinew/bodies.hpp"
#include "sinew/colliders.hpp"
#include "sinew/validate.hpp"

#include <gtest/gtest.h>

#include <array>

using namespace sinew;
using namespace sinew::sim;
using Eigen::Vector3d;

namespace {

// A beam of 8 x 2 x 2 cells of 0.05 m along x, from x = 0.
LatticeCorners addBeam(Scene& scene, bool isCuttable = false) {
    return addLattice(scene, {.name = "beam",
                              .cells = {8, 2, 2},
                              .spacing = 0.05f,
                              .youngModulus = 1e5f,
                              .isCuttable = isCuttable});
}

Collider boxAt(const Vec3& center, float half) {
    Collider box{.shape = ColliderShape::box, .halfExtents = {half, half, half}};
    box.pose.position = center;
    return box;
}

// The end of the beam at x = 0.
const Plane lowEnd{.normal = {-1, 0, 0}, .offset = -0.001f};

std::vector<std::uint32_t> endOf(const Scene& scene) {
    return select(scene, scene.bodies[0], insideOf(lowEnd)).particles;
}

// Expects equal bits of the positions.
void expectUnmoved(const Scene& scene, const test::Runner& runner, std::span<const std::uint32_t> held) {
    const auto x = runner.positions();
    for (const std::uint32_t particle : held)
        ASSERT_EQ((x[particle] - test::toVector(scene.particles[particle].position)).norm(), 0) << particle;
}

TEST(Hold, SelectsWhatIsInsideAndSaysHowFarTheRestIs) {
    Scene scene;
    addChain(scene,
             {.origin = {0, 0, 0}, .direction = {1, 0, 0}, .particles = 11, .length = 1, .pinned = {}});
    Collider sphere{.radius = 0.15f};
    sphere.pose.position = {0.5f, 0, 0};
    EXPECT_EQ(select(scene, scene.bodies[0], insideOf(sphere)).particles,
              (std::vector<std::uint32_t>{4, 5, 6}));
    Collider capsule{.shape = ColliderShape::capsule, .radius = 0.05f, .halfLength = 0.2f};
    capsule.pose = {{0.9f, 0, 0}, test::turnedBy(90, {0, 0, 1})};
    EXPECT_EQ(select(scene, scene.bodies[0], insideOf(capsule)).particles,
              (std::vector<std::uint32_t>{7, 8, 9, 10}));
    EXPECT_EQ(select(scene, scene.bodies[0], insideOf(Plane{.normal = {1, 0, 0}, .offset = 0.85f})).particles,
              (std::vector<std::uint32_t>{9, 10}));
    const Selection none = select(scene, scene.bodies[0], insideOf(boxAt({-0.5f, 0, 0}, 0.2f)));
    EXPECT_TRUE(none.particles.empty());
    EXPECT_EQ(none.nearest, 0u);
    EXPECT_NEAR(none.gap, 0.3, 1e-6);
}

TEST(Hold, KeepsEveryBitOfAPlaceUnderGravityWithEverySolver) {
    for (const Solver solver : {Solver::split, Solver::jacobi, Solver::gaussSeidel})
        for (int kind = 0; kind < 3; ++kind) {
            SCOPED_TRACE(testing::PrintToString(solver) + ", kind " + std::to_string(kind));
            Scene scene;
            if (kind == 0) addBeam(scene);
            if (kind == 1) addCloth(scene, {.origin = {0, 0, 0}, .size = {9, 5}, .spacing = 0.05f});
            if (kind == 2)
                addChain(scene, {.origin = {0, 0, 0}, .direction = {1, 0, 0}, .particles = 9, .pinned = {}});
            const std::vector<std::uint32_t> held = endOf(scene);
            ASSERT_FALSE(held.empty());
            hold(scene, held);
            test::Runner runner(scene, {.solver = solver, .substeps = 8});
            ASSERT_EQ(runner.run(10).nonFinite, 0u);
            expectUnmoved(scene, runner, held);
            EXPECT_LT(runner.positions().back().y(), double{scene.particles.back().position.y} - 0.01);
        }
}

TEST(Hold, BendsABeamAsAClampOfTheSameParticlesDoes) {
    Scene clamped, held;
    const LatticeCorners corners = addBeam(clamped);
    for (std::uint32_t z = 0; z <= 2; ++z)
        for (std::uint32_t y = 0; y <= 2; ++y) clamped.fixed.push_back({corners.at(0, y, z)});
    addBeam(held);
    hold(held, endOf(held));
    EXPECT_EQ(test::hashOfRun(clamped, {.substeps = 8}, 20), test::hashOfRun(held, {.substeps = 8}, 20));
}

TEST(Hold, TwiceOrOverAPinIsOneHold) {
    Scene scene;
    addCloth(scene, {.size = {5, 4}, .spacing = 0.1f, .tethers = 1, .pinned = {0, 4}});
    const std::array<std::uint32_t, 3> some{0, 1, 2}, others{2, 1, 3};
    scene.particles[1].velocity = {1, 2, 3};
    hold(scene, some);
    hold(scene, others);
    EXPECT_EQ(scene.fixed.size(), 5u);
    EXPECT_EQ(scene.particles[1].velocity.y, 0);
    EXPECT_TRUE(validate(scene, {.substeps = 4}).empty());
    const std::array<std::uint32_t, 1> beyond{20};
    EXPECT_THROW(hold(scene, beyond), std::invalid_argument);
}

TEST(Hold, OfEverythingLetsNothingMove) {
    Scene scene;
    addBeam(scene);
    const Selection all = select(scene, scene.bodies[0], [](const Vec3&) { return -1.0; });
    hold(scene, all.particles);
    test::Runner runner(scene, {.substeps = 4, .sleeps = true});
    ASSERT_EQ(runner.run(5).nonFinite, 0u);
    expectUnmoved(scene, runner, all.particles);
}

TEST(Hold, OutlastsASavedState) {
    Scene scene;
    addBeam(scene);
    const std::vector<std::uint32_t> held = endOf(scene);
    hold(scene, held);
    test::Runner runner(scene, {.substeps = 8});
    runner.run(4);
    const test::Runner::Saved saved = runner.save();
    runner.run(6);
    const std::uint64_t first = runner.stateHash();
    runner.load(saved);
    runner.run(6);
    EXPECT_EQ(runner.stateHash(), first);
    expectUnmoved(scene, runner, held);
}

std::vector<Keyframe> liftAndTurn() {
    return {{0, {{0, 0.05f, 0.05f}, test::turnedBy(0, {1, 0, 0})}},
            {0.5f, {{0.1f, 0.25f, 0.05f}, test::turnedBy(60, {1, 0, 0})}}};
}

TEST(Drive, TakesPartOfAnyBodyAlongItsPathToRounding) {
    for (int kind = 0; kind < 4; ++kind) {
        SCOPED_TRACE("kind " + std::to_string(kind));
        Scene scene;
        if (kind < 2) addBeam(scene, kind == 1);
        if (kind == 2) addCloth(scene, {.origin = {0, 0, 0}, .size = {9, 5}, .spacing = 0.05f});
        if (kind == 3)
            addChain(scene, {.origin = {0, 0, 0}, .direction = {1, 0, 0}, .particles = 9, .pinned = {}});
        const std::vector<std::uint32_t> held = endOf(scene);
        drive(scene, held, liftAndTurn());
        ASSERT_TRUE(validate(scene, {.substeps = 8}).empty());
        test::Runner runner(scene, {.substeps = 8});
        const Pose begin = poseAt(scene.driven[0], 0);
        for (int step = 1; step <= 40; ++step) {
            ASSERT_EQ(runner.run(1).nonFinite, 0u);
            const Pose pose = poseAt(scene.driven[0], step / 60.0);
            const auto x = runner.positions();
            for (const std::uint32_t particle : held) {
                const Vec3 wanted = toWorld(pose, toLocal(begin, scene.particles[particle].position));
                ASSERT_LE((x[particle] - test::toVector(wanted)).norm(), 1e-6)
                    << "particle " << particle << ", step " << step;
            }
        }
        EXPECT_GT((runner.positions()[held[0]] - test::toVector(scene.particles[held[0]].position)).norm(),
                  0.1);
    }
}

TEST(Drive, GoesOnFromASavedStateWithTheSameBits) {
    Scene scene;
    addBeam(scene, true);
    drive(scene, endOf(scene), liftAndTurn());
    test::Runner runner(scene, {.substeps = 8});
    runner.run(6);
    const test::Runner::Saved saved = runner.save();
    runner.run(8);
    const std::uint64_t first = runner.stateHash();
    runner.load(saved);
    runner.run(8);
    EXPECT_EQ(runner.stateHash(), first);
}

// The path begins after the body has fallen asleep. One driven particle without a radius carries the rest by
// links.
TEST(Drive, WakesWhatSleepsOnIt) {
    Scene scene;
    scene.damping = 8;
    addChain(scene, {.origin = {0, 1, 0}, .particles = 5, .length = 0.5f, .compliance = 1e-3f, .pinned = {}});
    drive(scene, {0}, {{0, {{0, 1, 0}, {}}}, {6, {{0, 1, 0}, {}}}, {6.5f, {{0, 1.5f, 0}, {}}}});
    test::Runner runner(scene, {.substeps = 8, .sleeps = true});
    ASSERT_GT(runner.run(355).sleeping, 0u);
    const double before = runner.positions()[4].y();
    runner.run(45);
    EXPECT_GT(runner.positions()[4].y(), before + 0.3);
}

TEST(Drive, IsRefusedWithSolversThatHaveNoFormForIt) {
    Scene scene;
    addBeam(scene);
    drive(scene, endOf(scene), liftAndTurn());
    for (const Solver solver : {Solver::jacobi, Solver::gaussSeidel}) {
        const auto complaints = validate(scene, {.solver = solver, .substeps = 8});
        ASSERT_EQ(complaints.size(), 1u);
        EXPECT_NE(complaints[0].find("does not support bodies that are driven"), std::string::npos);
    }
    Scene twice = scene;
    drive(twice, {endOf(scene)[0]}, liftAndTurn());
    EXPECT_NE(validate(twice, {.substeps = 8}).at(0).find("which another has too"), std::string::npos);
    scene.driven[0].particles.push_back(100'000);
    EXPECT_NE(validate(scene, {.substeps = 8}).at(0).find("has particle 100000 of"), std::string::npos);
}

// A blade cuts the beam beside the held or driven particles: only the rest falls.
TEST(Hold, IsLeftBehindByWhatABladeCutsOff) {
    for (const bool isDriven : {false, true}) {
        SCOPED_TRACE(isDriven ? "driven" : "held");
        Scene scene;
        addBeam(scene, true);
        const std::vector<std::uint32_t> held = endOf(scene);
        if (isDriven)
            drive(scene, held, {{0, {}}, {10, {{0, 0.1f, 0}, {}}}});
        else
            hold(scene, held);
        test::Runner runner(scene, {.substeps = 8});
        runner.run(2);
        const std::array<Vec3, 2> from{{{0.075f, 1, -1}, {0.075f, 1, 1}}},
            to{{{0.075f, -1, -1}, {0.075f, -1, 1}}};
        EXPECT_GT(runner.cut({.from = from, .to = to}).linksCut, 0u);
        ASSERT_EQ(runner.run(40).nonFinite, 0u);
        const auto x = runner.positions();
        for (std::size_t i = 0; i < x.size(); ++i) {
            const Vec3& at = scene.particles[i].position;
            if (at.x > 0.08f) {
                EXPECT_LT(x[i].y(), double{at.y} - 1) << i;
            } else {
                EXPECT_GT(x[i].y(), double{at.y} - 0.05) << i;
            }
        }
        if (!isDriven) expectUnmoved(scene, runner, held);
    }
}

} // namespace
