// Tests of shots at rigid targets of each kind and at a ball, fixed and moving: speeds from 1 to 1,000 m/s, 4
// to 64 substeps, angles up to half a radian. No shot may pass. Deformable bodies, rows and beds have their
// own tests, because a shot may go around or through scattered particles.
#include "sim/runner.hpp"
#include "sim/scenes.hpp"
#include "sinew/bodies.hpp"
#include "support/full.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>
#include <string>

using namespace sinew;
using namespace sinew::sim;
using Eigen::Vector3d;

namespace {

constexpr int shotsOfScene = 50, steps = 4;
constexpr double apart = 40;        // distance between the shots of a scene, along z [m]
constexpr double dt = 1.0 / 60;     // [s]
constexpr double ballRadius = 0.05; // [m]

// A kind of target. It stands at the origin, and shots come along x from below.
struct Kind {
    const char* name;
    bool isMoving; // targets move at up to the speed of the shot
    double depth;  // depth in front of its middle [m]
};

std::string nameOf(const testing::TestParamInfo<Kind>& info) {
    std::string name = info.param.name;
    name.front() = static_cast<char>(std::toupper(name.front()));
    return name + (info.param.isMoving ? "Moving" : "Still");
}

// Reference for the judgement of a shot: another ball, or the middle of something rigid.
struct Target {
    std::size_t ball = 0;
    bool isBall = false;
    double width = 0; // width of a rigid target: a ball within it cannot have gone around [m]
};

struct Shot {
    Vector3d start, velocity, middle, targetVelocity;
    std::size_t ball = 0;
    Target target;
};

void addWall(Scene& scene, const Shot& shot) {
    MeshCollider mesh{.name = "wall", .thickness = 0.01f};
    for (const float z : {-1.5f, 1.5f})
        for (const float y : {-1.5f, 1.5f})
            mesh.vertices.push_back(test::toFloats(shot.middle + Vector3d(0, double{y}, double{z})));
    mesh.triangles = {{0, 1, 2}, {1, 3, 2}};
    if (shot.targetVelocity != Vector3d::Zero())
        mesh.path = {{0, {}}, {1, {.position = test::toFloats(shot.targetVelocity)}}};
    addMeshCollider(scene, mesh);
}

void addCollider(Scene& scene, Collider collider, const Shot& shot) {
    collider.pose.position = test::toFloats(shot.middle);
    if (shot.targetVelocity != Vector3d::Zero())
        collider.path = {{0, collider.pose},
                         {1, {.position = test::toFloats(shot.middle + shot.targetVelocity)}}};
    scene.colliders.push_back(collider);
}

Target addTarget(Scene& scene, const std::string& kind, const Shot& shot) {
    if (kind == "wall") {
        addWall(scene, shot);
        return {.width = 1.4};
    }
    if (kind == "box" || kind == "sphere" || kind == "capsule") {
        Collider collider{.shape = ColliderShape::box, .halfExtents = {0.01f, 1, 1}};
        if (kind == "sphere") collider = {.shape = ColliderShape::sphere, .radius = 0.4f};
        if (kind == "capsule")
            collider = {.shape = ColliderShape::capsule, .radius = 0.3f, .halfLength = 0.5f};
        addCollider(scene, collider, shot);
        return {.width = kind == "box" ? 0.9 : 0.29};
    }
    scene.particles.push_back({.position = test::toFloats(shot.middle),
                               .velocity = test::toFloats(shot.targetVelocity),
                               .radius = static_cast<float>(ballRadius)});
    return {.ball = scene.particles.size() - 1, .isBall = true};
}

class Shots : public testing::TestWithParam<Kind> {
protected:
    // A shot that reaches the target within the first two steps.
    Shot shotAt(int place) {
        const double speed = std::pow(10, 3 * unit()), angle = 0.5 * unit(), turn = 2 * M_PI * unit();
        const Vector3d way(std::cos(angle), std::sin(angle) * std::cos(turn),
                           std::sin(angle) * std::sin(turn));
        Shot shot;
        shot.middle = {0, 0, apart * place};
        if (GetParam().isMoving)
            shot.targetVelocity = speed * Vector3d(-unit(), unit() - 0.5, unit() - 0.5) / 2;
        const Vector3d relative = speed * way;
        shot.velocity = relative + shot.targetVelocity;
        const double nearest = 1.02 * (ballRadius + GetParam().depth) + 0.015;
        const Vector3d aim = shot.middle + 0.02 * Vector3d(0, unit() - 0.5, unit() - 0.5);
        shot.start = aim - (nearest + 1.5 * unit() * speed * dt) * way;
        return shot;
    }

