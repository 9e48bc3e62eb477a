// Tests of host colliders, kinematic colliders that the host moves: they push like colliders on paths, follow
// their target with bounded speed, and do not act while they are not listed.
#include "sim/collision/collider_shapes.hpp"
#include "sim/collision/contact_scenes.hpp"
#include "sim/compile/compile.hpp"
#include "sim/runner.hpp"
#include "sim/scenes.hpp"
#include "sinew/bodies.hpp"
#include "sinew/colliders.hpp"
#include "sinew/substeps.hpp"

#include <gtest/gtest.h>

#include <cinttypes>
#include <cmath>
#include <cstdio>
#include <limits>
#include <memory>

using namespace sinew;
using namespace sinew::sim;
using Eigen::Vector3d;

namespace {

constexpr float frame = 1.0f / 60;

class PushedByHost : public testing::TestWithParam<Solver> {
protected:
    Settings settings(std::uint32_t substeps = 8) const {
        return {.solver = GetParam(), .substeps = substeps, .hostColliders = 2};
    }
};

HostCollider sphereAt(const Vector3d& center, float radius = 0.1f) {
    return {.radius = radius, .pose = {.position = test::toFloats(center)}};
}

// A host collider of each shape; the shapes are flat.
std::vector<HostCollider> shapes() {
    return {{.radius = 0.15f},
            {.shape = ColliderShape::capsule, .radius = 0.08f, .halfLength = 0.1f},
            {.shape = ColliderShape::box, .halfExtents = {0.1f, 0.15f, 0.05f}, .staticFriction = 0.6f}};
}

Step stepOf(const Scene& scene, std::span<const HostCollider> hostColliders) {
    return {.dt = scene.dt, .gravity = scene.gravity, .hostColliders = hostColliders};
}

// A block of 3^3 cells of 0.1 m around the origin, without gravity.
Scene floatingBlock() {
    Scene scene = test::block(3, 0.1f, 5e4f, -0.15f);
    for (Particle& particle : scene.particles) {
        particle.position.x -= 0.15f;
        particle.position.z -= 0.15f;
    }
    scene.gravity = {0, 0, 0};
    return scene;
}

// A block just above a floor, beside a tilted box.
Scene blockInARoom() {
    Scene scene = test::block(3, 0.1f, 5e4f, 0.005f);
    scene.planes = {{.friction = 0.5f, .restitution = 0.3f}};
    Collider box{.shape = ColliderShape::box, .halfExtents = {0.1f, 0.4f, 0.4f}, .friction = 0.4f};
    box.pose = {{0.45f, 0.15f, 0.15f}, test::turnedBy(25, {0, 0, 1})};
    scene.colliders = {box};
    return scene;
}

double deepestIn(const HostCollider& hostCollider, const std::vector<Vector3d>& x) {
    double deepest = 0;
    for (const Vector3d& one : x)
        deepest = std::max(deepest, -test::gapOf(colliderOf(hostCollider), hostCollider.pose, one));
    return deepest;
}

double fastest(const std::vector<Vector3d>& v) {
    double most = 0;
    for (const Vector3d& one : v) most = std::max(most, one.norm());
    return most;
}

Vector3d centerOf(const std::vector<Vector3d>& x) {
    Vector3d sum = Vector3d::Zero();
    for (const Vector3d& one : x) sum += one;
    return sum / static_cast<double>(x.size());
}

Vector3d placeOf(const HostColliderState& state) {
    return test::toVector(state.hostCollider.pose.position);
}

// Hash of the state after a sphere has moved through the middle of a scene and back.
std::uint64_t hashOfStrokes(const Scene& scene, const Settings& settings, const Vector3d& middle) {
    test::Runner runner(scene, settings);
    std::array hostColliders{sphereAt(middle), sphereAt(middle + Vector3d(0, 0.2, 0), 0.05f)};
    for (int s = 0; s < 25; ++s) {
        hostColliders[0].pose.position.x = static_cast<float>(middle.x() + 0.4 * std::cos(0.25 * s));
        hostColliders[1].radius = s < 12 ? 0.05f : 0.12f;
        runner.step(stepOf(scene, std::span(hostColliders).first(s < 3 ? 0 : s < 18 ? 2 : 1)));
    }
    return runner.stateHash();
}

} // namespace

