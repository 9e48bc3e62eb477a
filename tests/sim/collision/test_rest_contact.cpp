// Tests of bodies that touch or overlap at load and keep that distance as their rest distance
// (Particle::keepsRest): they do not move, do not creep under load, and after parting they act like any other
// pair.
#include "sim/collision/contact_scenes.hpp"
#include "sim/collision/rest_checks.hpp"
#include "sim/runner.hpp"
#include "sim/scenes.hpp"
#include "sinew/bodies.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <memory>
#include <string>

using namespace sinew;
using namespace sinew::sim;
using namespace sinew::test;
using Eigen::Vector3d;

namespace {

constexpr float spacing = 0.05f, wide = spacing / 2; // of cubes, and of their particles [m]
constexpr std::uint32_t cells = 3;
constexpr float side = cells * spacing;

void keep(Scene& scene, std::size_t first = 0) {
    for (std::size_t i = first; i < scene.particles.size(); ++i) scene.particles[i].keepsRest = true;
}

std::uint32_t addCube(Scene& scene, const Vec3& origin, float edge = spacing, std::uint32_t count = cells) {
    const auto first = static_cast<std::uint32_t>(scene.particles.size());
    addLattice(scene, {.name = "cube" + std::to_string(first),
                       .origin = origin,
                       .cells = {count, count, count},
                       .spacing = edge,
                       .youngModulus = 1e5f,
                       .radius = edge / 2});
    return first;
}

// Two cubes above each other; the lower one starts at (0, 0, 0). The surfaces of their particles overlap by
// `overlap`. The upper particles are shifted by `aside` along x and z.
struct Cubes {
    Scene scene = weightless();
    std::uint32_t upper = 0; // first particle of the upper cube
};

Cubes cubes(float overlap, float aside = 0) {
    Cubes made;
    addCube(made.scene, {0, 0, 0});
    made.upper = addCube(made.scene, {aside, side + 2 * wide - overlap, aside});
    return made;
}

double middle(const std::vector<Vector3d>& x, std::size_t first) {
    double sum = 0;
    for (std::size_t i = first; i < x.size(); ++i) sum += x[i].y();
    return sum / static_cast<double>(x.size() - first);
}

// Presses the particles from `first` on down with multiples of their weight, then removes the load.
struct Pressed {
    double pressed = 0, back = 0; // how far their centre is down [m]
};

Pressed press(Scene scene, std::uint32_t first, float weights, const Settings& settings) {
    for (std::uint32_t i = 0; i < scene.particles.size(); ++i)
        if (i < first) scene.fixed.push_back({i});
    scene.damping = 20;
    scene.contacts.friction = 0.8f;
    Runner runner(scene, settings);
    const double start = middle(runner.positions(), first);
    const auto load = [&](float from, float to) { // in multiples of the weight
        for (int s = 0; s < 90; ++s) {
            const float now = from + (to - from) * std::min(1.0f, static_cast<float>(s) / 60);
            runner.step({.dt = scene.dt, .gravity = {0, -9.81f * now, 0}});
        }
        return start - middle(runner.positions(), first);
    };
    Pressed result;
    result.pressed = load(0, weights);
    result.back = load(weights, 0.05f);
    return result;
}

} // namespace

TEST(RestContact, OfCubesThatTouchOrOverlapKeepsThemStill) {
    for (const float overlap : {0.0f, 0.3f * wide, 1.0f * spacing})
        for (const float aside : {0.0f, 0.4f * spacing}) {
            Cubes made = cubes(overlap, aside);
            keep(made.scene, made.upper);
            expectStill(made.scene, {.substeps = 8, .contactRoom = 64}, double{wide}, 200,
                        "cubes in each other by " + std::to_string(overlap / wide) + " radii, beside by " +
                            std::to_string(aside / wide));
        }
}

// The default mode does not keep rest distances.
TEST(RestContact, PartsByDefault) {
    Cubes made = cubes(0.3f * wide);
    Runner runner(made.scene, {.substeps = 16, .contactRoom = 64});
    runner.run(60);
    const auto x = runner.positions();
    double nearest = 1;
    for (std::size_t i = 0; i < made.upper; ++i)
        for (std::size_t j = made.upper; j < x.size(); ++j) nearest = std::min(nearest, (x[i] - x[j]).norm());
    EXPECT_GT(nearest, 2 * double{wide} * (1 - 1e-3));
}

