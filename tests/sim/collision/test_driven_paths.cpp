// Tests that driven particles stay on their paths, whatever they meet and however fast they are.
#include "common/layout.h"
#include "sim/collision/collider_shapes.hpp"
#include "sim/runner.hpp"
#include "sim/scenes.hpp"
#include "sinew/bodies.hpp"
#include "sinew/colliders.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

using namespace sinew;
using namespace sinew::sim;
using Eigen::Vector3d;

namespace {

constexpr float radius = 0.05f;

std::uint32_t addBall(Scene& scene, const Vec3& position, float inverseMass) {
    scene.particles.push_back(
        {.position = position, .inverseMass = inverseMass, .contactOffset = radius, .radius = radius});
    return static_cast<std::uint32_t>(scene.particles.size() - 1);
}

// A square of 2 x half metres across x, of driven balls that touch each other, with a speed [m/s] along x.
void addWallOfBalls(Scene& scene, int half, float x, float speed) {
    const auto first = static_cast<std::uint32_t>(scene.particles.size());
    for (int y = -half; y <= half; ++y)
        for (int z = -half; z <= half; ++z)
            addBall(scene, {x, 2 * radius * static_cast<float>(y), 2 * radius * static_cast<float>(z)}, 0);
    scene.driven.push_back({.firstParticle = first,
                            .particleCount = static_cast<std::uint32_t>(scene.particles.size()) - first,
                            .path = {{0, {}}, {10, {.position = {10 * speed, 0, 0}}}}});
}

// Distance of the particle farthest from its path [m].
double farthestFromPaths(const Scene& scene, const std::vector<Vector3d>& x, double time) {
    double most = 0;
    for (const DrivenBody& body : scene.driven) {
        const Pose at = poseAt(body, time), from = poseAt(body, 0);
        const Eigen::Quaterniond turn =
            test::toRotation(at.rotation) * test::toRotation(from.rotation).conjugate();
        for (const std::uint32_t i : particlesOf(body)) {
            const Vector3d local =
                test::toVector(scene.particles[i].position) - test::toVector(from.position);
            most = std::max(most, (x[i] - test::toVector(at.position) - turn * local).norm());
        }
    }
    return most;
}

} // namespace

// More driven balls than are searched one by one (MOST_FAST) meet balls at rest. All that was too fast was
// slowed down, and what met something stopped there, driven balls too: they ended steps behind their places,
// and passed what they should push.
TEST(DrivenPaths, HoldWhereTooManyAreTooFastAndNoBallIsPassed) {
    for (const float speed : {40.0f, 200.0f, 1000.0f})
        for (const std::uint32_t substeps : {4u, 8u, 16u}) {
            Scene scene;
            scene.gravity = {};
            addWallOfBalls(scene, 9, 0, speed);
            ASSERT_GT(scene.particles.size(), std::size_t{MOST_FAST});
            const std::size_t first = scene.particles.size();
            for (int k = 0; k < 6; ++k) // so far apart that none meets another
                addBall(scene,
                        {0.3f + 0.2f * static_cast<float>(k), 0.6f * static_cast<float>(k % 3) - 0.57f,
                         0.7f * static_cast<float>(k / 3) - 0.33f},
                        1);
            test::Runner runner(scene, {.substeps = substeps, .contactRoom = 512});
            for (int step = 1; step <= 3; ++step) {
                ASSERT_FALSE(runner.run(1).isUndone);
                const auto x = runner.positions();
                const double wall = double{speed} * step / 60;
                EXPECT_LE(farthestFromPaths(scene, x, step / 60.0), 1e-5 * wall)
                    << speed << " m/s, " << substeps << " substeps, step " << step;
                for (std::size_t i = first; i < x.size(); ++i) {
                    const bool isBeside = std::hypot(x[i].y(), x[i].z()) > 18 * double{radius};
                    EXPECT_TRUE(isBeside || x[i].x() > wall)
                        << speed << " m/s, " << substeps << " substeps, step " << step << ", ball " << i;
                }
            }
        }
}

// Driven particles at rest are not checked in scenes that sleep, where no particle of their work group is
// awake. They shared a frame with loose balls that flew, so that these met them without a list.
TEST(DrivenPaths, AreMetByAllWhereTheyRestInASceneThatSleeps) {
    Scene scene;
    scene.gravity = {};
    const auto place = [](int k, int along) { return 0.2f * static_cast<float>(k % along); };
    for (int k = 0; k < 256; ++k) // every fourth place of a layer, in every fourth layer
        addBall(scene, {2 * place(k, 8), 4 * place(k / 64, 4), 2 * place(k / 8, 8)}, 0);
    const auto driven = static_cast<std::uint32_t>(scene.particles.size());
    scene.driven.push_back(
        {.particleCount = driven, .path = {{0, {}}, {2, {}}, {3, {.position = {0, 0.1f, 0}}}}});
    for (int k = 0; k < 2048; ++k) {
        const std::uint32_t ball =
            addBall(scene, {place(k, 16), 0.3f + 2 * place(k / 256, 8), place(k / 16, 16)}, 1);
        scene.particles[ball].velocity = {0, -3, 0};
    }
    const Settings never{.substeps = 16, .contactRoom = 64};
    Settings sleeping = never;
    sleeping.sleeps = true;
    test::Runner slept(scene, sleeping), awake(scene, never);
    for (int step = 0; step < 20; ++step) {
        ASSERT_FALSE(slept.run(1).isUndone);
        ASSERT_FALSE(awake.run(1).isUndone);
        ASSERT_EQ(slept.positions(), awake.positions()) << "step " << step;
    }
    EXPECT_GT(awake.velocities()[driven].y(), -1) << "above a driven ball, which it meets";
}
