// Tests of separations on the device: layers of cloth that are pressed together hard do not pass each other.
#include "sim/collision/face_scenes.hpp"
#include "sim/runner.hpp"
#include "sinew/bodies.hpp"
#include "sinew/scene.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numeric>
#include <string>

using namespace sinew;
using namespace sinew::sim;
using Eigen::Vector3d;

namespace {

constexpr float spacing = 0.02f;

ClothSheet uprightSheet(std::uint32_t side, float thickness) {
    const float height = spacing * static_cast<float>(side - 1);
    return {.origin = {-0.5f * height, height + spacing, 0},
            .right = {1, 0, 0},
            .down = {0, -0.9998f, 0.02f},
            .size = {side, side},
            .spacing = spacing,
            .areaDensity = 0.3f,
            .membraneStiffness = 100,
            .bendingStiffness = 2e-5f,
            .thickness = thickness};
}

// An upright sheet, 2 cm above a plane, that falls onto itself in many folds.
Scene crumpling(std::uint32_t side, float thickness) {
    Scene scene;
    addCloth(scene, uprightSheet(side, thickness));
    scene.planes.push_back({.normal = {0, 1, 0}, .friction = 0.5f});
    scene.contacts.friction = 0.2f;
    return scene;
}

Vector3d momentumOf(const Scene& scene, const std::vector<Vector3d>& velocities) {
    Vector3d sum = Vector3d::Zero();
    for (std::size_t i = 0; i < scene.particles.size(); ++i)
        sum += velocities[i] / double{scene.particles[i].inverseMass};
    return sum;
}

// About the origin.
Vector3d angularMomentumOf(const Scene& scene, const test::Runner& runner) {
    const std::vector<Vector3d> x = runner.positions(), v = runner.velocities();
    Vector3d sum = Vector3d::Zero();
    for (std::size_t i = 0; i < x.size(); ++i)
        sum += x[i].cross(v[i]) / double{scene.particles[i].inverseMass};
    return sum;
}

Vec3 toVec3(const Vector3d& v) {
    return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

} // namespace

struct Crumple {
    std::uint32_t side;
    float thickness; // [m]
    std::uint32_t substeps;
};

class CrumplingSheet : public testing::TestWithParam<Crumple> {};

// A substep of the fall is 0.15 to 0.3 thicknesses. Contacts alone left 3,576, 3,257 and 6 edges through
// faces.
TEST_P(CrumplingSheet, StaysOutOfItself) {
    const auto& [side, thickness, substeps] = GetParam();
    const Scene scene = crumpling(side, thickness);
    test::Runner runner(scene, {.substeps = substeps, .contactRoom = 160});
    for (int step = 0; step < 60; ++step) {
        const Status status = runner.run(1);
        ASSERT_EQ(status.nonFinite + status.contactRoom, 0u) << "step " << step << ": " << status.contactRoom;
    }
    EXPECT_EQ(test::intersections(scene, runner.positions()), 0);
    EXPECT_LT(test::rms(runner.velocities()), 1.0) << "[m/s]";
}

std::string nameOf(const testing::TestParamInfo<Crumple>& tested) {
    return "Thick" + std::to_string(std::lround(1e3f * tested.param.thickness)) + "mm" +
           std::to_string(tested.param.substeps) + "Substeps";
}

INSTANTIATE_TEST_SUITE_P(Falls, CrumplingSheet,
                         testing::Values(Crumple{31, 0.012f, 16}, Crumple{31, 0.012f, 24},
                                         Crumple{31, 0.006f, 32}),
                         nameOf);

TEST(Separations, EndInTheSameBitsForAnyMarginRoomAndOrder) {
    const Scene scene = crumpling(21, 0.012f);
    constexpr int steps = 25;
    const Settings settings{.substeps = 12, .contactRoom = 96};
    const std::uint64_t expected = test::hashOfRun(scene, settings, steps);
    Settings wide = settings, reversed = settings;
    wide.contactMargin = 1.5f;
    wide.contactRoom = 192;
    reversed.isReversed = true;
    EXPECT_EQ(test::hashOfRun(scene, wide, steps), expected) << "another margin, more room";
    EXPECT_EQ(test::hashOfRun(scene, reversed, steps), expected) << "reversed";
}

// Both halves of a sheet fly towards each other, by 0.5 thicknesses a substep.
TEST(Separations, KeepTheMomentumOfASheetThatMeetsItself) {
    Scene scene;
    scene.gravity = {};
    addCloth(scene, uprightSheet(21, 0.012f));
    const float middle = scene.particles[10 * 21].position.y;
    double most = 0; // [kg m/s], of one half
    for (Particle& particle : scene.particles) {
        if (particle.position.y == middle) continue;
        particle.velocity.y = particle.position.y > middle ? -3.0f : 3.0f;
        most += 1.5 / double{particle.inverseMass};
    }
    test::Runner runner(scene, {.substeps = 16, .contactRoom = 160});
    runner.run(30);
    EXPECT_LT(momentumOf(scene, runner.velocities()).norm(), 1e-5 * most);
    EXPECT_EQ(test::intersections(scene, runner.positions()), 0);
}

// A crumpled sheet, whose layers touch, flies and turns. Its parts move at other velocities than the sheet as
// a whole.
TEST(Separations, LetACrumpledSheetFlyAndTurn) {
    Scene scene = crumpling(21, 0.012f);
    test::Runner crumpled(scene, {.substeps = 24, .contactRoom = 160});
    crumpled.run(60);
    const std::vector<Vector3d> places = crumpled.positions();
    const Vector3d middle = std::accumulate(places.begin(), places.end(), Vector3d(Vector3d::Zero())) /
                            static_cast<double>(places.size());
    const Vector3d turn{0, 20, 0}, flight{8, 0, 0}; // [rad/s], [m/s]
    for (std::size_t i = 0; i < places.size(); ++i) {
        const Vector3d at = places[i] - middle;
        scene.particles[i].position = toVec3(at);
        scene.particles[i].velocity = toVec3(flight + turn.cross(at));
    }
    scene.gravity = {};
    scene.planes.clear();
    test::Runner runner(scene, {.substeps = 24, .contactRoom = 160});
    const Vector3d before = momentumOf(scene, runner.velocities()),
                   angular = angularMomentumOf(scene, runner);
    runner.run(30);
    const Vector3d after = momentumOf(scene, runner.velocities()), left = angularMomentumOf(scene, runner);
    std::printf("momentum %.6f of %.6f kg m/s, angular momentum %.6f of %.6f kg m^2/s\n", after.x(),
                before.x(), left.y(), angular.y());
    EXPECT_LT((after - before).norm(), 1e-5 * before.norm());
    EXPECT_LT((left - angular).norm(), 0.02 * angular.norm());
}
