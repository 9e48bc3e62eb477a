// Tests of colliders on paths: their poses, and how they push, carry and throw.
#include "sim/collision/collider_shapes.hpp"
#include "sim/compile/compile.hpp"
#include "sim/growing_run.hpp"
#include "sim/rigid/collider_paths.hpp"
#include "sim/scenes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

using namespace sinew;
using namespace sinew::sim;
using Eigen::Vector3d;

namespace {

constexpr double g = 9.81;

class Moving : public testing::TestWithParam<Solver> {
protected:
    Settings settings(std::uint32_t substeps = 10) const {
        return {.solver = GetParam(), .substeps = substeps};
    }
};

Collider box(const Vector3d& halfExtents, std::vector<Keyframe> path) {
    return {.shape = ColliderShape::box, .halfExtents = test::toFloats(halfExtents), .path = std::move(path)};
}

Keyframe at(float time, const Vector3d& position, double degrees = 0, const Vector3d& axis = {0, 1, 0}) {
    return {time, {test::toFloats(position), test::turnedBy(degrees, axis)}};
}

Vector3d positionAt(const Collider& collider, double time) {
    return test::toVector(poseAt(collider, time).position);
}

double degreesAt(const Collider& collider, double time) {
    return Eigen::AngleAxisd(test::toRotation(poseAt(collider, time).rotation)).angle() * 180 /
           std::numbers::pi;
}

// A scene whose contacts outgrow a small capacity while colliders move on paths.
Scene crowd() {
    Scene scene;
    for (int i = 0; i < 27; ++i)
        scene.particles.push_back(
            {.position = {0.1f * static_cast<float>(i % 3 - 1), 0.1f + 0.1f * static_cast<float>(i / 9),
                          0.1f * static_cast<float>(i / 3 % 3 - 1)},
             .contactOffset = 0.05f,
             .radius = 0.05f});
    scene.contacts.friction = 0.3f;
    scene.planes = {{.friction = 0.5f}};
    scene.colliders = {box({0.05, 0.3, 0.5}, {at(0, {-0.6, 0.2, 0}), at(1, {0.1, 0.2, 0})}),
                       box({0.05, 0.3, 0.5}, {at(0, {0.5, 0.2, 0})})};
    return scene;
}

} // namespace

TEST(ColliderPaths, GoEvenlyFromKeyToKey) {
    const Collider collider = box({1, 1, 1}, {at(1, {0, 0, 0}), at(3, {4, 0, 2}, 90), at(4, {4, 1, 2}, 180)});
    EXPECT_EQ(positionAt(collider, 0), Vector3d(0, 0, 0)) << "before the first";
    EXPECT_EQ(positionAt(collider, 1.5), Vector3d(1, 0, 0.5));
    EXPECT_NEAR(degreesAt(collider, 1.5), 22.5, 1e-4);
    EXPECT_NEAR(degreesAt(collider, 3.5), 135, 1e-4);
    EXPECT_EQ(positionAt(collider, 100), Vector3d(4, 1, 2)) << "after the last";
}

TEST(ColliderPaths, TurnTheShorterWayWhicheverSignAQuaternionHas) {
    Collider collider = box({1, 1, 1}, {at(0, {0, 0, 0}, 10), at(1, {0, 0, 0}, 50)});
    Quaternion& q = collider.path[1].pose.rotation;
    q = {-q.x, -q.y, -q.z, -q.w};
    EXPECT_NEAR(degreesAt(collider, 0.5), 30, 1e-4);
}

TEST(ColliderPaths, LoopFromTheirFirstKey) {
    Collider collider = box({1, 1, 1}, {at(1, {0, 0, 0}), at(2, {1, 0, 0}), at(3, {0, 0, 0})});
    collider.pathEnd = PathEnd::loop;
    EXPECT_NEAR(positionAt(collider, 3.25).x(), 0.25, 1e-6);
    EXPECT_NEAR(positionAt(collider, 1 + 2 * 1000 + 1.5).x(), 0.5, 1e-6);
}

