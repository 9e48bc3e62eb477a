// Tests of static spheres, capsules and boxes on the device: rest, restitution and friction (analytic cases
// 16 to 18 on their surfaces), fast particles, and particles that start inside.
#include "sim/collision/collider_shapes.hpp"
#include "sim/compile/compile.hpp"
#include "sim/reference/reference.hpp"
#include "sim/runner.hpp"
#include "sim/scenes.hpp"
#include "sinew/bodies.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <stdexcept>

using namespace sinew;
using namespace sinew::sim;
using Eigen::Vector3d;
using sinew::test::gapOf;

namespace {

constexpr double g = 9.81;

class Collided : public testing::TestWithParam<Solver> {
protected:
    Settings settings(std::uint32_t substeps = 10) const {
        return {.solver = GetParam(), .substeps = substeps};
    }
};

Scene particleAt(const Vector3d& position, const Vector3d& velocity = Vector3d::Zero()) {
    return test::particleAt(test::toFloats(position), test::toFloats(velocity));
}

Collider sphere(double radius, const Vector3d& center) {
    return {.shape = ColliderShape::sphere,
            .radius = static_cast<float>(radius),
            .pose = {.position = test::toFloats(center)}};
}

// A capsule along x.
Collider capsule(double radius, double halfLength, const Vector3d& center) {
    return {.shape = ColliderShape::capsule,
            .radius = static_cast<float>(radius),
            .halfLength = static_cast<float>(halfLength),
            .pose = {.position = test::toFloats(center), .rotation = test::turnedBy(90, {0, 0, 1})}};
}

Collider box(const Vector3d& halfExtents, const Vector3d& center, double degrees = 0,
             const Vector3d& axis = {0, 0, 1}) {
    return {.shape = ColliderShape::box,
            .halfExtents = test::toFloats(halfExtents),
            .pose = {.position = test::toFloats(center), .rotation = test::turnedBy(degrees, axis)}};
}

// One collider of each kind, 10 m apart, with their highest points on the x axis.
std::vector<Collider> sideBySide() {
    return {sphere(0.3, {0, -0.3, 0}), capsule(0.2, 0.5, {10, -0.2, 0}), box({1, 0.1, 0.5}, {20, -0.1, 0}),
            box({0.2, 0.4, 1}, {30, -0.2, 0}, 90)};
}

// A particle above each collider.
Scene above(const std::vector<Collider>& colliders, float height, float speed = 0) {
    Scene scene;
    for (std::size_t c = 0; c < colliders.size(); ++c)
        scene.particles.push_back(
            {.position = {10 * static_cast<float>(c), height, 0}, .velocity = {0, speed, 0}});
    scene.colliders = colliders;
    return scene;
}

// A long box whose top slopes down towards +x by `degrees`, with friction 0.5; the origin lies on its top.
Collider incline(double degrees) {
    const double angle = degrees * std::numbers::pi / 180;
    Collider collider = box({8, 0.2, 1}, {-0.2 * std::sin(angle), -0.2 * std::cos(angle), 0}, -degrees);
    collider.friction = 0.5f;
    return collider;
}

} // namespace

TEST_P(Collided, StopsAFallingParticleAtItsOffset) {
    Scene scene = above(sideBySide(), 0.4f, -1);
    for (Particle& particle : scene.particles) particle.contactOffset = 0.02f;
    for (Collider& collider : scene.colliders) collider.margin = 0.01f;
    test::Runner runner(scene, settings());
    runner.run(120);
    for (const Vector3d& x : runner.positions()) EXPECT_NEAR(x.y(), 0.03, 1e-6);
    for (const Vector3d& v : runner.velocities())
        EXPECT_LE(v.norm(), g / 600) << "at most what gravity adds in a substep";
}

// Case 16: the rebound height is e^2 h_0, with 600 substeps a second.
TEST_P(Collided, ReboundsToTheHeightOfItsRestitution) {
    for (const double restitution : {0.0, 0.5, 1.0}) {
        Scene scene = above(sideBySide(), 1);
        for (Collider& collider : scene.colliders) collider.restitution = static_cast<float>(restitution);
        test::Runner runner(scene, settings());
        runner.run(27); // the fall takes 0.4515 s
        std::vector<double> apex(scene.particles.size());
        for (int step = 27; step < 80; ++step) {
            runner.run(1);
            for (std::size_t i = 0; i < apex.size(); ++i)
                apex[i] = std::max(apex[i], runner.positions()[i].y());
        }
        const double expected = restitution * restitution;
        for (const double height : apex) {
            RecordProperty("apex", std::to_string(height));
            EXPECT_NEAR(height, expected, 0.02 * std::max(expected, 0.05)) << "e = " << restitution;
            EXPECT_LE(height, expected + 1e-3) << "more energy than e^2";
        }
    }
}