// Equal poses at equal times give equal bits, from the host or from a path.
TEST_P(PushedByHost, IsPushedAsByAColliderOnAPath) {
    for (const HostCollider& shape : shapes()) {
        Scene scene = floatingBlock();
        Collider collider = colliderOf(shape);
        collider.path = {
            {2 * frame, {{-0.4f, 0.05f, 0}, test::turnedBy(0, {0, 1, 0})}},
            {0.5f, {{-0.1f, 0.1f, 0.05f}, test::turnedBy(70, {1, 2, 0})}},
            {0.75f, {{0.2f, -0.1f, 0}, test::turnedBy(160, {1, 1, 0})}},
        };
        Scene withPath = scene;
        withPath.colliders = {collider};
        test::Runner told(scene, settings()), going(withPath, settings());
        for (int s = 0; s < 45; ++s) {
            HostCollider hostCollider = shape;
            hostCollider.maxSpeed = std::numeric_limits<float>::infinity();
            going.run(1);
            hostCollider.pose = going.simulation().colliderPoses()[0];
            told.step(stepOf(scene, std::array{hostCollider}));
        }
        EXPECT_EQ(told.stateHash(), going.stateHash()) << static_cast<int>(shape.shape);
        EXPECT_GT(fastest(told.velocities()), 0.1) << "nothing was touched";
    }
}

// No particle is deeper inside than rounding, and the body moves in the direction of the push.
TEST_P(PushedByHost, ABodyIsPushedAsideByWhatItDoesNotLetIn) {
    const Scene scene = floatingBlock();
    test::Runner runner(scene, settings(16));
    double deepest = 0;
    for (int s = 0; s < 45; ++s) {
        const std::array hostColliders{sphereAt({-0.3 + 0.01 * s, 0, 0})};
        ASSERT_EQ(runner.step(stepOf(scene, hostColliders)).nonFinite, 0u);
        deepest = std::max(
            deepest, deepestIn(runner.simulation().hostColliders()[0].hostCollider, runner.positions()));
    }
    RecordProperty("penetration", std::to_string(deepest));
    EXPECT_LE(deepest, 1e-5) << "[m]";
    EXPECT_GE(centerOf(runner.positions()).x(), 0.1);
}

// The target jumps by 9 m in a step. The host collider follows at its own speed through the body, and throws
// nothing faster than that.
TEST_P(PushedByHost, AJumpOfThePointerIsFollowedAtABoundedSpeed) {
    Scene scene = floatingBlock();
    test::Runner runner(scene, settings(16));
    HostCollider hostCollider = sphereAt({-1, 0, 0});
    hostCollider.maxSpeed = 6;
    runner.step(stepOf(scene, std::array{hostCollider}));
    hostCollider.pose.position.x = 8;
    double deepest = 0, speed = 0;
    for (int s = 1; s <= 40; ++s) {
        ASSERT_EQ(runner.step(stepOf(scene, std::array{hostCollider})).nonFinite, 0u);
        const HostColliderState& state = runner.simulation().hostColliders()[0];
        EXPECT_NEAR(placeOf(state).x(), std::min(-1 + 0.1 * s, 8.0), 1e-4) << "step " << s;
        deepest = std::max(deepest, deepestIn(state.hostCollider, runner.positions()));
        speed = std::max(speed, fastest(runner.velocities()));
    }
    std::printf("%s: deepest %.2g m, fastest %.2f m/s\n", solverName(GetParam()), deepest, speed);
    EXPECT_LE(deepest, 1e-4) << "[m]";
    EXPECT_LE(speed, 3 * 6) << "[m/s]";
    runner.run(30);
    EXPECT_LE(fastest(runner.velocities()), 2 * 6) << "it holds together and goes on";
}

// The bound on the speed applies to surface points of a turning host collider, too.
TEST_P(PushedByHost, TurnsAtABoundedSpeed) {
    const Scene scene = floatingBlock();
    test::Runner runner(scene, settings());
    HostCollider hostCollider{
        .shape = ColliderShape::capsule, .radius = 0.1f, .halfLength = 0.4f, .maxSpeed = 3};
    hostCollider.pose.position = {2, 0, 0};
    runner.step(stepOf(scene, std::array{hostCollider}));
    hostCollider.pose.rotation = test::turnedBy(90, {0, 0, 1});
    for (int s = 1; s <= 30; ++s) {
        runner.step(stepOf(scene, std::array{hostCollider}));
        const auto turned =
            test::toRotation(runner.simulation().hostColliders()[0].hostCollider.pose.rotation);
        const double expected = std::min(0.05 / 0.5 * s, 1.5707963);
        EXPECT_NEAR(Eigen::AngleAxisd(turned).angle(), expected, 1e-3) << "step " << s;
    }
}