    std::vector<Shot> addShots(Scene& scene) {
        std::vector<Shot> shots;
        for (int s = 0; s < shotsOfScene; ++s) shots.push_back(shotAt(s));
        for (Shot& shot : shots) {
            shot.ball = scene.particles.size();
            scene.particles.push_back({.position = test::toFloats(shot.start),
                                       .velocity = test::toFloats(shot.velocity),
                                       .inverseMass = static_cast<float>(std::pow(10, 2 * unit() - 1)),
                                       .contactOffset = static_cast<float>(ballRadius),
                                       .radius = static_cast<float>(ballRadius)});
        }
        for (Shot& shot : shots) shot.target = addTarget(scene, GetParam().name, shot);
        return shots;
    }

    double unit() { return std::uniform_real_distribution<double>(0, 1)(random_); }
    std::mt19937 random_{29};
};

// Whether the ball has hit something.
bool hasHit(const Shot& shot, const std::vector<Vector3d>& v) {
    return (v[shot.ball] - shot.velocity).norm() > 0.01 * (shot.velocity - shot.targetVelocity).norm();
}

bool hasPassed(const Shot& shot, const std::vector<Vector3d>& x, double time) {
    const Vector3d way = (shot.velocity - shot.targetVelocity).normalized(), ball = x[shot.ball];
    const Target& target = shot.target;
    if (target.isBall) {
        const Vector3d d = ball - x[target.ball];
        return d.dot(way) > 0 && (d - d.dot(way) * way).norm() < 0.03;
    }
    const Vector3d d = ball - shot.middle - time * shot.targetVelocity;
    return d.x() > 0 && std::hypot(d.y(), d.z()) < target.width;
}

} // namespace

TEST_P(Shots, NonePasses) {
    int shots = 0, passed = 0, hit = 0;
    const std::vector<std::uint32_t> substeps = {4u, 8u, 16u, 24u, 64u};
    const int shotsOfKind = test::isFull() ? 500 : 100;
    for (int trial = 0; shots < shotsOfKind; ++trial) {
        Scene scene;
        scene.gravity = {};
        const std::vector<Shot> all = addShots(scene);
        test::Runner runner(scene, {.substeps = substeps[trial % substeps.size()], .contactRoom = 64});
        std::vector<bool> has(all.size());
        for (int step = 1; step <= steps; ++step) {
            ASSERT_FALSE(runner.run(1).isUndone) << "trial " << trial;
            const auto x = runner.positions();
            for (std::size_t s = 0; s < all.size(); ++s) {
                if (!has[s] && hasPassed(all[s], x, step * dt)) {
                    has[s] = true;
                    std::printf("trial %d, shot %zu, step %d: %u substeps, %.1f m/s, inverse mass %.2f\n",
                                trial, s, step, substeps[trial % substeps.size()],
                                (all[s].velocity - all[s].targetVelocity).norm(),
                                double{scene.particles[all[s].ball].inverseMass});
                }
            }
        }
        const auto v = runner.velocities();
        for (std::size_t s = 0; s < all.size(); ++s) {
            passed += has[s] ? 1 : 0;
            hit += hasHit(all[s], v) ? 1 : 0;
        }
        shots += shotsOfScene;
    }
    std::printf("%d shots, %d hit, %d passed\n", shots, hit, passed);
    EXPECT_EQ(passed, 0);
    EXPECT_GE(hit, shots * 95 / 100) << "shots that hit nothing show nothing";
}

INSTANTIATE_TEST_SUITE_P(Kinds, Shots,
                         testing::Values(Kind{"wall", false, 0.01}, Kind{"wall", true, 0.01},
                                         Kind{"box", false, 0.01}, Kind{"box", true, 0.01},
                                         Kind{"sphere", false, 0.4}, Kind{"sphere", true, 0.4},
                                         Kind{"capsule", false, 0.3}, Kind{"capsule", true, 0.3},
                                         Kind{"ball", false, 0.05}, Kind{"ball", true, 0.05}),
                         nameOf);
