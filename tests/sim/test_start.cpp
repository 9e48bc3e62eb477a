// Tests of the initial rotation, velocity and spin of bodies (sinew/start.hpp).
#include "sinew/start.hpp"

#include "sim/collision/collider_shapes.hpp"
#include "sim/runner.hpp"
#include "sim/scenes.hpp"
#include "sinew/bodies.hpp"
#include "sinew/validate.hpp"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>

using namespace sinew;
using namespace sinew::sim;
using Eigen::Vector3d;

namespace {

constexpr Vec3 velocity{0.5f, -0.25f, 1}, spin{1, -2, 3};
const Quaternion quarterAboutZ{0, 0, std::sqrt(0.5f), std::sqrt(0.5f)};

struct Sums {
    double mass = 0;
    Vector3d center = Vector3d::Zero(), momentum = Vector3d::Zero(), angular = Vector3d::Zero();
};

// The angular momentum is about the centre of mass.
Sums sumsOf(const Scene& scene, const std::vector<Vector3d>& x, const std::vector<Vector3d>& v) {
    Sums sums;
    for (std::size_t i = 0; i < x.size(); ++i) {
        const double mass = 1 / double{scene.particles[i].inverseMass};
        sums.mass += mass;
        sums.center += mass * x[i];
        sums.momentum += mass * v[i];
    }
    sums.center /= sums.mass;
    for (std::size_t i = 0; i < x.size(); ++i)
        sums.angular += (x[i] - sums.center).cross(v[i]) / double{scene.particles[i].inverseMass};
    return sums;
}

Sums sumsOf(const Scene& scene) {
    std::vector<Vector3d> x, v;
    for (const Particle& particle : scene.particles) {
        x.push_back(test::toVector(particle.position));
        v.push_back(test::toVector(particle.velocity));
    }
    return sumsOf(scene, x, v);
}

std::vector<test::NamedScene> bodiesOfEachKind() {
    std::vector<test::NamedScene> all(4);
    all[0].name = "voxels";
    addLattice(all[0].scene, {.origin = {0.1f, 0.2f, 0.3f}, .cells = {4, 2, 3}, .spacing = 0.1f});
    all[1].name = "cloth";
    addCloth(all[1].scene, {.origin = {0.1f, 0.2f, 0.3f}, .size = {7, 5}, .spacing = 0.1f});
    all[2].name = "chain";
    addChain(all[2].scene,
             {.direction = {1, 0, 0}, .particles = 9, .endMass = 0.05f, .compliance = 1e-4f, .pinned = {}});
    all[3].name = "particles";
    addParticles(all[3].scene, {.count = {3, 2, 4}, .jitter = 0.01f});
    for (test::NamedScene& one : all) one.scene.gravity = {};
    return all;
}

TEST(Start, GivesEveryKindOfBodyItsVelocityAndSpin) {
    for (auto& [name, scene] : bodiesOfEachKind()) {
        SCOPED_TRACE(name);
        const Vector3d center = sumsOf(scene).center;
        start(scene, 0, {.velocity = velocity, .spin = spin});
        const Vector3d v = test::toVector(velocity), w = test::toVector(spin);
        for (const Particle& particle : scene.particles)
            ASSERT_LE(
                (test::toVector(particle.velocity) - v - w.cross(test::toVector(particle.position) - center))
                    .norm(),
                1e-6);
        const Sums sums = sumsOf(scene);
        EXPECT_LE((sums.momentum - sums.mass * v).norm(), 1e-6 * sums.mass);
    }
}

TEST(Start, TurnsABodyAboutItsMiddleAndKeepsItsLinks) {
    Scene scene;
    addLattice(scene, {.origin = {0, 0, 0}, .cells = {4, 2, 2}, .spacing = 0.5f});
    const Scene before = scene;
    start(scene, 0, {.rotation = quarterAboutZ});
    for (std::size_t i = 0; i < scene.particles.size(); ++i) {
        const Vector3d from = test::toVector(before.particles[i].position),
                       to = test::toVector(scene.particles[i].position);
        ASSERT_LE((to - Vector3d(1 - (from.y() - 0.5), 0.5 + (from.x() - 1), from.z())).norm(), 1e-6) << i;
    }
    EXPECT_TRUE(validate(scene, {.substeps = 4}).empty());
    for (const DistanceConstraint& link : scene.distances)
        ASSERT_NEAR((test::toVector(scene.particles[link.a].position) -
                     test::toVector(scene.particles[link.b].position))
                        .norm(),
                    double{link.restLength}, 1e-6);
}

TEST(Start, IsOfEachBodyItsOwnAndOfNoneBefore) {
    Scene scene;
    addChain(scene, {.particles = 3, .pinned = {}});
    addLattice(scene, {.origin = {1, 0, 0}, .spacing = 0.1f});
    addLattice(scene, {.origin = {5, 0, 0}, .spacing = 0.1f});
    start(scene, 1, {.spin = {0, 0, 2}, .rotation = quarterAboutZ});
    for (std::uint32_t i = 0; i < 3; ++i) EXPECT_EQ(scene.particles[i].velocity.y, 0);
    for (std::uint32_t i = 3; i < 11; ++i) {
        const Vec3 &a = scene.particles[i].velocity, &b = scene.particles[i + 8].velocity;
        EXPECT_NEAR(a.x, b.x, 1e-6);
        EXPECT_NEAR(a.y, b.y, 1e-5);
        EXPECT_NEAR(std::hypot(a.x, a.y), 0.1 * std::sqrt(2), 1e-5);
    }
}

TEST(Start, LeavesWhatIsHeldAtRest) {
    Scene scene;
    addChain(scene, {.particles = 4, .pinned = {0}});
    start(scene, 0, {.velocity = velocity, .spin = spin});
    EXPECT_EQ(scene.particles[0].velocity.x, 0);
    EXPECT_EQ(scene.particles[0].velocity.z, 0);
    EXPECT_NE(scene.particles[1].velocity.x, 0);
}

TEST(Start, OfNothingChangesNoBit) {
    Scene scene = test::spinningBlock({1, 0, 0});
    const Scene before = scene;
    start(scene, 0, {});
    for (std::size_t i = 0; i < scene.particles.size(); ++i) {
        ASSERT_EQ(scene.particles[i].position.x, before.particles[i].position.x);
        ASSERT_EQ(scene.particles[i].velocity.z, before.particles[i].velocity.z);
    }
}

TEST(Start, OfASpinningTurnedBodyKeepsMomentumInFreeFlight) {
    for (const Solver solver : {Solver::split, Solver::gaussSeidel}) {
        SCOPED_TRACE(testing::PrintToString(solver));
        Scene scene;
        scene.gravity = {};
        addLattice(scene, {.cells = {4, 2, 3}, .spacing = 0.1f, .youngModulus = 1e5f});
        start(scene, 0,
              {.velocity = velocity, .spin = {0.5f, -1, 1.5f}, .rotation = test::turnedBy(40, {1, 2, 3})});
        const Sums first = sumsOf(scene);
        test::Runner runner(scene, {.solver = solver, .substeps = 24, .iterations = 1, .theta = 0});
        ASSERT_EQ(runner.run(60).nonFinite, 0u);
        const Sums last = sumsOf(scene, runner.positions(), runner.velocities());
        EXPECT_LE((last.momentum - first.momentum).norm(), 1e-4 * first.momentum.norm());
        EXPECT_LE((last.center - first.center - test::toVector(velocity)).norm(), 1e-4);
        EXPECT_LE((last.angular - first.angular).norm(), 0.01 * first.angular.norm());
    }
}

} // namespace