// Particles inside an appearing host collider leave at 1 m/s and are not thrown.
TEST_P(PushedByHost, WhereItComesNothingIsThrown) {
    Scene scene;
    scene.gravity = {0, 0, 0};
    for (int i = 0; i < 20; ++i)
        scene.particles.push_back({.position = {0.01f * static_cast<float>(i), 0.003f, 0}});
    test::Runner runner(scene, settings());
    const std::array hostColliders{sphereAt({0, 0, 0}, 0.2f)};
    double before = deepestIn(hostColliders[0], runner.positions());
    for (int s = 0; s < 14; ++s) {
        runner.step(stepOf(scene, hostColliders));
        const double after = deepestIn(hostColliders[0], runner.positions());
        EXPECT_NEAR(after, std::max(before - 1.0 / 60, 0.0), 1e-4) << "step " << s;
        before = after;
    }
    EXPECT_LE(before, 1e-6);
    EXPECT_LE(fastest(runner.velocities()), 1e-6);
    EXPECT_EQ(placeOf(runner.simulation().hostColliders()[0]), Vector3d(0, 0, 0));
}

TEST_P(PushedByHost, WhatIsNotListedOrNoNumberChangesNoBit) {
    const Scene scene = blockInARoom();
    Settings without = settings();
    without.hostColliders = 0;
    const std::uint64_t hash = test::hashOfRun(scene, without, 12);
    EXPECT_EQ(test::hashOfRun(scene, settings(), 12), hash) << "not listed";
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const Pose inside{.position = {0.15f, 0.15f, 0.15f}};
    for (const HostCollider& hostCollider :
         {HostCollider{.pose = inside}, HostCollider{.radius = nan, .pose = inside},
          HostCollider{.radius = 0.1f, .friction = -1, .pose = inside},
          HostCollider{.radius = 0.1f, .pose = {.position = {nan, 0, 0}}},
          HostCollider{.radius = 0.1f, .pose = {.position = {2e9f, 0, 0}}},
          HostCollider{.radius = 0.1f, .pose = {inside.position, {0, 0, 0, 0}}},
          HostCollider{.radius = 0.1f, .pose = inside, .maxSpeed = nan},
          HostCollider{.shape = ColliderShape::box, .halfExtents = {0.1f, 0, 0.1f}, .pose = inside},
          HostCollider{.shape = ColliderShape{7}, .radius = 0.1f, .pose = inside}}) {
        test::Runner runner(scene, settings());
        for (int s = 0; s < 12; ++s) runner.step(stepOf(scene, std::array{hostCollider}));
        EXPECT_FALSE(runner.simulation().hostColliders()[0].isThere);
        EXPECT_EQ(runner.stateHash(), hash);
    }
    // A third host collider, where at most two are allowed.
    test::Runner runner(scene, settings());
    for (int s = 0; s < 12; ++s)
        runner.step(stepOf(
            scene, std::array{HostCollider{}, HostCollider{}, HostCollider{.radius = 0.1f, .pose = inside}}));
    EXPECT_EQ(runner.stateHash(), hash);
}

TEST_P(PushedByHost, HasTheSameBitsInReversedOrder) {
    Settings reversed = settings();
    reversed.isReversed = true;
    for (const Scene& scene : {floatingBlock(), blockInARoom()}) {
        const Vector3d middle = scene.planes.empty() ? Vector3d(0, 0, 0) : Vector3d(0.15, 0.15, 0.15);
        const std::uint64_t hash = hashOfStrokes(scene, settings(), middle);
        std::printf("state_hash %s %016" PRIx64 "\n", solverName(GetParam()), hash);
        EXPECT_EQ(hashOfStrokes(scene, settings(), middle), hash);
        EXPECT_EQ(hashOfStrokes(scene, reversed, middle), hash);
        EXPECT_NE(test::hashOfRun(scene, settings(), 25), hash) << "nothing was touched";
    }
}