// Compares with the same cubes placed exactly in contact, which are equally soft.
TEST(RestContact, HoldsTenWeightsAsAnOrdinaryContactDoes) {
    const Settings settings{.substeps = 16, .contactRoom = 64};
    Cubes touching = cubes(0);
    const Pressed ordinary = press(touching.scene, touching.upper, 10, settings);
    for (const float overlap : {0.3f * wide, 1.0f * spacing}) {
        Cubes made = cubes(overlap);
        keep(made.scene);
        const Pressed kept = press(made.scene, made.upper, 10, settings);
        std::printf("overlap %.2f radii: pressed %.4f r, back %.4f r; ordinary %.4f r, %.4f r\n",
                    double{overlap / wide}, kept.pressed / double{wide}, kept.back / double{wide},
                    ordinary.pressed / double{wide}, ordinary.back / double{wide});
        EXPECT_LT(kept.pressed, 1.1 * ordinary.pressed + 0.02 * double{wide});
        EXPECT_NEAR(kept.back, ordinary.back, 0.02 * double{wide});
    }
}

// Two balls whose rest distance is a part of their reach: under load they stay at it, for any part.
TEST(RestContact, IsTheDistanceAtWhichALoadedPairStands) {
    for (const float part : {0.95f, 0.7f, 0.3f, 0.1f})
        for (const float other : {1.0f, 4.0f, 0.25f}) {
            Scene scene;
            const float radius = other * ballRadius, reach = ballRadius + radius;
            scene.gravity = {0, -98.1f, 0};
            scene.particles = {fixedBallAt({0, 0, 0}), ballAt({0, part * reach, 0})};
            scene.particles[1].radius = radius;
            scene.particles[0].keepsRest = true;
            Runner runner(scene, {.substeps = 16});
            runner.run(120);
            EXPECT_NEAR(runner.positions()[1].y(), double{part * reach}, 5e-3 * double{reach})
                << part << ", " << other;
        }
}

// A pair that crosses itself in a substep is put back, and not released on the other side.
TEST(RestContact, StopsWhatComesFast) {
    for (const float speed : {1.0f, 10.0f, 100.0f}) {
        Scene scene = weightless();
        scene.particles = {fixedBallAt({0, 0, 0}), ballAt({0, 0.4f * ballRadius, 0}, {0, -speed, 0})};
        scene.particles[1].keepsRest = true;
        Runner runner(scene, {.substeps = 16});
        for (int step = 0; step < 30; ++step) {
            runner.run(1);
            EXPECT_GT(runner.positions()[1].y(), 0.39 * double{ballRadius}) << speed << " m/s, step " << step;
        }
    }
}

// A link drives a pair through itself in one substep, with and without fast particles elsewhere.
TEST(RestContact, StopsWhatPassesWhileOthersAreFast) {
    constexpr float h = 1.0f / 960, start = 0.2f * ballRadius, length = 4 * ballRadius;
    for (const bool othersAreFast : {false, true})
        for (const float restitution : {0.0f, 1.0f}) {
            Scene scene = weightless();
            scene.contacts.restitution = restitution;
            const Vec3 down{0, -0.5f * ballRadius / h, 0}; // half a radius a substep
            scene.particles = {
                fixedBallAt({0, 0, 0}), ballAt({0, start, 0}, down), ballAt({0, start + length, 0}, down),
                ballAt({100 * ballRadius, 0, 0}, {othersAreFast ? 4 * ballRadius / h : 0, 0, 0})};
            scene.distances = {{1, 2, length, 0}};
            keep(scene);
            Runner runner(scene, {.substeps = 16});
            double lowest = 9, fastest = 0;
            for (int step = 0; step < 10; ++step) {
                runner.run(1);
                lowest = std::min(lowest, runner.positions()[1].y() / double{ballRadius});
                fastest = std::max(fastest, runner.velocities()[2].y() / double{-down.y});
            }
            std::printf("driven through itself%s: lowest at %.3f radii, back at %.3f of the speed\n",
                        othersAreFast ? " while others are fast" : "", lowest, fastest);
            EXPECT_GT(lowest, 0) << othersAreFast << ", " << restitution;
            EXPECT_LT(fastest, 1.02) << othersAreFast << ", " << restitution;
            if (restitution > 0) {
                EXPECT_GT(fastest, 0.45) << othersAreFast;
            }
        }
}

// With more overlaps than a particle can store, the step is refused, so that no rest distance is lost.
TEST(RestContact, IsRefusedWhereAParticleOverlapsTooMany) {
    Scene scene = weightless();
    scene.particles = {ballAt({0, 0, 0})};
    scene.particles[0].radius = 1;
    for (int k = 0; k < 48 * 48; ++k) {
        scene.particles.push_back(
            ballAt({0.025f * static_cast<float>(k % 48 - 24), 0, 0.025f * static_cast<float>(k / 48 - 24)}));
        scene.particles.back().radius = 0.01f;
    }
    keep(scene);
    Runner runner(scene, {.substeps = 16, .contactRoom = 64});
    EXPECT_GT(runner.run(1).contactRoom, 0u);
    EXPECT_EQ(moved(runner.positions(), scene), 0) << "the step is undone";
}