// Without gravity, an impact keeps e times the normal velocity and all of the tangential velocity, for speeds
// up to a radius a substep.
TEST_P(Collided, KeepsNoMoreOfAnImpactThanItsRestitution) {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> off(-0.19f, 0.19f);
    Scene scene;
    scene.gravity = {0, 0, 0};
    for (int shot = 0; shot < 10; ++shot)
        scene.particles.push_back({.position = {-1, off(random), off(random)},
                                   .velocity = {2 + 20 * static_cast<float>(shot), 0, 0}});
    scene.colliders = {sphere(0.3, {0, 0, 0})};
    scene.colliders[0].restitution = 0.7f;
    test::Runner runner(scene, settings());
    runner.run(40);
    for (std::size_t i = 0; i < scene.particles.size(); ++i) {
        const Vector3d x = test::toVector(scene.particles[i].position),
                       before = test::toVector(scene.particles[i].velocity);
        const Vector3d n = Vector3d(-std::sqrt(0.09 - x.y() * x.y() - x.z() * x.z()), x.y(), x.z()) / 0.3;
        const Vector3d after = runner.velocities()[i], expected = before - 1.7 * n.dot(before) * n;
        EXPECT_LE((after - expected).norm(), 1e-3 * before.norm()) << "shot " << i;
    }
}

// Case 17: friction holds up to atan 0.5 = 26.57 degrees, within one degree.
TEST_P(Collided, SticksOnAnInclineBelowTheFrictionAngle) {
    Scene scene = particleAt({0, 0, 0});
    scene.colliders = {incline(25.6)};
    test::Runner runner(scene, settings());
    runner.run(120);
    RecordProperty("creep", std::to_string(runner.positions()[0].norm() / 2));
    EXPECT_LE(runner.positions()[0].norm(), 2e-4) << "creep of 1e-4 m/s in 2 s";
}

TEST_P(Collided, SlidesOnAnInclineAboveTheFrictionAngle) {
    for (const double degrees : {27.5, 35.0}) {
        Scene scene = particleAt({0, 0, 0});
        scene.colliders = {incline(degrees)};
        test::Runner runner(scene, settings());
        runner.run(120);
        const double angle = degrees * std::numbers::pi / 180;
        const double path = g * (std::sin(angle) - 0.5 * std::cos(angle)) * 2 * 2 / 2;
        EXPECT_NEAR(runner.positions()[0].norm() / path, 1, 0.01) << degrees << " degrees";
    }
}

TEST_P(Collided, HoldsFasterWhatRestsThanWhatSlides) {
    const double angle = 22 * std::numbers::pi / 180;
    for (const double speed : {0.0, 0.2}) {
        Scene scene = particleAt({0, 0, 0}, {speed * std::cos(angle), -speed * std::sin(angle), 0});
        scene.colliders = {incline(22)};
        scene.colliders[0].friction = 0.2f;
        scene.colliders[0].staticFriction = 0.5f;
        test::Runner runner(scene, settings());
        runner.run(60);
        const double path = speed + g * (std::sin(angle) - 0.2 * std::cos(angle)) / 2;
        EXPECT_NEAR(runner.positions()[0].norm(), speed > 0 ? path : 0, speed > 0 ? 0.01 * path : 1e-4);
    }
}

// A sphere's slope is that of its tangent, so friction holds up to the friction angle from the top.
TEST_P(Collided, SticksOnASphereAsFarAsFrictionHolds) {
    for (const double degrees : {25.6, 27.5}) {
        const double angle = degrees * std::numbers::pi / 180;
        const Vector3d start(0.5 * std::sin(angle), 0.5 * std::cos(angle), 0);
        Scene scene = particleAt(start);
        scene.colliders = {sphere(0.5, {0, 0, 0})};
        scene.colliders[0].friction = 0.5f;
        test::Runner runner(scene, settings());
        runner.run(120);
        const double moved = (runner.positions()[0] - start).norm();
        if (degrees < 26)
            EXPECT_LE(moved, 2e-4);
        else
            EXPECT_GE(moved, 0.05);
    }
}

