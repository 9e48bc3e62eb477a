// Tests of meshes on paths (Scene::driven): they lift, carry and sweep particles, and wake sleeping bodies.
#include "sim/collision/collider_shapes.hpp"
#include "sim/runner.hpp"
#include "sim/scenes.hpp"
#include "sinew/bodies.hpp"
#include "sinew/colliders.hpp"
#include "sinew/validate.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

using namespace sinew;
using namespace sinew::sim;
using Eigen::Vector3d;

namespace {

constexpr float thickness = 0.01f, radius = 0.05f;

Keyframe at(float time, const Vector3d& position, double degrees = 0, const Vector3d& axis = {0, 1, 0}) {
    return {time, {test::toFloats(position), test::turnedBy(degrees, axis)}};
}

// A square of 2 x half metres in x and z through the origin, divided into cells^2 x 2 triangles.
MeshCollider plate(float half, std::uint32_t cells, std::vector<Keyframe> path) {
    MeshCollider mesh{.name = "plate", .thickness = thickness, .path = std::move(path)};
    for (std::uint32_t z = 0; z <= cells; ++z)
        for (std::uint32_t x = 0; x <= cells; ++x)
            mesh.vertices.push_back({half * (2 * static_cast<float>(x) / static_cast<float>(cells) - 1), 0,
                                     half * (2 * static_cast<float>(z) / static_cast<float>(cells) - 1)});
    for (std::uint32_t z = 0; z < cells; ++z)
        for (std::uint32_t x = 0; x < cells; ++x) {
            const std::uint32_t a = z * (cells + 1) + x, b = a + 1, c = a + cells + 1;
            mesh.triangles.push_back({a, c, b});
            mesh.triangles.push_back({b, c, c + 1});
        }
    return mesh;
}

std::uint32_t addBall(Scene& scene, const Vec3& position, const Vec3& velocity = {}) {
    scene.particles.push_back(
        {.position = position, .velocity = velocity, .contactOffset = radius, .radius = radius});
    return static_cast<std::uint32_t>(scene.particles.size() - 1);
}

TEST(MovingMesh, IsWhereItsPathLeads) {
    Scene scene;
    MeshCollider mesh = plate(0.5f, 2, {at(0, {1, 2, 3}, 30), at(1, {1, 4, 3}, 120)});
    mesh.pose = {{0, 0, 0}, test::turnedBy(0, {0, 1, 0})};
    addMeshCollider(scene, mesh);
    addBall(scene, {9, 9, 9});
    test::Runner runner(scene, {.substeps = 3});
    for (int step = 0; step <= 70; ++step) {
        if (step > 0) {
            ASSERT_EQ(runner.run(1).nonFinite, 0u);
        }
        const Pose pose = poseAt(scene.driven[0], step / 60.0);
        const Eigen::Quaterniond turn = test::toRotation(pose.rotation);
        const auto x = runner.positions(), v = runner.velocities();
        for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
            ASSERT_LE((x[i] - test::toVector(pose.position) - turn * test::toVector(mesh.vertices[i])).norm(),
                      1e-6)
                << "vertex " << i << ", step " << step;
        if (step < 1 || step >= 60) continue;
        const Vector3d omega(0, std::numbers::pi / 2, 0);
        ASSERT_LE((v[0] - Vector3d(0, 2, 0) - omega.cross(x[0] - test::toVector(pose.position))).norm(), 0.02)
            << "velocity at the end of step " << step;
    }
    EXPECT_LE(runner.velocities()[0].norm(), 0) << "its path has ended";
}

TEST(MovingMesh, LiftsWhatLiesOnItAndThrowsNothing) {
    Scene scene;
    addMeshCollider(scene, plate(0.5f, 3, {at(0.5f, {0, 0, 0}), at(1, {0, 0.1, 0}), at(2, {0, 1.1, 0})}));
    const std::uint32_t ball = addBall(scene, {0.1f, radius + thickness, 0.05f});
    scene.contacts.friction = 0.3f;
    test::Runner runner(scene, {.substeps = 10});
    for (int step = 1; step <= 119; ++step) {
        ASSERT_EQ(runner.run(1).nonFinite, 0u);
        const double height = double{poseAt(scene.driven[0], step / 60.0).position.y};
        const Vector3d x = runner.positions()[ball];
        ASSERT_NEAR(x.y() - height, double{radius + thickness}, 0.02 * double{radius}) << "step " << step;
    }
    const Vector3d x = runner.positions()[ball];
    EXPECT_NEAR(x.x(), 0.1, 2e-3);
    EXPECT_NEAR(x.z(), 0.05, 2e-3);
    EXPECT_NEAR(runner.velocities()[ball].y(), 1, 0.01);
}

// Friction mu g = 4.9 m/s^2 carries a particle around on a turning plate: at 0.3 m and 120 degrees a second
// it needs 1.3 m/s^2.
TEST(MovingMesh, CarriesWhatFrictionHolds) {
    std::vector<Keyframe> turn;
    for (int k = 0; k <= 3; ++k) turn.push_back(at(static_cast<float>(k), {0, 0, 0}, 120 * k));
    Scene scene;
    addMeshCollider(scene, plate(0.6f, 4, turn));
    scene.driven[0].pathEnd = PathEnd::loop;
    const double speed = 2 * std::numbers::pi / 3;
    const std::uint32_t ball =
        addBall(scene, {0.3f, radius + thickness, 0}, {0, 0, -static_cast<float>(0.3 * speed)});
    scene.contacts.friction = 0.5f;
    test::Runner runner(scene, {.substeps = 16});
    for (int step = 1; step <= 240; ++step) {
        ASSERT_EQ(runner.run(1).nonFinite, 0u);
        const Vector3d x = runner.positions()[ball];
        const double angle = speed * step / 60;
        ASSERT_LE(
            (x - Vector3d(0.3 * std::cos(angle), double{radius + thickness}, -0.3 * std::sin(angle))).norm(),
            0.01)
            << "step " << step;
    }
}

// A thin net moves at 40 m/s, 0.3 m a substep; no particle that it meets may end behind it.
TEST(MovingMesh, PassesNobodyHoweverFast) {
    Scene scene;
    scene.gravity = {0, 0, 0};
    addMeshCollider(scene, plate(0.8f, 5, {at(0, {0, -2, 0}), at(0.1f, {0, 2, 0}), at(0.2f, {0, 6, 0})}));
    std::vector<std::uint32_t> balls;
    for (int i = 0; i < 60; ++i)
        balls.push_back(addBall(scene, {0.11f * static_cast<float>(i % 10) - 0.5f,
                                        0.173f * static_cast<float>(i % 7) - 0.6f,
                                        0.11f * static_cast<float>(i / 10) - 0.3f}));
    test::Runner runner(scene, {.substeps = 2, .contactRoom = 256});
    for (int step = 1; step <= 10; ++step) {
        ASSERT_EQ(runner.run(1).nonFinite, 0u);
        const double height = double{poseAt(scene.driven[0], step / 60.0).position.y};
        const auto x = runner.positions();
        for (const std::uint32_t ball : balls)
            if (height > 1) {
                ASSERT_GE(x[ball].y(), height) << "ball " << ball << ", step " << step;
            }
    }
}

Scene tray() {
    Scene scene;
    addMeshCollider(
        scene,
        plate(0.5f, 3, {at(0, {0, 0, 0}), at(1.2f, {0, 0, 0}), at(1.7f, {0.1, 0.2, 0}, 10, {0, 0, 1})}));
    for (int i = 0; i < 18; ++i)
        addBall(scene, {0.1f * static_cast<float>(i % 3 - 1), 0.07f + 0.1f * static_cast<float>(i / 9),
                        0.1f * static_cast<float>(i / 3 % 3 - 1)});
    scene.contacts.friction = 0.4f;
    scene.planes = {{.offset = -1, .friction = 0.5f}};
    return scene;
}

TEST(MovingMesh, GivesTheSameBitsInAnyOrderMarginAndAfterAReset) {
    const Scene scene = tray();
    test::Runner runner(scene, {.substeps = 4});
    runner.run(90);
    const std::uint64_t hash = runner.stateHash();
    EXPECT_EQ(test::hashOfRun(scene, {.substeps = 4, .isReversed = true}, 90), hash);
    EXPECT_EQ(test::hashOfRun(scene, {.substeps = 4, .contactMargin = 1.3f}, 90), hash);
    runner.reset();
    runner.run(80);
    const test::Runner::Saved saved = runner.save();
    runner.run(10);
    EXPECT_EQ(runner.stateHash(), hash) << "after a reset";
    runner.load(saved);
    runner.run(10);
    EXPECT_EQ(runner.stateHash(), hash) << "after a saved state was loaded";
}

// Bodies on the tray sleep while it stands still and wake when it moves. All sleep again after the last
// keyframe.
TEST(MovingMesh, WakesWhatLiesOnItAsItMoves) {
    const Scene scene = tray();
    test::Runner runner(scene, {.substeps = 4, .sleeps = true});
    Status status = runner.run(70);
    EXPECT_EQ(status.sleeping, 18u);
    const std::vector<Vector3d> asleep = runner.positions();
    status = runner.run(20); // time 1.5 s
    EXPECT_EQ(status.sleeping, 0u);
    for (std::size_t i = 0; i < asleep.size(); ++i)
        EXPECT_GT(runner.positions()[i].y(), asleep[i].y() + 0.03) << "particle " << i;
    status = runner.run(140);
    EXPECT_EQ(status.sleeping, 18u) << "3.8 s";
    const std::vector<Vector3d> after = runner.positions();
    runner.run(3);
    EXPECT_EQ(runner.positions(), after);
}

TEST(MovingMesh, MayHoldACloth) {
    Scene scene;
    const std::uint32_t first =
        addCloth(scene, {.origin = {0, 1, 0}, .size = {8, 8}, .spacing = 0.1f, .areaDensity = 0.2f});
    for (std::uint32_t i = 0; i < 8; ++i) scene.fixed.push_back({first + i});
    scene.driven = {{first, 8, {at(0, {0, 0, 0}), at(1, {0.5, 0, 0}), at(5, {0.5, 0, 0})}}};
    scene.damping = 1;
    test::Runner runner(scene, {.substeps = 20});
    ASSERT_EQ(runner.run(300).nonFinite, 0u);
    const std::vector<Vector3d> x = runner.positions();
    Vector3d mean = Vector3d::Zero();
    for (std::size_t i = 0; i < x.size(); ++i) {
        if (i < 8) {
            EXPECT_LE((x[i] - test::toVector(scene.particles[i].position) - Vector3d(0.5, 0, 0)).norm(),
                      1e-6);
        }
        mean += x[i] / static_cast<double>(x.size());
    }
    EXPECT_NEAR(mean.x(), 0.5 + 0.35, 0.02) << "hangs below the bar again";
    EXPECT_EQ(test::hashOfRun(scene, {.substeps = 20, .isReversed = true}, 300), runner.stateHash());
}

TEST(MovingMesh, CostsNoPassWhereItStandsStill) {
    Scene scene;
    addMeshCollider(scene, plate(0.5f, 2, {}));
    addBall(scene, {0, 0.2f, 0});
    EXPECT_FALSE(test::usesKernel(scene, "drive_particles"));
    EXPECT_FALSE(test::usesKernel(scene, "place_colliders"));
    Scene moving;
    addMeshCollider(moving, plate(0.5f, 2, {at(0, {0, 0, 0}), at(1, {0, 1, 0})}));
    addBall(moving, {0, 0.2f, 0});
    EXPECT_TRUE(test::usesKernel(moving, "drive_particles"));
}

TEST(DrivenBodies, AreRefusedInASentence) {
    const auto complaintOf = [](const std::function<void(Scene&, Settings&)>& spoil) {
        Scene scene = tray();
        Settings settings{.substeps = 8};
        spoil(scene, settings);
        const std::vector<std::string> complaints = validate(scene, settings);
        return complaints.empty() ? std::string() : complaints.front();
    };
    EXPECT_EQ(complaintOf([](Scene&, Settings&) {}), "");
    EXPECT_NE(
        complaintOf([](Scene& s, Settings&) { s.driven[0].particleCount = 17; }).find("which is not held"),
        std::string::npos);
    EXPECT_NE(complaintOf([](Scene& s, Settings&) { s.driven[0].particleCount = 99; }).find("of 34"),
              std::string::npos);
    EXPECT_NE(
        complaintOf([](Scene& s, Settings&) { s.driven.push_back(s.driven[0]); }).find("another has too"),
        std::string::npos);
    EXPECT_NE(complaintOf([](Scene& s, Settings&) { s.driven[0].path[1].time = 0; }).find("must be above 0"),
              std::string::npos);
    EXPECT_NE(complaintOf([](Scene& s, Settings&) {
                  s.tethers = {{20, 0, 1}};
              }).find("which is driven"),
              std::string::npos);
    EXPECT_NE(complaintOf([](Scene& s, Settings& settings) {
                  s.faces.clear();
                  for (Particle& p : s.particles) p.radius = 0;
                  settings.solver = Solver::jacobi;
              }).find("use split"),
              std::string::npos);
}

} // namespace
