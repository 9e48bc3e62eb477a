// Hard case 14 for lattices: bodies that overlap by a third or a half at the start part at the recovery
// speed, for all numbers of substeps, positions, rotations and deformations.
#include "sim/collision/contact_scenes.hpp"
#include "sim/runner.hpp"
#include "sim/scenes.hpp"
#include "sinew/bodies.hpp"
#include "support/full.hpp"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

using namespace sinew;
using namespace sinew::sim;
using namespace sinew::test;
using Eigen::Vector3d;

namespace {

constexpr double radius = double{ballRadius};
constexpr std::uint32_t nodes = 6; // of a cube along each axis
constexpr std::size_t count = nodes * nodes * nodes;
constexpr double side = nodes * 2 * radius; // [m]

// Relative placement of two interlocked cubes of touching particles.
struct Cubes {
    double overlap = 0.5; // in cube sides
    double off = 0;       // sideways offset [cells]
    double angle = 0;     // rotation of the second about its middle [rad]
    double spin = 0;      // its initial angular velocity [rad/s]
    double squash = 1;    // its initial scale along y
    float youngModulus = 1e5f;
};

Scene interlockedCubes(const Cubes& cubes) {
    constexpr float spacing = 2 * ballRadius;
    Scene scene = weightless();
    for (const char* name : {"left", "right"})
        addLattice(scene, {.name = name,
                           .cells = {nodes - 1, nodes - 1, nodes - 1},
                           .spacing = spacing,
                           .youngModulus = cubes.youngModulus});
    const Vector3d axis = Vector3d(1, 2, 3).normalized();
    const Eigen::AngleAxisd turn(cubes.angle, axis);
    const double half = 0.5 * (nodes - 1) * 2 * radius, beside = cubes.off * 2 * radius;
    const Vector3d middle(half, half, half), to(side * (1 - cubes.overlap), beside, beside);
    for (std::size_t i = 0; i < 2 * count; ++i) {
        Particle& particle = scene.particles[i];
        particle.radius = ballRadius;
        if (i < count) continue;
        Vector3d arm =
            Vector3d(double{particle.position.x}, double{particle.position.y}, double{particle.position.z}) -
            middle;
        arm.y() *= cubes.squash;
        arm = turn * arm;
        const Vector3d x = middle + to + arm, v = cubes.spin * axis.cross(arm);
        particle.position = {static_cast<float>(x.x()), static_cast<float>(x.y()), static_cast<float>(x.z())};
        particle.velocity = {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
    }
    return scene;
}

Vector3d meanOf(const std::vector<Vector3d>& values, std::size_t first) {
    Vector3d mean = Vector3d::Zero();
    for (std::size_t i = first; i < first + count; ++i) mean += values[i] / static_cast<double>(count);
    return mean;
}

// Deepest overlap between the two cubes [radii].
double deepestBetween(const std::vector<Vector3d>& x) {
    double nearest = 2 * radius;
    for (std::size_t i = 0; i < count; ++i)
        for (std::size_t j = count; j < 2 * count; ++j) nearest = std::min(nearest, (x[i] - x[j]).norm());
    return 2 - nearest / radius;
}

struct Parting {
    double energy = 0; // largest gain over the start [J]
    double speed = 0;  // of the centres at the end [m/s]
    double apart = 0;  // distance of the centres at the end [sides]
    double deepest = 0;
    double momentum = 0;
    std::uint64_t hash = 0;
};

Parting part(const Scene& scene, const Settings& settings, int steps) {
    Runner runner(scene, settings);
    Parting result;
    const double before = kineticEnergy(scene, runner.velocities());
    const Vector3d momentum = momentumOf(scene, runner.velocities());
    for (int step = 0; step < steps; ++step) {
        const Status status = runner.run(1);
        EXPECT_EQ(status.nonFinite + status.contactRoom, 0u);
        result.energy = std::max(result.energy, kineticEnergy(scene, runner.velocities()) - before);
    }
    const auto x = runner.positions(), v = runner.velocities();
    result.speed = (meanOf(v, count) - meanOf(v, 0)).norm();
    result.apart = (meanOf(x, count) - meanOf(x, 0)).norm() / side;
    result.deepest = deepestBetween(x);
    result.momentum = (momentumOf(scene, v) - momentum).norm();
    result.hash = runner.stateHash();
    return result;
}

void print(const Cubes& cubes, std::uint32_t substeps, const Parting& parting) {
    std::printf("overlap %.1f, off %.1f, angle %.2f, spin %.0f, squash %.1f, E %.0e, %2u substeps: at most "
                "%.1f J more, "
                "%.2f sides apart at %.2f m/s, deepest %.3f r, momentum off by %.0e kg m/s\n",
                cubes.overlap, cubes.off, cubes.angle, cubes.spin, cubes.squash, double{cubes.youngModulus},
                substeps, parting.energy, parting.apart, parting.speed, parting.deepest, parting.momentum);
}

} // namespace

// Speed and energy are bounded by multiples of those of contacts that part at v_rec, so the bounds do not
// depend on the initial overlap.
TEST(HardContacts, Case14InterlockedCubesPartSlowlyWhateverTheSubsteps) {
    for (const Cubes& cubes :
         {Cubes{}, Cubes{.off = 0.3}, Cubes{.overlap = 0.3}, Cubes{.overlap = 0.3, .off = 0.3}})
        for (const std::uint32_t substeps : {8u, 16u, 32u}) {
            const bool isPlain = cubes.overlap == Cubes{}.overlap && cubes.off == 0;
            if (substeps != 16 && !isPlain && !test::isFull()) continue;
            const Scene scene = interlockedCubes(cubes);
            const Parting parting = part(scene, {.substeps = substeps, .contactRoom = 64}, 75);
            print(cubes, substeps, parting);
            EXPECT_EQ(parting.deepest, 0) << "[radii]";
            EXPECT_GE(parting.apart, 1) << "[sides]";
            EXPECT_LE(parting.speed, 2.6 * double{scene.contacts.recoverySpeed});
            EXPECT_LE(parting.energy, 70) << "[J]";
            EXPECT_LE(parting.momentum, 1e-4) << "of some 60 kg m/s each";
        }
}

// Normals must follow bodies that lie askew, spin or are squashed: a stretched lattice has the normals of its
// faces.
TEST(HardContacts, Case14InterlockedCubesPartHoweverTheyLieTurnAndDeform) {
    for (const Cubes& cubes :
         {Cubes{.angle = 0.35}, Cubes{.overlap = 0.3, .off = 0.3, .angle = 0.9}, Cubes{.spin = 8},
          Cubes{.off = 0.3, .youngModulus = 2e4f}, Cubes{.angle = 0.5, .spin = 3, .youngModulus = 2e4f}}) {
        const Scene scene = interlockedCubes(cubes);
        const Parting parting = part(scene, {.substeps = 16, .contactRoom = 64}, 75);
        print(cubes, 16, parting);
        EXPECT_EQ(parting.deepest, 0) << "[radii]";
        EXPECT_GE(parting.apart, 1) << "[sides]";
        EXPECT_LE(parting.speed, 2.6 * double{scene.contacts.recoverySpeed});
        EXPECT_LE(parting.energy, 70) << "[J]";
        EXPECT_LE(parting.momentum, 1e-4);
    }
    const Cubes squashed{.squash = 0.6}; // the spring-back releases 490 J and more
    const Parting parting = part(interlockedCubes(squashed), {.substeps = 16, .contactRoom = 64}, 75);
    print(squashed, 16, parting);
    EXPECT_EQ(parting.deepest, 0) << "[radii]";
    EXPECT_GE(parting.apart, 1) << "[sides]";
}

TEST(HardContacts, Case14PartsAtTheSpeedOfRecovery) {
    double before = 0;
    for (const float speed : {0.25f, 0.5f, 1.0f}) {
        Scene scene = interlockedCubes({.off = 0.3});
        scene.contacts.recoverySpeed = speed;
        const Parting parting =
            part(scene, {.substeps = 16, .contactRoom = 64}, static_cast<int>(60 / speed));
        std::printf("v_rec %.2f m/s: ", double{speed});
        print({.off = 0.3}, 16, parting);
        EXPECT_EQ(parting.deepest, 0);
        EXPECT_GE(parting.speed, 1.2 * before) << "slower recovery, slower bodies";
        EXPECT_LE(parting.speed, 2.6 * double{speed});
        before = parting.speed;
    }
}

// Restitution acts along the lines between particles even while the bodies part; they part all the same.
TEST(HardContacts, Case14PartsWhereParticlesRebound) {
    for (const float restitution : {0.5f, 1.0f}) {
        Scene scene = interlockedCubes({.off = 0.3});
        scene.contacts.restitution = restitution;
        const Parting parting = part(scene, {.substeps = 16, .contactRoom = 64}, 120);
        std::printf("restitution %.1f: ", double{restitution});
        print({.off = 0.3}, 16, parting);
        EXPECT_EQ(parting.deepest, 0);
        EXPECT_GE(parting.apart, 1);
        EXPECT_LE(parting.energy, 70) << "[J]";
    }
}

TEST(HardContacts, Case14EndsInTheSameBitsInReversedOrder) {
    const Scene scene = interlockedCubes({.off = 0.3, .angle = 0.35, .spin = 3});
    const auto hashOf = [&](bool isReversed) {
        return part(scene, {.substeps = 16, .contactRoom = 64, .isReversed = isReversed}, 60).hash;
    };
    EXPECT_EQ(hashOf(true), hashOf(false));
}