// Without friction, a particle leaves the sphere where cos = 2/3 + v0^2 / (3 g R).
TEST_P(Collided, LeavesASphereAtTwoThirdsOfItsHeight) {
    constexpr double radius = 1, speed = 0.3;
    Scene scene = particleAt({0, radius, 0}, {speed, 0, 0});
    scene.colliders = {sphere(radius, {0, 0, 0})};
    scene.dt = 1.0f / 240;
    test::Runner runner(scene, settings(5));
    double leaving = 0;
    for (int step = 0; step < 330; ++step) {
        runner.run(1);
        const Vector3d x = runner.positions()[0];
        if (x.norm() < radius + 5e-6) leaving = std::acos(x.y() / x.norm());
    }
    const double expected = std::acos(2.0 / 3 + speed * speed / (3 * g * radius));
    EXPECT_NEAR(leaving * 180 / std::numbers::pi, expected * 180 / std::numbers::pi, 2);
}

// Case 18: d = v^2 / (2 mu g).
TEST_P(Collided, SlidesToAStopWhereFrictionSays) {
    for (const Collider& collider : {incline(0), capsule(0.3, 2, {0, -0.3, 0})}) {
        Scene scene = particleAt({0, 0, 0}, {2, 0, 0});
        scene.colliders = {collider};
        scene.colliders[0].friction = 0.5f;
        test::Runner runner(scene, settings());
        runner.run(90);
        EXPECT_NEAR(runner.positions()[0].x() / (4 / (2 * 0.5 * g)), 1, 0.01);
        EXPECT_LE(std::abs(runner.velocities()[0].x()), 1e-5);
    }
}

// Each collider pushes the particle out, and the last one reverses the pushes of the others. No velocity may
// result.
TEST_P(Collided, StandsStillBetweenWhatHoldsIt) {
    const Collider below = box({1, 0.5, 1}, {0, -0.49, 0}), above = box({1, 0.5, 1}, {0, 0.48, 0});
    const std::vector<std::vector<Collider>> pairs{
        {below, above},
        {above, below},
        {sphere(0.5, {0, 0.48, 0}), sphere(0.5, {0, -0.49, 0})},
        {capsule(0.5, 0.2, {0, 0.48, 0}), below},
        {above, box({1, 0.5, 1}, {0, -0.49, 0}, 1)}}; // forms a wedge of one degree
    for (const double gravity : {0.0, g})
        for (const float friction : {0.0f, 0.5f})
            for (std::size_t c = 0; c < pairs.size(); ++c) {
                if (c == 4 && friction == 0) continue; // would slip out
                Scene scene = particleAt({0, 0, 0});
                scene.gravity = {0, static_cast<float>(-gravity), 0};
                scene.colliders = pairs[c];
                for (Collider& collider : scene.colliders) collider.friction = friction;
                test::Runner runner(scene, settings());
                runner.run(20);
                EXPECT_LE(runner.velocities()[0].norm(), 0.01 + gravity / 600) << c << ", " << friction;
            }
}

TEST_P(Collided, StandsStillBetweenAPlaneAndAColliderThatHoldIt) {
    Scene scene = particleAt({0, 0, 0});
    scene.planes = {{.normal = {0, 1, 0}, .offset = 0.01f}};
    scene.colliders = {sphere(0.5, {0, 0.48, 0})};
    test::Runner runner(scene, settings());
    runner.run(20);
    EXPECT_LE(runner.velocities()[0].norm(), 0.01 + g / 600);
}

TEST_P(Collided, IsNoFasterThanTheColliderThatPressesItOnAnother) {
    for (const bool movesFirst : {true, false}) {
        Scene scene = particleAt({0, 0.001f, 0});
        scene.colliders = {box({1, 0.5, 1}, {0, -0.5, 0}), box({1, 0.5, 1}, {0, 0.55, 0})};
        scene.colliders[1].path = {{0, scene.colliders[1].pose}, {0.5f, {.position = {0, 0.49f, 0}}}};
        if (movesFirst) std::swap(scene.colliders[0], scene.colliders[1]);
        test::Runner runner(scene, settings());
        for (int frame = 0; frame < 30; ++frame) {
            runner.run(1);
            EXPECT_LE(runner.velocities()[0].norm(), 0.12 + g / 600) << frame; // 0.12 m/s
        }
        runner.run(10);
        EXPECT_LE(runner.velocities()[0].norm(), 0.01 + g / 600) << movesFirst;
    }
}