TEST_P(PushedByHost, GoesOnWithTheSameBitsFromASavedState) {
    const Scene scene = blockInARoom();
    test::Runner runner(scene, settings());
    const auto push = [&](int from, int to) {
        for (int s = from; s < to; ++s)
            runner.step(stepOf(scene, std::array{sphereAt({-0.2 + 0.01 * s, 0.15, 0.15})}));
    };
    push(0, 25);
    const test::Runner::Saved saved = runner.save();
    push(25, 40);
    const std::uint64_t hash = runner.stateHash();
    runner.run(5);
    runner.load(saved);
    EXPECT_NEAR(placeOf(runner.simulation().hostColliders()[0]).x(), 0.04, 1e-6);
    push(25, 40);
    EXPECT_EQ(runner.stateHash(), hash);
    runner.reset();
    EXPECT_FALSE(runner.simulation().hostColliders()[0].isThere);
    push(0, 40);
    EXPECT_EQ(runner.stateHash(), hash);
}

INSTANTIATE_TEST_SUITE_P(Of, PushedByHost,
                         testing::Values(Solver::jacobi, Solver::split, Solver::gaussSeidel),
                         [](const auto& parameter) { return solverName(parameter.param); });

TEST(HostColliders, AreNoPassWithoutThem) {
    const Scene scene = floatingBlock();
    for (const char* kernel : {"place_colliders", "solve_colliders"}) {
        EXPECT_FALSE(test::usesKernel(scene, kernel)) << kernel;
        EXPECT_TRUE(test::usesKernel(scene, kernel, {.hostColliders = 1})) << kernel;
    }
    const std::string text = describe(compile(scene, {.substeps = 4, .hostColliders = 1}));
    EXPECT_NE(text.find("host_colliders.arguments"), std::string::npos)
        << "for no group while none is there:\n"
        << text;
}

TEST(HostColliders, DoNotChangeTheChoiceOfSubsteps) {
    for (const auto& [name, scene] : test::allScenes()) {
        const Settings with{.hostColliders = 3};
        EXPECT_EQ(withSubsteps(scene, with).substeps, withSubsteps(scene, {}).substeps) << name;
    }
}

// Two balls that rest on the floor, far from each other.
TEST(HostColliders, WakeWhatTheyComeNearAndNothingElse) {
    Scene scene;
    scene.planes = {{.friction = 0.5f}};
    for (const float x : {0.0f, 3.0f}) scene.particles.push_back(test::ballAt({x, test::ballRadius, 0}));
    for (const bool isReversed : {false, true}) {
        test::Runner runner(scene,
                            {.substeps = 8, .sleeps = true, .hostColliders = 1, .isReversed = isReversed});
        const auto sleepers = [&](std::span<const HostCollider> hostColliders, int steps = 1) {
            Status status{};
            for (int s = 0; s < steps; ++s) status = runner.step(stepOf(scene, hostColliders));
            return status.sleeping;
        };
        ASSERT_EQ(sleepers({}, 60), 2u);
        const std::array far{sphereAt({1.5, 1, 0})}, near{sphereAt({-0.15, 0.05, 0})};
        EXPECT_EQ(sleepers(far), 2u) << "comes between them";
        EXPECT_EQ(sleepers({}), 2u);
        EXPECT_EQ(sleepers(near), 1u) << "comes beside one, from nowhere: not over the other";
        EXPECT_EQ(sleepers(near, 60), 2u) << "stands still";
        EXPECT_EQ(sleepers({}), 1u) << "leaves what may have leant on it";
        EXPECT_EQ(sleepers({}, 60), 2u);
        EXPECT_EQ(sleepers(near), 1u) << "comes where it was before";
        EXPECT_EQ(sleepers(near, 60), 2u);
        const std::array wider{sphereAt({-0.15, 0.05, 0}, 0.12f)};
        EXPECT_EQ(sleepers(wider), 1u) << "grows";
        EXPECT_EQ(sleepers(wider, 60), 2u);
        EXPECT_EQ(sleepers(near), 1u) << "shrinks away from what lay on it";
        EXPECT_EQ(sleepers(near, 60), 2u);
        const std::array moved{sphereAt({-0.1, 0.05, 0}, 0.12f)};
        EXPECT_EQ(sleepers(moved), 1u) << "moves";
    }
}

