// A body ends in the same bits whether or not another one, far from it, is fast. One fast particle makes the
// passes of contacts look at the paths of all particles in that substep.
#include "common/layout.h"
#include "sim/collision/contact_scenes.hpp"
#include "sim/collision/face_scenes.hpp"
#include "sim/runner.hpp"
#include "sinew/bodies.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>
#include <vector>

using namespace sinew;
using namespace sinew::sim;
using Eigen::Vector3d;

namespace {

constexpr float radius = test::ballRadius;
using test::ballAt, test::fixedBallAt;

// The body that lies far from the others.
enum class Far : std::uint8_t { rests, fastBall, fastBody };

Scene pile(const ContactSettings& contacts) {
    Scene scene;
    test::addBalls(scene, 3, 2.2f * radius, 0.1f * radius, {0, 0.2f, 0});
    scene.contacts = contacts;
    scene.planes = {{.friction = contacts.friction,
                     .restitution = contacts.restitution,
                     .staticFriction = contacts.staticFriction}};
    return scene;
}

// Boxes that slide on a floor towards a slope, and upon each other.
Scene boxes(bool haveFaces = false, bool areCuttable = false) {
    Scene scene;
    for (std::uint32_t b = 0; b < 3; ++b) {
        addLattice(scene,
                   {.name = "box " + std::to_string(b),
                    .origin = {0.03f * static_cast<float>(b), 0.02f + 0.16f * static_cast<float>(b), 0},
                    .cells = {3 - b / 2, 2, 2 + b / 2},
                    .spacing = 0.05f,
                    .youngModulus = 5e4f,
                    .radius = 0.02f,
                    .isCuttable = areCuttable});
        if (haveFaces) addSurfaceFaces(scene, scene.grids.back());
    }
    for (Particle& particle : scene.particles) particle.velocity = {0.4f, 0, 0.1f};
    scene.contacts.friction = 0.4f;
    scene.planes = {{.friction = 0.4f}, {.normal = {-0.6f, 0.8f, 0}, .offset = -0.2f, .friction = 0.3f}};
    return scene;
}

Scene boxesOnColliders() {
    Scene scene = boxes();
    scene.planes.clear();
    scene.colliders = {
        {.radius = 0.3f, .friction = 0.5f, .pose = {.position = {0.1f, -0.3f, 0.1f}}},
        {.shape = ColliderShape::box, .halfExtents = {2, 0.1f, 2}, .pose = {.position = {0, -0.4f, 0}}}};
    return scene;
}

Scene beside(Scene scene, Far far) {
    scene.particles.push_back(fixedBallAt({-6, 2, 0}));
    const float speed = far == Far::fastBall ? 60 : 0;
    scene.particles.push_back(ballAt({-6, 2 + 2 * radius, 0}, {-speed, speed, 0}));
    const std::size_t first = scene.particles.size();
    addLattice(scene, {.name = "far",
                       .origin = {-3, 4, 3},
                       .cells = {2, 2, 2},
                       .spacing = 0.05f,
                       .youngModulus = 1e3f,
                       .radius = 0.02f});
    std::mt19937 random(7);
    std::uniform_real_distribution<float> speeds(-20, 20);
    for (std::size_t i = first; far == Far::fastBody && i < scene.particles.size(); ++i)
        scene.particles[i].velocity = {speeds(random), speeds(random), speeds(random)};
    return scene;
}

// Whether the last substep looked at paths.
bool isSwept(const Simulation& simulation) {
    return std::ranges::any_of(simulation.program().grids, [&](const GridBuffers& grid) {
        return test::queue().download<layout::GridBounds>(simulation.view(grid.bounds))[0].isSwept != 0;
    });
}

struct Case {
    const char* name;
    Scene scene;
    Settings settings;
};

Settings settingsOf(const Forms& forms, bool isReversed = false) {
    return {.substeps = 8, .contactRoom = 64, .forms = forms, .isReversed = isReversed};
}

std::vector<Case> cases() {
    const Settings usual = settingsOf({});
    Settings forces = usual, sleeping = usual;
    forces.keepsForces = true;
    sleeping.sleeps = true;
    return {{"Boxes", boxes(), usual},
            {"BoxesByLoads", boxes(), settingsOf({.usesTexels = false})},
            {"BoxesByNode", boxes(), settingsOf({.columns = 1, .chunk = 1})},
            {"BoxesByLists", boxes(), settingsOf({.usesGrids = false})},
            {"BoxesReversed", boxes(), settingsOf({}, true)},
            {"BoxesWithForces", boxes(), forces},
            {"BoxesThatSleep", boxes(), sleeping},
            {"BoxesWithFaces", boxes(true, true), usual},
            {"BoxesOnColliders", boxesOnColliders(), usual},
            {"Pile", pile({.friction = 0.3f, .staticFriction = 0.6f}), usual},
            {"PileByLoads", pile({.friction = 0.5f}), settingsOf({.usesTexels = false})},
            {"PileThatRebounds", pile({.friction = 0.3f, .restitution = 0.5f}), usual},
            {"Sheets", test::crossedSheets(0.1f), usual}};
}

class FastElsewhere : public testing::TestWithParam<Case> {};

} // namespace

TEST_P(FastElsewhere, ChangesNoBit) {
    const Case& one = GetParam();
    constexpr int steps = 30;
    std::vector<std::vector<Vector3d>> expected;
    int sweptAtRest = 0;
    for (const Far far : {Far::rests, Far::fastBall, Far::fastBody}) {
        test::Runner runner(beside(one.scene, far), one.settings);
        int swept = 0;
        for (std::size_t step = 0; step < steps; ++step) {
            ASSERT_FALSE(runner.run(1).isUndone);
            swept += isSwept(runner.simulation()) ? 1 : 0;
            std::vector<Vector3d> state = runner.positions();
            const std::vector<Vector3d> velocities = runner.velocities();
            state.resize(one.scene.particles.size());
            state.insert(state.end(), velocities.begin(),
                         velocities.begin() + static_cast<std::ptrdiff_t>(state.size()));
            if (far == Far::rests)
                expected.push_back(state);
            else
                ASSERT_EQ(state, expected[step]) << "step " << step;
        }
        if (far == Far::rests) sweptAtRest = swept;
        if (far == Far::fastBody) {
            EXPECT_GT(swept, sweptAtRest + steps / 2) << "else the runs do not differ";
        }
    }
}

// A ball passes another one that sleeps. It touches it in the middle of a substep, not at the ends.
TEST(FastElsewhere, DecidesNotWhoWakes) {
    constexpr float way = 0.01f; // of a substep
    for (const bool isFast : {false, true}) {
        Scene scene = test::weightless();
        const float substep = scene.dt / 8;
        scene.particles = {ballAt({0, 0, 0}),
                           ballAt({-800.5f * way, 2 * radius - 1e-4f, 0}, {way / substep, 0, 0}),
                           ballAt({-6, 4, 0}, {0, isFast ? 60.0f : 0.0f, 0})};
        test::Runner runner(scene, {.substeps = 8, .sleeps = true});
        EXPECT_GE(runner.run(90).sleeping, 1u) << "before";
        const Status status = runner.run(20);
        EXPECT_EQ(status.sleeping, isFast ? 0u : 1u) << "fast: " << isFast;
    }
}

INSTANTIATE_TEST_SUITE_P(Of, FastElsewhere, testing::ValuesIn(cases()),
                         [](const testing::TestParamInfo<Case>& one) { return std::string(one.param.name); });