TEST_P(Collided, KeepsMomentumAlongASurfaceWithoutFriction) {
    Scene scene = particleAt({0, 0.3, 0}, {2, 0, 0.5});
    scene.colliders = {incline(0)};
    scene.colliders[0].friction = 0;
    test::Runner runner(scene, settings());
    runner.run(60);
    EXPECT_NEAR(runner.positions()[0].x(), 2, 1e-4);
    EXPECT_NEAR(runner.velocities()[0].x(), 2, 2e-6);
    EXPECT_NEAR(runner.velocities()[0].z(), 0.5, 2e-6);
}

// The free path of a particle never leads through a collider: thin plates, edges and capsule ends at 10 to
// 1000 m/s, with one substep a frame.
TEST_P(Collided, LetsNothingFastThrough) {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> unit(-1, 1), decade(1, 3);
    const auto any = [&] { return Vector3d(unit(random), unit(random), unit(random)); };
    const std::vector<Collider> colliders{box({0.5, 0.005, 0.5}, {0.1, 0, 0}, 30, {1, 2, 3}),
                                          box({0.05, 0.2, 0.01}, {0, 0, 0}, 75, {3, 0, 1}),
                                          capsule(0.02, 0.4, {0, 0.1, 0}), sphere(0.05, {0, 0, 0.02})};
    int stopped = 0;
    for (const Collider& collider : colliders) {
        Scene scene;
        scene.gravity = {0, 0, 0};
        scene.colliders = {collider};
        while (scene.particles.size() < 60) {
            const Vector3d start = 1.2 * any().normalized(), target = 0.2 * any();
            if (gapOf(collider, collider.pose, start) < 0.01) continue;
            const Vector3d velocity = std::pow(10, decade(random)) * (target - start).normalized();
            scene.particles.push_back(
                {.position = test::toFloats(start), .velocity = test::toFloats(velocity)});
        }
        test::Runner runner(scene, settings(1));
        std::vector<Vector3d> from = runner.positions();
        for (int step = 0; step < 8; ++step) {
            runner.run(1);
            const std::vector<Vector3d> to = runner.positions();
            for (std::size_t p = 0; p < to.size(); ++p)
                for (int i = 0; i <= 200 && from[p].norm() < 3; ++i)
                    ASSERT_GE(gapOf(collider, collider.pose, from[p] + i / 200.0 * (to[p] - from[p])), -2e-5)
                        << "particle " << p << ", step " << step;
            from = to;
        }
        const std::vector<Vector3d> v = runner.velocities();
        for (std::size_t p = 0; p < v.size(); ++p)
            stopped += (v[p] - test::toVector(scene.particles[p].velocity)).norm() > 1;
    }
    EXPECT_GE(stopped, 60) << "of 240 shots must hit something";
}

// Starts include the centre, where no side is nearest.
TEST_P(Collided, LetsGoOfWhatBeganInsideWithoutThrowingIt) {
    const std::vector<std::pair<Collider, Vector3d>> starts{
        {sphere(0.2, {0, 0, 0}), {0, 0, 0}},
        {sphere(0.2, {0, 0, 0}), {0.01, 0, 0.05}},
        {capsule(0.1, 0.3, {0, 0, 0}), {0.2, 0, 0}},
        {box({0.3, 0.1, 0.2}, {0, 0, 0}), {0, 0, 0}},
        {box({0.3, 0.1, 0.2}, {0, 0, 0}, 20), {0.25, 0, 0.1}}};
    for (const auto& [collider, start] : starts) {
        Scene scene = particleAt(start);
        scene.gravity = {0, 0, 0};
        scene.colliders = {collider};
        test::Runner runner(scene, settings());
        const double depth = -gapOf(collider, collider.pose, start);
        runner.run(3);
        EXPECT_LT(gapOf(collider, collider.pose, runner.positions()[0]), -depth + 0.052) << "1 m/s";
        EXPECT_GT(gapOf(collider, collider.pose, runner.positions()[0]), std::min(-depth + 0.048, -1e-6));
        runner.run(20);
        EXPECT_NEAR(gapOf(collider, collider.pose, runner.positions()[0]), 0, 1e-6);
        EXPECT_LE(runner.velocities()[0].norm(), 1e-4);
    }
}

