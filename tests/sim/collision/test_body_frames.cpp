// Tests of body frames: contact lists stay valid while a body moves as a whole, and no pair is ever missed.
#include "common/layout.h"
#include "sim/program/program.hpp"
#include "sim/runner.hpp"
#include "sinew/bodies.hpp"
#include "sinew/start.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <limits>
#include <optional>
#include <string>
#include <utility>

namespace sinew::sim {
namespace {

constexpr float spacing = 0.05f;

// Adds a box of voxels with its corner at `origin`.
void addBox(Scene& scene, Vec3 origin, std::array<std::uint32_t, 3> cells, const Start& how) {
    const std::size_t first = scene.bodies.size();
    addLattice(scene, {.origin = origin,
                       .cells = cells,
                       .spacing = spacing,
                       .youngModulus = 2e5f,
                       .radius = 0.45f * spacing});
    start(scene, first, how);
}

Settings settingsWith(float margin = 0.5f, bool isReversed = false) {
    return {.substeps = 16, .contactMargin = margin, .contactRoom = 200, .isReversed = isReversed};
}

// Number of times that the lists of a hash grid were built in `steps` steps.
std::uint32_t buildsIn(const Scene& scene, int steps, const std::string& grid = "grid") {
    test::Runner runner(scene, settingsWith());
    const Status status = runner.run(steps);
    EXPECT_FALSE(status.isUndone);
    const Simulation& simulation = runner.simulation();
    const std::vector<GridBuffers>& grids = simulation.program().grids;
    const auto found = std::ranges::find(grids, grid, &GridBuffers::name);
    if (found == grids.end()) {
        ADD_FAILURE() << "no grid " << grid;
        return 0;
    }
    return test::queue().download<layout::GridBounds>(simulation.view(found->bounds))[0].builds;
}

} // namespace

TEST(BodyFrames, KeepListsOfWhatFallsFliesAndTurns) {
    struct Case {
        const char* name;
        Start how;
    };
    for (const Case& one : {Case{"falls", {}}, Case{"flies", {.velocity = {30, 10, -20}}},
                            Case{"turns", {.velocity = {1, 2, 3}, .spin = {4, -5, 3}}}}) {
        Scene scene;
        addBox(scene, {0, 0, 0}, {6, 4, 4}, one.how);
        const std::uint32_t builds = buildsIn(scene, 30);
        std::printf("%s: lists made %u times in 480 substeps\n", one.name, builds);
        EXPECT_LE(builds, 40u) << one.name;
    }
}

// Edges of a coarse sheet that moves by many margins.
TEST(BodyFrames, KeepListsOfEdgesOfWhatFallsFliesAndTurns) {
    const std::pair<const char*, Start> cases[] = {{"falls", {}},
                                                   {"flies", {.velocity = {30, 10, -20}}},
                                                   {"turns", {.velocity = {1, 2, 3}, .spin = {4, -5, 3}}}};
    for (const auto& [name, how] : cases) {
        Scene scene;
        const std::size_t first = scene.bodies.size();
        addCloth(scene, {.size = {6, 5}, .spacing = 0.1f, .membraneStiffness = 500, .thickness = 0.01f});
        start(scene, first, how);
        const std::uint32_t builds = buildsIn(scene, 30, "edges.grid");
        std::printf("%s: lists of edges made %u times in 480 substeps\n", name, builds);
        EXPECT_LE(builds, 40u) << name;
    }
}

// A body that swings about a fixed edge, whose particles share its frame.
TEST(BodyFrames, KeepListsOfWhatSwings) {
    Scene scene;
    addBox(scene, {0, 0, 0}, {8, 2, 3}, {});
    for (Particle& particle : scene.particles)
        if (particle.position.x < 0.5f * spacing && particle.position.y < 0.5f * spacing)
            particle.inverseMass = 0;
    const std::uint32_t builds = buildsIn(scene, 60);
    std::printf("swings: lists made %u times in 960 substeps\n", builds);
    EXPECT_LE(builds, 90u);
}

// A sheet that swings from two corners bends, so that no frame fits it, but its particles keep their
// velocities for some substeps. Without headings lists were made 167 times.
TEST(BodyFrames, KeepListsOfASheetThatBends) {
    Scene scene;
    addCloth(scene, {.size = {30, 30}, .spacing = 0.02f, .thickness = 0.01f, .pinned = {0, 29}});
    const std::uint32_t builds = buildsIn(scene, 20, "faces.grid");
    std::printf("bends: lists made %u times in 320 substeps\n", builds);
    EXPECT_LE(builds, 80u);
}

TEST(BodyFrames, KeepListsOfBodiesThatFallApartFromEachOther) {
    Scene scene;
    for (int b = 0; b < 5; ++b)
        addBox(scene, {0.6f * static_cast<float>(b), 0, 0}, {4, 4, 4},
               {.velocity = {0, static_cast<float>(3 * b), 0}});
    const std::uint32_t builds = buildsIn(scene, 20);
    std::printf("lists made %u times in 320 substeps\n", builds);
    EXPECT_LE(builds, 20u);
}

// The bodies beyond the number of frames share one frame with the loose particles.
TEST(BodyFrames, ServeMoreBodiesThanThereAreFrames) {
    Scene scene;
    for (int b = 0; b < FRAME_MOST_BODIES + 20; ++b)
        addBox(scene, {0.2f * static_cast<float>(b % 12), 0.2f * static_cast<float>(b / 12), 0}, {1, 1, 1},
               {});
    EXPECT_LE(buildsIn(scene, 10), 10u);
}

// Bodies meet, rotate and part again. The result must not depend on when lists are built.
TEST(BodyFrames, MissNoPair) {
    Scene scene;
    addBox(scene, {0, 0.1f, 0}, {4, 4, 4}, {.velocity = {4, 0, 0}, .spin = {3, 6, -4}});
    addBox(scene, {0.6f, 0.15f, 0.05f}, {3, 5, 3}, {.velocity = {-6, 0, 0}, .spin = {-8, 2, 5}});
    addBox(scene, {0.3f, 0.6f, 0}, {5, 2, 5}, {.velocity = {0, -3, 0}, .spin = {0, 12, 0}});
    for (int b = 0; b < 6; ++b)
        scene.particles.push_back({.position = {0.1f * static_cast<float>(b), 0.9f, 0.1f},
                                   .velocity = {0, -2.0f * static_cast<float>(b), 0},
                                   .inverseMass = 5,
                                   .radius = 0.03f});
    scene.planes.push_back({.normal = {0, 1, 0}, .friction = 0.4f});
    scene.contacts.friction = 0.4f;
    const std::uint64_t hash = test::hashOfRun(scene, settingsWith(), 60);
    for (const float margin : {0.1f, 0.25f, 1.0f, 2.0f})
        EXPECT_EQ(test::hashOfRun(scene, settingsWith(margin), 60), hash) << "margin " << margin;
    EXPECT_EQ(test::hashOfRun(scene, settingsWith(0.5f, true), 60), hash);
}

// Two boxes fly at each other and pass through each other's full length in one substep, at each phase of a
// step.
TEST(BodyFrames, MissNoPairThatPassesInASubstep) {
    for (int phase = 0; phase < 16; ++phase) {
        Scene scene;
        scene.gravity = {};
        const float apart = 2.2f + 0.105f * static_cast<float>(phase); // relative motion is 0.42 m a substep
        addBox(scene, {0, 0, 0}, {4, 4, 4}, {.velocity = {50, 0, 0}});
        const std::size_t second = scene.particles.size();
        addBox(scene, {apart, 0.01f, 0.02f}, {4, 4, 4}, {.velocity = {-50, 0, 0}});
        test::Runner runner(scene, {.substeps = 4, .contactRoom = 128});
        EXPECT_FALSE(runner.run(6).isUndone);
        const auto x = runner.positions();
        double first = 0, last = 0;
        for (std::size_t i = 0; i < x.size(); ++i) (i < second ? first : last) += x[i].x();
        EXPECT_LT(first, last) << "phase " << phase;
    }
}

// Sheets fold, flutter and meet themselves and each other.
TEST(BodyFrames, MissNoPairOfSheets) {
    Scene scene;
    addCloth(scene, {.origin = {-0.3f, 0.6f, -0.3f},
                     .right = {1, 0, 0},
                     .down = {0, 0.1f, 0.995f},
                     .size = {13, 13},
                     .spacing = spacing,
                     .thickness = 0.03f});
    addBox(scene, {-0.1f, 0.9f, -0.1f}, {3, 2, 3}, {.velocity = {0, -4, 0}, .spin = {5, 3, 0}});
    addBox(scene, {-0.1f, 0, -0.1f}, {3, 3, 3}, {});
    scene.planes.push_back({.normal = {0, 1, 0}, .friction = 0.3f});
    const std::uint64_t hash = test::hashOfRun(scene, settingsWith(), 40);
    for (const float margin : {0.15f, 1.0f, 2.0f})
        EXPECT_EQ(test::hashOfRun(scene, settingsWith(margin), 40), hash) << "margin " << margin;
}

// The speed that counts is that against the frame. A body of more particles than are searched one by one
// (MOST_FAST) was slowed down once it flew by more than a radius in a substep.
TEST(BodyFrames, SlowNothingDownThatFliesAsAWhole) {
    for (const float speed : {30.0f, 100.0f, 1000.0f})
        for (const Vec3 spin : {Vec3{}, Vec3{4, -5, 3}, Vec3{20, 0, 15}})
            for (const bool sleeps : {false, true}) {
                Scene scene;
                scene.gravity = {};
                addBox(scene, {0, 0, 0}, {7, 6, 6}, {.velocity = {speed, 0, 0}, .spin = spin});
                ASSERT_GT(scene.particles.size(), std::size_t{MOST_FAST});
                Settings settings = settingsWith();
                settings.sleeps = sleeps;
                test::Runner runner(scene, settings);
                std::uint32_t slowed = 0;
                for (int step = 0; step < 20; ++step) slowed += runner.run(1).slowed;
                EXPECT_EQ(slowed, 0u) << speed << " m/s, sleeps: " << sleeps;
                double mass = 0, momentum = 0;
                const auto v = runner.velocities();
                for (std::size_t i = 0; i < v.size(); ++i) {
                    const double m = 1 / double{scene.particles[i].inverseMass};
                    mass += m;
                    momentum += m * v[i].x();
                }
                EXPECT_NEAR(momentum / mass, double{speed}, 1e-4 * double{speed});
            }
}

// Before lists exist a particle has no body in its list entry. All were measured against the first frame,
// here that of a bullet, and a lattice at rest was thrown along.
TEST(BodyFrames, LeaveAtRestWhatABulletFarAwayDoesNotTouch) {
    Scene scene;
    scene.gravity = {};
    scene.particles.push_back(
        {.position = {0, 8, 0}, .velocity = {90, 0, 0}, .inverseMass = 1, .radius = 0.02f});
    addBox(scene, {0, 0, 0}, {7, 6, 6}, {});
    test::Runner runner(scene, settingsWith());
    EXPECT_EQ(runner.run(1).slowed + runner.run(1).slowed, 0u);
    const auto v = runner.velocities();
    EXPECT_NEAR(v[0].x(), 90, 1e-3);
    for (std::size_t i = 1; i < v.size(); ++i) ASSERT_LE(v[i].norm(), 1e-3) << i;
}

// An undone step leaves no lists either: none of both bodies may be slowed down in the next one.
TEST(BodyFrames, SlowNothingDownAfterAStepThatIsUndone) {
    Scene scene;
    scene.gravity = {};
    addBox(scene, {0, 0, 0}, {7, 6, 6}, {.velocity = {60, 0, 0}});
    addBox(scene, {0, 30, 0}, {3, 3, 3}, {});
    test::Runner runner(scene, settingsWith());
    std::uint32_t slowed = 0;
    for (int step = 0; step < 4; ++step) slowed += runner.run(1).slowed;
    runner.writePosition(5, std::numeric_limits<float>::quiet_NaN());
    EXPECT_TRUE(runner.run(1).isUndone);
    for (int step = 0; step < 4; ++step) {
        const Status status = runner.run(1);
        EXPECT_FALSE(status.isUndone);
        slowed += status.slowed;
    }
    EXPECT_EQ(slowed, 0u);
    const auto v = runner.velocities();
    for (std::size_t i = 0; i < 392; ++i) ASSERT_NEAR(v[i].x(), 60, 1e-2) << i;
}

// If too much is too fast, what moves is slowed down. A body at rest that shares a frame with it must not
// move on with it.
TEST(BodyFrames, LeaveAtRestWhatAFastBodyPasses) {
    Scene scene;
    scene.gravity = {};
    addBox(scene, {0, 0, 0}, {7, 6, 6}, {});
    const std::size_t second = scene.particles.size();
    addBox(scene, {-0.6f, 0.5f, 0}, {7, 6, 6}, {.velocity = {64, 0, 0}}); // 3 radii a substep
    test::Runner runner(scene, settingsWith());
    for (int step = 0; step < 3; ++step) ASSERT_FALSE(runner.run(1).isUndone);
    const auto v = runner.velocities();
    double most = 0;
    for (std::size_t i = 0; i < second; ++i) most = std::max(most, v[i].norm());
    EXPECT_LE(most, 1e-2);
    EXPECT_GT(v[second].x(), 1);
}

// Two large bodies meet: what both share as a motion must not hide what they meet.
TEST(BodyFrames, MissNoPairOfLargeBodiesThatMeetFast) {
    for (const float speed : {2.0f, 8.0f, 15.0f}) {
        Scene scene;
        scene.gravity = {};
        addBox(scene, {0, 0, 0}, {6, 6, 6}, {.velocity = {speed, 0, 0}});
        addBox(scene, {0.6f, 0.02f, 0.01f}, {6, 6, 6}, {.velocity = {-speed, 0, 0}});
        std::optional<std::uint64_t> hash;
        for (const float margin : {0.25f, 0.5f, 1.0f}) {
            test::Runner runner(scene, settingsWith(margin));
            ASSERT_FALSE(runner.run(20).isUndone);
            const std::uint64_t one = runner.stateHash();
            EXPECT_EQ(hash.value_or(one), one) << "margin " << margin << ", " << speed << " m/s";
            hash = one;
        }
    }
}

} // namespace sinew::sim