// A pair keeps its rest distance under any motion within its reach. After parting, it touches at the normal
// distance.
TEST(RestContact, IsKeptUntilAPairHasParted) {
    const float start = 1.4f * ballRadius;
    Scene scene;
    scene.gravity = {0, -9.81f, 0};
    scene.particles = {fixedBallAt({0, 0, 0}), ballAt({0, start, 0})};
    keep(scene);
    Runner runner(scene, {.substeps = 16});
    const auto fly = [&](double to) { // up, until it is higher than `to`
        for (int step = 0; step < 200 && runner.positions()[1].y() < to * double{ballRadius}; ++step)
            runner.step({.dt = 1.0f / 600, .gravity = {0, 9.81f, 0}});
        for (int step = 0; step < 600; ++step) runner.step({.dt = 1.0f / 600, .gravity = {0, -9.81f, 0}});
        return runner.positions()[1].y() / double{ballRadius};
    };
    EXPECT_NEAR(fly(1.6), 1.4, 0.01) << "inside of touching";
    EXPECT_NEAR(fly(1.6), 1.4, 0.01) << "again";
    EXPECT_NEAR(fly(2.05), 2.0, 0.01) << "apart";
    EXPECT_NEAR(fly(1.0), 2.0, 0.01) << "again";
}

// Restitution acts on contacts at their rest distance; a pair farther apart has no contact.
TEST(RestContact, ReboundsAtItsRestDistance) {
    Scene scene = weightless();
    scene.contacts.restitution = 1;
    scene.particles = {fixedBallAt({0, 0, 0}), ballAt({0, 1.2f * ballRadius, 0}, {0, 0.3f, 0})};
    keep(scene);
    scene.gravity = {0, -4, 0};
    Runner runner(scene, {.substeps = 16});
    double lowest = 9, highest = 0;
    for (int step = 0; step < 60; ++step) {
        runner.run(1);
        const double y = runner.positions()[1].y() / double{ballRadius};
        lowest = std::min(lowest, y);
        highest = std::max(highest, y);
    }
    const double top = 1.2 + 0.3 * 0.3 / 8 / double{ballRadius};
    EXPECT_GT(lowest, 1.15);
    EXPECT_NEAR(highest, top, 0.03);
    EXPECT_LT(top, 2) << "it must not have parted";
}

TEST(RestContact, EndsInTheSameBitsForAnyMarginRoomOrderAndForm) {
    for (const float friction : {0.0f, 0.3f}) {
        Cubes made = cubes(0.8f * spacing, 0.3f * spacing);
        keep(made.scene, made.upper);
        made.scene.contacts.friction = friction;
        made.scene.gravity = {2, -9.81f, 0};
        made.scene.planes = {{.offset = -0.04f, .friction = friction}};
        const auto hash = [&](const Settings& settings) { return hashOfRun(made.scene, settings, 25); };
        const Settings settings{.substeps = 8, .contactRoom = 64};
        Settings narrow = settings, roomy = settings, reversed = settings, loads = settings;
        narrow.contactMargin = 0.2f;
        roomy.contactRoom = 80;
        reversed.isReversed = true;
        loads.forms.usesTexels = false;
        const std::uint64_t first = hash(settings);
        std::printf("state_hash %016llx\n", static_cast<unsigned long long>(first));
        EXPECT_EQ(hash(narrow), first) << "another margin";
        EXPECT_EQ(hash(roomy), first) << "more room";
        EXPECT_EQ(hash(reversed), first) << "reversed";
        EXPECT_EQ(hash(loads), first) << "without texels";
    }
}

// Rest distances survive an undone step, a larger simulation that takes over, and a saved state.
TEST(RestContact, IsRememberedAcrossStatesAndUndoneSteps) {
    Cubes made = cubes(0.8f * spacing, 0.3f * spacing);
    keep(made.scene);
    made.scene.gravity = {2, -9.81f, 0};
    made.scene.planes = {{.offset = -0.04f}};
    expectRemembered(made.scene, {.substeps = 8, .contactRoom = 64}, 10);
}