TEST_P(Collided, StandsOnAnEdgeAndACornerOrFallsBesideThem) {
    const double s = std::sqrt(0.5);
    // One box has an edge at the top, the other a corner.
    const std::vector<Collider> colliders{
        box({0.2, 0.2, 0.5}, {0, -0.2 / s, 0}, 45),
        box({0.2, 0.2, 0.2}, {0, -0.2 * std::sqrt(3.0), 0}, 54.735610317, {1, 0, -1})};
    for (const Collider& collider : colliders) {
        for (const double off : {0.0, 1e-7, 0.01}) {
            Scene scene = particleAt({off, 0.2, 0.1 * off});
            scene.colliders = {collider};
            test::Runner runner(scene, settings());
            for (int step = 0; step < 60; ++step) {
                ASSERT_EQ(runner.run(1).nonFinite, 0u);
                ASSERT_GE(gapOf(collider, collider.pose, runner.positions()[0]), -1e-6);
            }
        }
    }
}

// A particle in the trough of two overlapping boxes, and one under a sphere, may sink by the fall of one
// substep.
TEST_P(Collided, HoldsAParticleInATrough) {
    Scene scene = particleAt({0.05, 0.5, 0}, {0.5, 0, 0});
    scene.colliders = {box({1, 0.05, 1}, {0.6, 0.5, 0}, 40), box({1, 0.05, 1}, {-0.6, 0.5, 0}, -40)};
    for (Collider& collider : scene.colliders) collider.friction = 0.2f;
    test::Runner runner(scene, settings());
    for (int step = 0; step < 120; ++step) {
        ASSERT_EQ(runner.run(1).nonFinite, 0u);
        for (const Collider& collider : scene.colliders)
            ASSERT_GE(gapOf(collider, collider.pose, runner.positions()[0]), -g / 600 / 600);
    }
    EXPECT_LE(runner.velocities()[0].norm(), 0.02);
}

TEST_P(Collided, LeavesAHeldParticleWhereItIs) {
    Scene scene = particleAt({0, 0, 0});
    scene.particles[0].inverseMass = 0;
    scene.particles.push_back({.position = {0, 0.3f, 0}});
    scene.colliders = {sphere(0.2, {0, 0, 0})};
    test::Runner runner(scene, settings());
    runner.run(60);
    EXPECT_EQ(runner.positions()[0], Vector3d(0, 0, 0));
}

TEST_P(Collided, HasTheSameBitsInReversedOrder) {
    Scene scene = test::block(4, 0.1f, 1e5f, 0.05f);
    scene.colliders = {sphere(0.15, {0.1, 0, 0.2}), box({0.3, 0.02, 0.2}, {0.3, -0.1, 0.1}, 30, {1, 2, 0}),
                       capsule(0.05, 0.2, {0.3, 0.5, 0.3})};
    for (Collider& collider : scene.colliders) collider.friction = 0.4f;
    test::disturb(scene, 0.01f, 2);
    for (const float restitution : {0.0f, 0.6f}) {
        scene.colliders[0].restitution = restitution;
        Settings reversed = settings();
        reversed.isReversed = true;
        EXPECT_EQ(test::hashOfRun(scene, settings(), 10), test::hashOfRun(scene, reversed, 10));
    }
}

// A soft cube on a tilted box sticks below the friction angle and slides above it. Averaged corrections make
// the cube of `jacobi` creep on any ground: on a plane, 9e-3 m/s were measured at 25.5 degrees.
TEST_P(Collided, HoldsABodyOnAnInclineBelowTheFrictionAngle) {
    for (const double degrees : {20.0, 35.0}) {
        Scene scene = test::block(3, 0.05f, 1e6f);
        const Eigen::AngleAxisd turn(-degrees * std::numbers::pi / 180, Vector3d::UnitZ());
        for (Particle& particle : scene.particles)
            particle.position = test::toFloats(turn * test::toVector(particle.position));
        scene.colliders = {incline(degrees)};
        scene.damping = 1;
        test::Runner runner(scene, settings(16));
        const auto mean = [&] {
            Vector3d sum = Vector3d::Zero();
            for (const Vector3d& x : runner.positions())
                sum += x / static_cast<double>(scene.particles.size());
            return sum;
        };
        runner.run(60);
        const Vector3d before = mean();
        runner.run(60);
        const double moved = (mean() - before).norm();
        RecordProperty(degrees < 26 ? "creep" : "slide", std::to_string(moved));
        if (degrees < 26)
            EXPECT_LE(moved, GetParam() == Solver::jacobi ? 1e-3 : 1e-4) << "m/s";
        else
            EXPECT_GE(moved, 0.5);
    }
}