// Balls that support each other wake where a host collider pushes them. Reversed order gives equal bits.
TEST(HostColliders, PushAHeapThatSleeps) {
    Scene scene;
    test::addBalls(scene, 3, 2.3f * test::ballRadius, 0.1f * test::ballRadius, {0, 0.2f, 0});
    scene.contacts.friction = 0.5f;
    scene.planes = {{.friction = 0.5f}};
    std::vector<std::uint64_t> hashes;
    for (const bool isReversed : {false, true}) {
        test::Runner runner(scene,
                            {.substeps = 8, .sleeps = true, .hostColliders = 1, .isReversed = isReversed});
        const auto count = static_cast<std::uint32_t>(scene.particles.size());
        for (int s = 0; s < 600 && runner.run(1).sleeping < count; ++s) {
        }
        ASSERT_EQ(runner.run(1).sleeping, count);
        const Vector3d before = centerOf(runner.positions());
        for (int s = 0; s < 60; ++s)
            EXPECT_EQ(runner.step(stepOf(scene, std::array{sphereAt({-0.6 + 0.01 * s, 0.1, 0})})).nonFinite,
                      0u);
        EXPECT_GT(centerOf(runner.positions()).x(), before.x() + 0.02);
        hashes.push_back(runner.stateHash());
    }
    EXPECT_EQ(hashes[0], hashes[1]);
}

// A simulation with larger capacity takes over the host colliders of the last step that was not undone.
TEST(HostColliders, AreTakenOverWhereTheLastWholeStepLeftThem) {
    Scene scene;
    test::addBalls(scene, 3, 2.2f * test::ballRadius, 0.1f * test::ballRadius, {0, 0.2f, 0});
    scene.planes = {{.friction = 0.5f}};
    constexpr int steps = 50;
    const auto step = [&](test::Runner& runner, int s) { // the host collider is slower than its target
        HostCollider hostCollider = sphereAt({-0.5 + 0.03 * s, 0.12, 0});
        hostCollider.maxSpeed = 1.2f;
        return runner.step(stepOf(scene, std::array{hostCollider}));
    };
    Settings settings{.substeps = 8, .contactRoom = 64, .hostColliders = 1};
    test::Runner roomy(scene, settings);
    for (int s = 0; s < steps; ++s) step(roomy, s);
    settings.contactRoom = 1;
    settings.contactMargin = 5; // longer lists must give the same bits
    auto runner = std::make_unique<test::Runner>(scene, settings);
    int growths = 0;
    for (int s = 0; s < steps;) {
        const Status status = step(*runner, s);
        if (status.contactRoom == 0) {
            ++s;
            continue;
        }
        settings.contactRoom = status.contactRoom;
        auto larger = std::make_unique<test::Runner>(scene, settings);
        larger->takeOver(*runner);
        runner = std::move(larger);
        ASSERT_LE(++growths, 20);
    }
    EXPECT_GE(growths, 1);
    EXPECT_EQ(runner->stateHash(), roomy.stateHash());
}

// A body that is pressed flat onto the floor and through it returns to its shape by recovery.
TEST(HostColliders, PressABodyOntoTheFloorAndLetItGo) {
    Scene scene;
    addLattice(scene, {.cells = {4, 4, 4}, .spacing = 0.1f, .youngModulus = 5e4f, .recovery = 2});
    scene.planes = {{.friction = 0.5f}};
    scene.damping = 4;
    test::Runner alone(scene, {.hostColliders = 1});
    alone.run(150);
    const double stands = centerOf(alone.positions()).y();
    for (const double lowest : {0.15, -0.05}) {
        test::Runner runner(scene, {.hostColliders = 1});
        double speed = 0;
        for (int s = 0; s < 90; ++s) {
            const double height = std::max(0.55 - 0.01 * s, lowest);
            ASSERT_EQ(runner.step(stepOf(scene, std::array{sphereAt({0.2, height, 0.2})})).nonFinite, 0u);
            speed = std::max(speed, fastest(runner.velocities()));
        }
        runner.run(150);
        const double rest = fastest(runner.velocities()), height = centerOf(runner.positions()).y();
        std::printf("down to %.2f m: fastest %.2f m/s, 2.5 s later %.3f m/s at %.4f m (%.4f)\n", lowest,
                    speed, rest, height, stands);
        EXPECT_LE(speed, 10) << "[m/s]";
        EXPECT_LE(rest, 0.1) << "[m/s]";
        EXPECT_NEAR(height, stands, 0.005) << "[m]";
    }
}