// The pieces of a cut body keep its rest distances.
TEST(RestContact, IsKeptByThePiecesOfACut) {
    Scene scene = weightless();
    addCube(scene, {0, 0, 0});
    const auto upper = static_cast<std::uint32_t>(scene.particles.size());
    addLattice(scene, {.name = "cut",
                       .origin = {0.3f * spacing, side + 2 * wide - 0.8f * spacing, 0.3f * spacing},
                       .cells = {cells, cells, cells},
                       .spacing = spacing,
                       .youngModulus = 1e5f,
                       .radius = wide,
                       .isCuttable = true});
    for (const bool isKept : {true, false}) {
        if (!isKept)
            for (Particle& particle : scene.particles) particle.keepsRest = false;
        else
            keep(scene);
        Runner runner(scene, {.substeps = 8, .contactRoom = 64});
        const float x = scene.particles[upper].position.x + 1.5f * spacing;
        const std::array<Vec3, 2> from{Vec3{x, -1, -1}, Vec3{x, 2, -1}}, to{Vec3{x, -1, 1}, Vec3{x, 2, 1}};
        const Status status = runner.cut({.from = from, .to = to});
        EXPECT_GT(status.linksCut, 0u);
        EXPECT_EQ(runner.run(60).nonFinite, 0u);
        const double way = moved(runner.positions(), scene) / double{wide};
        std::printf("pieces of a cut: moved by %.2e radii, %s\n", way, isKept ? "kept" : "parting");
        if (isKept)
            EXPECT_LT(way, 1e-2);
        else
            EXPECT_GT(way, 0.2);
    }
}

// Overlapping bodies at rest fall asleep, and all of them wake together.
TEST(RestContact, SleepsAndWakesAtItsRestDistance) {
    Cubes made = cubes(0.8f * spacing, 0.3f * spacing);
    keep(made.scene);
    made.scene.gravity = {0, -9.81f, 0};
    made.scene.damping = 5;
    made.scene.contacts.friction = 0.5f;
    made.scene.planes = {{.offset = -wide, .friction = 0.5f}};
    Runner runner(made.scene, {.substeps = 16, .contactRoom = 64, .sleeps = true});
    const auto awake = [&] {
        return std::ranges::count_if(runner.inverseMasses(), [](float w) { return w > 0; });
    };
    int steps = 0;
    for (; steps < 400 && awake() > 0; steps += 20) runner.run(20);
    std::printf("asleep after %d steps\n", steps);
    EXPECT_EQ(awake(), 0);
    const auto x = runner.positions();
    runner.step({.dt = made.scene.dt, .gravity = {1, -9.81f, 0}}); // a change of gravity wakes them
    EXPECT_EQ(awake(), static_cast<std::ptrdiff_t>(made.scene.particles.size())) << "all of it wakes";
    runner.run(30);
    EXPECT_LT((runner.positions()[made.upper] - x[made.upper]).norm(), 0.05 * double{wide});
}

// Bodies of coarse and fine voxels that overlap by a part of a coarse voxel.
TEST(RestContact, KeepsThreeOrgansInEachOther) {
    Scene scene = weightless();
    addCube(scene, {0, 0, 0}, 0.08f, 3);
    addCube(scene, {0.21f, 0.05f, 0.03f}, 0.03f, 6);
    addCube(scene, {0.06f, 0.2f, 0.05f}, 0.03f, 6);
    const Settings settings{.substeps = 8, .contactRoom = 256};
    keep(scene);
    expectStill(scene, settings, 0.015, 200, "three organs");
    scene.gravity = {0, -9.81f, 0};
    scene.planes = {{.offset = -0.04f}};
    Runner runner(scene, settings);
    const auto energyOf = [&] { // kinetic and potential energy
        double energy = kineticEnergy(scene, runner.velocities());
        const auto x = runner.positions();
        for (std::size_t i = 0; i < x.size(); ++i)
            energy += 9.81 * x[i].y() / double{scene.particles[i].inverseMass};
        return energy;
    };
    const double start = energyOf();
    double most = start;
    for (int step = 0; step < 60; ++step) {
        const Status status = runner.run(1);
        ASSERT_EQ(status.nonFinite + status.contactRoom, 0u);
        most = std::max(most, energyOf());
    }
    std::printf("three organs that fall apart on a plane: %.4f J at first, %.4f J at most\n", start, most);
    EXPECT_LT(most, 1.002 * start) << "nothing is thrown";
}

// Parts of one body without links between them act like separate bodies.
TEST(RestContact, HoldsBetweenPartsOfOneBody) {
    Scene scene = weightless();
    Lattice lattice{.name = "parts",
                    .cells = {3, 7, 3},
                    .spacing = spacing,
                    .fill = std::vector<float>(3 * 7 * 3, 1.0f),
                    .radius = wide};
    for (std::size_t c = 0; c < 9; ++c) // the middle layer is empty
        for (std::size_t y = 3; y < 4; ++y) lattice.fill[c % 3 + 3 * (y + 7 * (c / 3))] = 0;
    const LatticeCorners corners = addLattice(scene, lattice);
    for (std::uint32_t y = 4; y <= 7; ++y)
        for (std::uint32_t z = 0; z <= 3; ++z)
            for (std::uint32_t x = 0; x <= 3; ++x)
                scene.particles[corners.at(x, y, z)].position.y -= 0.4f * wide;
    keep(scene);
    expectStill(scene, {.substeps = 16, .contactRoom = 64}, double{wide}, 200, "two parts of one body");
}