TEST(Colliders, AreNoPassOfASceneWithoutThem) {
    Scene scene = test::particleAt({0, 0, 0});
    scene.planes = {{}};
    for (const Solver solver : {Solver::jacobi, Solver::split, Solver::gaussSeidel}) {
        const StepProgram program = compile(scene, {.solver = solver, .substeps = 2});
        for (const Pass& pass : program[List::step])
            EXPECT_EQ(pass.label.find("collider"), std::string::npos);
        for (const BufferSpec& buffer : program.buffers)
            EXPECT_EQ(buffer.label.find("collider"), std::string::npos);
    }
}

// Static colliders need no pass that places them, and colliders without restitution no pass that stores
// speeds.
TEST(Colliders, CompileToWhatTheyNeed) {
    constexpr std::uint32_t hasRebound = 6; // constant_id in solve_colliders.comp
    Scene scene = test::particleAt({0, 0, 0});
    scene.colliders = {sphere(0.1, {0, -1, 0})};
    EXPECT_TRUE(test::usesKernel(scene, "solve_colliders", {}, {{hasRebound, 0}}));
    EXPECT_FALSE(test::usesKernel(scene, "save_substep_start"));
    EXPECT_FALSE(test::usesKernel(scene, "place_colliders"));
    scene.colliders[0].restitution = 0.5f;
    EXPECT_TRUE(test::usesKernel(scene, "solve_colliders", {}, {{hasRebound, 1}}));
    EXPECT_TRUE(test::usesKernel(scene, "save_substep_start"));
    scene.colliders[0].path = {{0, {}}, {1, {}}};
    EXPECT_TRUE(test::usesKernel(scene, "place_colliders"));
}

// A body that stays in shared memory for a step would miss the collider passes between substeps.
TEST(Colliders, KeepBodiesOutOfSharedMemory) {
    Scene scene = test::block(3, 0.1f, 1e5f);
    const Settings settings{.forms = {.residentBytes = 16384}};
    EXPECT_TRUE(test::usesKernel(scene, "resident_lattice", settings));
    scene.colliders = {sphere(0.1, {0, -1, 0})};
    EXPECT_FALSE(test::usesKernel(scene, "resident_lattice", settings));
    EXPECT_TRUE(test::usesKernel(scene, "solve_colliders", settings));
}

// `split` uses other passes where particles touch each other; colliders must still be applied last.
TEST(Colliders, KeepOutParticlesThatTouchEachOther) {
    Scene scene;
    for (int i = 0; i < 64; ++i)
        scene.particles.push_back({.position = {0.101f * static_cast<float>(i % 4) - 0.15f,
                                                0.5f + 0.101f * static_cast<float>(i / 16),
                                                0.101f * static_cast<float>(i / 4 % 4) - 0.15f},
                                   .contactOffset = 0.05f,
                                   .radius = 0.05f});
    scene.contacts.friction = 0.3f;
    scene.colliders = {sphere(0.25, {0, 0, 0}), box({1, 0.1, 1}, {0, -0.3, 0}),
                       box({0.02, 0.5, 0.5}, {0.4, 0, 0}, 20)};
    for (Collider& collider : scene.colliders) collider.friction = 0.3f;
    for (const float restitution : {0.0f, 0.5f}) {
        scene.contacts.restitution = restitution; // restitution changes v without a displacement
        test::Runner runner(scene, {.substeps = 8});
        for (int step = 0; step < 60; ++step) {
            ASSERT_EQ(runner.run(1).nonFinite, 0u);
            for (const Vector3d& x : runner.positions())
                for (const Collider& collider : scene.colliders)
                    ASSERT_GE(gapOf(collider, collider.pose, x), 0.05 - 2e-3) << "step " << step;
        }
        EXPECT_EQ(test::hashOfRun(scene, {.substeps = 8, .isReversed = true}, 60), runner.stateHash());
    }
}