TEST(ColliderPaths, GoOnWhereTheLastStepEnded) {
    rigid::ColliderPaths paths({box({1, 1, 1}, {at(0, {0, 0, 0}), at(1, {1, 0, 0}, 179)})});
    for (int step = 0; step < 90; ++step) {
        const layout::ColliderPose before = paths.ways()[1];
        paths.advance(1.0f / 60);
        EXPECT_EQ(paths.ways()[0].position.x, before.position.x);
        EXPECT_EQ(paths.ways()[0].rotation.y, before.rotation.y);
        EXPECT_NEAR(double{paths.ways()[1].position.x}, std::min((step + 1) / 60.0, 1.0), 1e-6);
    }
    EXPECT_NEAR(paths.time(), 1.5, 1e-6);
    paths.moveTo(0);
    EXPECT_EQ(paths.ways()[1].position.x, 0);
    EXPECT_EQ(paths.poses()[0].position.x, 0);
}

// A conveyor belt: friction accelerates the particle to the box's speed within v^2 / (2 mu g) and then
// carries it.
TEST_P(Moving, ABoxCarriesWhatLiesOnIt) {
    constexpr double speed = 1, friction = 0.5;
    Scene scene = test::particleAt({0, 0, 0});
    scene.colliders = {box({8, 0.1, 1}, {at(0, {0, -0.1, 0}), at(10, {10 * speed, -0.1, 0})})};
    scene.colliders[0].friction = static_cast<float>(friction);
    test::Runner runner(scene, settings());
    runner.run(120);
    const double lag = speed * speed / (2 * friction * g);
    EXPECT_NEAR(runner.positions()[0].x(), 2 * speed - lag, 0.01 * lag);
    EXPECT_NEAR(runner.velocities()[0].x(), speed, 1e-4);
    const double before = runner.positions()[0].x();
    runner.run(60);
    EXPECT_NEAR(runner.positions()[0].x() - before, speed, 1e-4) << "creep";
    EXPECT_NEAR(runner.positions()[0].y(), 0, 1e-6);
}

// A turntable carries a particle if friction supplies omega^2 r; a particle farther out slides off.
TEST_P(Moving, ATurningBoxCarriesWhatFrictionHolds) {
    constexpr double omega = std::numbers::pi; // one turn in 2 s
    Scene scene = test::particleAt({0.3f, 0, 0}, {0, 0, static_cast<float>(-0.3 * omega)});
    scene.particles.push_back(
        {.position = {0.9f, 0, 0}, .velocity = {0, 0, static_cast<float>(-0.9 * omega)}});
    scene.colliders = {box({2, 0.1, 2}, {})};
    for (int quarter = 0; quarter <= 4; ++quarter)
        scene.colliders[0].path.push_back(at(0.5f * static_cast<float>(quarter), {0, -0.1, 0}, 90 * quarter));
    scene.colliders[0].pathEnd = PathEnd::loop;
    scene.colliders[0].friction = 0.5f; // holds up to 0.497 m
    test::Runner runner(scene, settings(20));
    runner.run(40); // a third of a turn
    const double angle = omega * 40 / 60;
    const Vector3d expected(0.3 * std::cos(angle), 0, -0.3 * std::sin(angle));
    EXPECT_LE((runner.positions()[0] - expected).norm(), 0.01 * 0.3);
    EXPECT_NEAR(runner.positions()[0].norm(), 0.3, 1e-3);
    EXPECT_GE(runner.positions()[1].norm(), 1.0);
}

// A particle at rest leaves with v = (1 + e) u for every direction of the surface.
TEST_P(Moving, ASurfaceThatComesThrowsWithItsRestitution) {
    Scene scene = test::particleAt({0.5f, 0, 0});
    scene.gravity = {0, 0, 0};
    scene.colliders = {{.shape = ColliderShape::sphere,
                        .radius = 0.2f,
                        .restitution = 0.6f,
                        .path = {at(0, {-0.5, 0.1, 0}), at(1, {2.5, 0.1, 0})}}};
    test::Runner runner(scene, settings(60));
    runner.run(60);
    const Vector3d n(std::sqrt(0.04 - 0.01) / 0.2, -0.5, 0), u(3, 0, 0);
    EXPECT_LE((runner.velocities()[0] - 1.6 * u.dot(n) * n).norm(), 0.02 * 3);
}

TEST_P(Moving, NothingStandsStillInAPlateThatPassesFast) {
    Scene scene = test::particleAt({0, 0, 0});
    scene.gravity = {0, 0, 0};
    scene.colliders = {box({0.5, 0.005, 0.5}, {at(0, {0.1, -1, 0}, 20, {0, 0, 1}),
                                               at(0.02f, {0.1, 1, 0}, -20, {0, 0, 1}), at(1, {0.1, 3, 0})})};
    test::Runner runner(scene, settings(2));
    for (int step = 1; step <= 4; ++step) {
        ASSERT_EQ(runner.run(1).nonFinite, 0u);
        const Collider& plate = scene.colliders[0];
        const Pose pose = poseAt(plate, step / 60.0);
        const Vector3d x = runner.positions()[0];
        EXPECT_GE(test::gapOf(plate, pose, x), -1e-4) << step;
        EXPECT_GT((test::toRotation(pose.rotation).conjugate() * (x - test::toVector(pose.position))).y(), 0)
            << "still on the upper side after step " << step;
    }
}

// No particle may be inside. The body, at rest before, leaves with all of its momentum along the sphere's
// path; the momentum across comes from asymmetry and must stay small.
TEST_P(Moving, ASpherePushesABodyThatItDoesNotEnter) {
    Scene scene = test::block(5, 0.1f, 2e5f);
    for (Particle& particle : scene.particles) {
        particle.position.y -= 0.25f;
        particle.position.z -= 0.25f;
    }
    scene.gravity = {0, 0, 0};
    scene.damping = 0.5f;
    scene.colliders = {{.shape = ColliderShape::sphere,
                        .radius = 0.2f,
                        .friction = 0.3f,
                        .path = {at(0, {-0.3, 0, 0}), at(1, {0.3, 0, 0}), at(2, {0.3, 0, 0})}}};
    test::Runner runner(scene, settings(24));
    double deepest = 0;
    for (int step = 1; step <= 90; ++step) {
        ASSERT_EQ(runner.run(1).nonFinite, 0u);
        const Pose pose = runner.simulation().colliderPoses()[0];
        EXPECT_NEAR(double{pose.position.x}, std::min(-0.3 + 0.6 * step / 60, 0.3), 1e-6);
        for (const Vector3d& x : runner.positions())
            deepest = std::max(deepest, -test::gapOf(scene.colliders[0], pose, x));
    }
    RecordProperty("penetration", std::to_string(deepest / 0.2));
    EXPECT_LE(deepest, 0.01 * 0.2);
    Vector3d momentum = Vector3d::Zero(), mean = Vector3d::Zero();
    const auto v = runner.velocities(), x = runner.positions();
    for (std::size_t i = 0; i < v.size(); ++i) {
        momentum += v[i] / double{scene.particles[i].inverseMass};
        mean += x[i] / static_cast<double>(x.size());
    }
    EXPECT_GE(momentum.x(), 0.3 * test::massOf(scene)) << "the sphere came at 0.6 m/s";
    EXPECT_LE(std::hypot(momentum.y(), momentum.z()), 0.01 * momentum.x());
    EXPECT_GE(mean.x(), 0.5);
}

TEST_P(Moving, BeginsAnewWithAReset) {
    Scene scene = test::particleAt({0, 0.1f, 0});
    scene.colliders = {box({8, 0.1, 1}, {at(0, {0, -0.1, 0}), at(1, {1, -0.1, 0}, 20, {0, 0, 1})})};
    scene.colliders[0].friction = 0.5f;
    test::Runner runner(scene, settings());
    runner.run(30);
    const std::uint64_t hash = runner.stateHash();
    runner.reset();
    EXPECT_EQ(runner.simulation().colliderPoses()[0].position.x, 0);
    runner.run(30);
    EXPECT_EQ(runner.stateHash(), hash);
    Settings reversed = settings();
    reversed.isReversed = true;
    EXPECT_EQ(test::hashOfRun(scene, reversed, 30), hash);
}

// A simulation with larger capacity takes over the collider poses of the last step that was not undone.
TEST(MovingColliders, AreTakenOverWhereTheLastWholeStepLeftThem) {
    const Scene scene = crowd();
    constexpr int steps = 50;
    const std::uint64_t hash = test::hashOfRun(scene, {.substeps = 8, .contactRoom = 64}, steps);
    const auto run = // longer lists must give the same bits
        test::runGrowing(scene, {.substeps = 8, .contactMargin = 5}, steps);
    EXPECT_GE(run.growths, 1);
    EXPECT_EQ(run.hash, hash);
}

INSTANTIATE_TEST_SUITE_P(Of, Moving, testing::Values(Solver::jacobi, Solver::split, Solver::gaussSeidel),
                         [](const auto& parameter) { return solverName(parameter.param); });