// Particles that fly to and fro among colliders of all kinds, some of which move, one faster than what it
// hits.
Scene among(bool touches, float restitution) {
    std::mt19937 random(3);
    std::uniform_real_distribution<float> place(-1, 1), speed(-6, 6);
    Scene scene;
    for (int i = 0; i < 2500; ++i)
        scene.particles.push_back({.position = {place(random), place(random), place(random)},
                                   .velocity = {speed(random), speed(random), speed(random)},
                                   .contactOffset = 0.004f,
                                   .radius = touches ? 0.004f : 0});
    scene.colliders = {sphere(0.2, {0.3, 0.2, 0}), capsule(0.1, 0.4, {0, -0.4, 0.2}),
                       box({0.05, 0.6, 0.6}, {-4, 0, 0}), box({0.7, 0.02, 0.1}, {0, 0.5, 0})};
    scene.colliders[0].restitution = restitution;
    scene.colliders[1].friction = 0.4f;
    scene.colliders[2].path = {{0, {.position = {-4, 0, 0}}}, {1, {.position = {8, 0, 0}}}}; // 12 m/s
    scene.colliders[3].path = {
        {0, {.position = {0, 0.5f, 0}}},
        {0.25f, {.position = {0, 0.5f, 0.3f}, .rotation = test::turnedBy(170, {0, 1, 0})}}};
    return scene;
}

TEST_P(Collided, GivesTheSameBitsInAnyOrder) {
    for (const bool touches : {false, true}) {
        if (touches && GetParam() != Solver::split) continue;
        for (const float restitution : {0.0f, 0.5f}) {
            const Scene scene = among(touches, restitution);
            const Settings given = settings(3);
            Settings reversed = given;
            reversed.isReversed = true;
            EXPECT_EQ(test::hashOfRun(scene, reversed, 24), test::hashOfRun(scene, given, 24))
                << (touches ? "contacts" : "none") << ", " << restitution;
        }
    }
}

// A coarser form of scenes/cloth_on_sphere.toml. Particles and centres of triangles penetrate by at most a
// hundredth of the radius, and friction holds the cloth at rest.
TEST(ClothOnASphere, ComesToRestOutsideIt) {
    constexpr double radius = 0.22;
    Scene scene;
    addCloth(scene, {.origin = {-0.5f, 0.75f, -0.5f}, .size = {26, 26}, .spacing = 0.04f});
    scene.colliders = {sphere(radius, {0, 0.4, 0})};
    scene.colliders[0].margin = 0.002f;
    scene.colliders[0].friction = 0.4f;
    scene.planes = {{.friction = 0.4f}};
    scene.damping = 2;
    test::Runner runner(scene, {.substeps = 24});
    double deepest = 0;
    for (int step = 0; step < 240; ++step) {
        ASSERT_EQ(runner.run(1).nonFinite, 0u);
        const std::vector<Vector3d> x = runner.positions();
        const Skin& skin = scene.skins[0];
        for (const auto& triangle : skin.triangles) {
            Vector3d middle{0, 0, 0};
            for (const std::uint32_t vertex : triangle) middle += x.at(skin.particles[vertex]) / 3;
            for (const Vector3d& point : {x[skin.particles[triangle[0]]], middle})
                deepest = std::max(deepest, -gapOf(scene.colliders[0], scene.colliders[0].pose, point));
        }
    }
    RecordProperty("penetration", std::to_string(deepest / radius));
    EXPECT_LE(deepest, 0.01 * radius);
    double fastest = 0, highest = 0;
    for (const Vector3d& v : runner.velocities()) fastest = std::max(fastest, v.norm());
    for (const Vector3d& x : runner.positions()) highest = std::max(highest, x.y());
    RecordProperty("speed", std::to_string(fastest));
    EXPECT_LE(fastest, 0.1) << "m/s";
    EXPECT_NEAR(highest, 0.4 + radius + 0.002, 5e-3) << "lies on the top";
}

TEST(Colliders, AreRefusedByTheReferencesInASentence) {
    Scene scene = particleAt({0, 0, 0});
    scene.colliders = {sphere(0.1, {0, -1, 0})};
    EXPECT_THROW(reference::initialState(scene), std::invalid_argument);
}

INSTANTIATE_TEST_SUITE_P(Of, Collided, testing::Values(Solver::jacobi, Solver::split, Solver::gaussSeidel),
                         [](const auto& parameter) { return solverName(parameter.param); });
