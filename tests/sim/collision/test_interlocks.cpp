// Tests of bodies that interlock at load: their detection, the data about their lattices, and that the result
// depends only on the scene. cases_hard/test_interlocked.cpp tests how they part.
#include "common/layout.h"
#include "sim/collision/contact_scenes.hpp"
#include "sim/collision/interlocks.hpp"
#include "sim/compile/compile.hpp"
#include "sim/lattice/depths.hpp"
#include "sim/model/components.hpp"
#include "sim/runner.hpp"
#include "sim/scenes.hpp"
#include "sinew/bodies.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <string>

using namespace sinew;
using namespace sinew::sim;
using namespace sinew::test;
using Eigen::Vector3d;

namespace {

constexpr float spacing = 2 * ballRadius;

void addCube(Scene& scene, const Vec3& corner, std::uint32_t cells = 3) {
    const std::size_t first = scene.particles.size();
    addLattice(scene, {.name = "cube" + std::to_string(first),
                       .origin = corner,
                       .cells = {cells, cells, cells},
                       .spacing = spacing,
                       .youngModulus = 1e5f});
    for (std::size_t i = first; i < scene.particles.size(); ++i) scene.particles[i].radius = ballRadius;
}

// Cubes of 4^3 particles; the second lies `apart` from the first along x, and slightly aside.
Scene cubes(float apart) {
    Scene scene = weightless();
    addCube(scene, {0, 0, 0});
    addCube(scene, {apart, 0.03f, 0.02f});
    return scene;
}

Scene pressedCubes(float friction = 0) {
    Scene scene = cubes(0.2f);
    scene.gravity = {0, -9.81f, 0};
    scene.contacts.friction = friction;
    scene.planes = {{.offset = -0.2f, .friction = friction}};
    return scene;
}

collision::interlocks::Plan planOf(const Scene& scene) {
    const StateLayout layout = orderedLayout(scene.particles.size());
    std::vector<std::array<float, 3>> x(layout.count);
    std::vector<float> radii(layout.count, -1), weights(layout.count, 1);
    std::vector<float> ofParticles;
    for (std::size_t i = 0; i < scene.particles.size(); ++i) {
        x[i] = {scene.particles[i].position.x, scene.particles[i].position.y, scene.particles[i].position.z};
        radii[i] = scene.particles[i].radius > 0 ? scene.particles[i].radius : -1;
        ofParticles.push_back(radii[i]);
    }
    const std::vector<std::uint32_t> bodies = linkedBodies(scene);
    const auto exclusions = collision::contact_lists::excludedPairs(scene, bodies, ofParticles, layout);
    return collision::interlocks::find(scene, layout, bodies,
                                       collision::overlaps::find({.positions = x,
                                                                  .radii = radii,
                                                                  .inverseMasses = weights,
                                                                  .exclusions = exclusions,
                                                                  .least = 1e-4f,
                                                                  .limit = 256}));
}

std::uint64_t hashOf(const Scene& scene, const Settings& settings, int steps) {
    Runner runner(scene, settings);
    const Status status = runner.run(steps);
    EXPECT_EQ(status.nonFinite + status.contactRoom, 0u);
    return runner.stateHash();
}

} // namespace

TEST(NodeDepths, OfABlockAreWaysToTheNearestFace) {
    Scene scene;
    addLattice(scene, {.name = "block", .cells = {4, 5, 7}, .spacing = 0.1f, .youngModulus = 1e5f});
    const Grid& grid = scene.grids[0];
    const auto depths = lattice::depthsOf(grid);
    ASSERT_EQ(depths.size(), 5u * 6 * 8);
    for (std::size_t n = 0; n < depths.size(); ++n) {
        const Vec3& x = scene.particles[n].position;
        const float nearest =
            std::min({x.x, 0.4f - x.x, x.y, 0.5f - x.y, x.z, 0.7f - x.z}); // the block starts at the origin
        EXPECT_NEAR(depths[n].depth, nearest, 1e-6f) << n;
        const Vec3& out = depths[n].outward;
        const float along = out.x * (x.x - 0.2f) + out.y * (x.y - 0.25f) + out.z * (x.z - 0.35f);
        EXPECT_GE(along, 0) << n;
        const float length = std::hypot(out.x, out.y, out.z);
        EXPECT_TRUE(length == 0 || std::abs(length - 1) < 1e-6f) << n;
        EXPECT_TRUE(along > 0 || depths[n].depth > 0) << n;
    }
}

TEST(NodeDepths, LeadOutOfANotchByTheNotch) {
    Scene scene;
    std::vector<std::uint8_t> fill(6 * 6 * 6, LATTICE_FULL);
    for (std::size_t z = 0; z < 6; ++z)
        for (std::size_t y = 3; y < 6; ++y) fill[2 + 6 * (y + 6 * z)] = fill[3 + 6 * (y + 6 * z)] = 0;
    Grid grid{.nodes = {7, 7, 7}, .fill = fill, .restLength = {0.1f, 0, 0}};
    for (std::uint32_t node = 0; node < 7 * 7 * 7; ++node) // except those in the empty cells
        if (node % 7 != 3 || node / 7 % 7 < 4) grid.node.push_back(node);
    const auto depths = lattice::depthsOf(grid);
    const auto at = [&](std::uint32_t x, std::uint32_t y, std::uint32_t z) {
        const auto found = std::ranges::find(grid.node, x + 7 * (y + 7 * z));
        return depths[static_cast<std::size_t>(found - grid.node.begin())];
    };
    EXPECT_EQ(at(3, 3, 3).depth, 0) << "the notch's floor";
    EXPECT_NEAR(at(3, 3, 3).outward.y, 1, 1e-6);
    EXPECT_EQ(at(2, 5, 3).depth, 0) << "its wall";
    EXPECT_NEAR(at(2, 5, 3).outward.x, 1, 1e-6);
    EXPECT_NEAR(at(3, 2, 3).depth, 0.1f, 1e-6) << "below it";
    EXPECT_NEAR(at(3, 2, 3).outward.y, 1, 1e-6);
}

TEST(Interlocks, AreBodiesOfWhichParticlesTouchInsideALattice) {
    EXPECT_EQ(planOf(cubes(0.2f)).pairs, 1u);
    EXPECT_EQ(planOf(cubes(0.35f)).pairs, 0u) << "only faces overlap";
    EXPECT_EQ(planOf(cubes(1)).pairs, 0u);
    Scene scene = cubes(1);
    scene.particles.push_back(ballAt({0.15f, 0.15f, 0.15f})); // inside the first cube
    scene.particles.push_back(ballAt({0.15f, 0.15f, 0.38f})); // at a face of the first cube
    EXPECT_EQ(planOf(scene).pairs, 1u);
    addCube(scene, {0.9f, 0.2f, 0.2f}); // inside the second cube
    const auto plan = planOf(scene);
    EXPECT_EQ(plan.pairs, 2u);
    EXPECT_EQ(plan.nodes[128].body, plan.nodes[0].body + 2) << "bodies in order: cube, cube, ball, cube";
    EXPECT_EQ(plan.nodes[129].body, 0u);
    EXPECT_EQ(planOf(weightless()).pairs, 0u);
}

TEST(Interlocks, CostNothingWhereThereAreNone) {
    for (const float apart : {0.35f, 1.0f})
        for (const BufferSpec& buffer : compile(cubes(apart), {.substeps = 4}).buffers)
            EXPECT_EQ(buffer.label.find("interlocks"), std::string::npos) << apart;
    EXPECT_FALSE(usesKernel(cubes(0.35f), "separate_interlocked", {.substeps = 4}));
    EXPECT_TRUE(usesKernel(cubes(0.2f), "separate_interlocked", {.substeps = 4}));
}

TEST(Interlocks, PartInTheSameBitsForAnyMarginRoomOrderAndForm) {
    for (const float friction : {0.0f, 0.4f}) {
        const Scene scene = pressedCubes(friction);
        const Settings settings{.substeps = 8, .contactRoom = 64};
        const std::uint64_t hash = hashOf(scene, settings, 60);
        Settings narrow = settings, wide = settings, roomy = settings, reversed = settings, loads = settings;
        narrow.contactMargin = 0.2f;
        wide.contactMargin = 1;
        roomy.contactRoom = 80;
        reversed.isReversed = true;
        loads.forms.usesTexels = false;
        EXPECT_EQ(hashOf(scene, narrow, 60), hash) << "a narrower margin";
        EXPECT_EQ(hashOf(scene, wide, 60), hash) << "a wider margin";
        EXPECT_EQ(hashOf(scene, roomy, 60), hash) << "more room";
        EXPECT_EQ(hashOf(scene, reversed, 60), hash) << "reversed";
        EXPECT_EQ(hashOf(scene, loads, 60), hash) << "without texels";
    }
}

TEST(Interlocks, AreRememberedByAnUndoneStepAndByASimulationWithMoreRoom) {
    const Scene scene = pressedCubes(0.4f);
    constexpr int steps = 40;
    const std::uint64_t hash = hashOf(scene, {.substeps = 8, .contactRoom = 64}, steps);
    Settings settings{.substeps = 8, .contactRoom = 1};
    auto runner = std::make_unique<Runner>(scene, settings);
    int growths = 0, done = 0;
    for (int step = 0; done < steps && step < 2 * steps; ++step) {
        if (step % 9 == 5) runner->writePosition(3, std::numeric_limits<float>::quiet_NaN());
        const Status status = runner->run(1);
        if (status.contactRoom > 0) {
            settings.contactRoom = status.contactRoom;
            auto larger = std::make_unique<Runner>(scene, settings);
            larger->takeOver(*runner);
            runner = std::move(larger);
            ++growths;
        } else if (status.nonFinite == 0) {
            ++done;
        }
    }
    EXPECT_EQ(done, steps);
    EXPECT_GE(growths, 1);
    EXPECT_EQ(runner->stateHash(), hash);
}

// A ball inside a lattice leaves by the nearest face.
TEST(Interlocks, LetABallOutOfALattice) {
    Scene scene = weightless();
    addCube(scene, {0, 0, 0}, 5);
    scene.particles.push_back(ballAt({0.36f, 0.27f, 0.22f}));
    const std::size_t ball = scene.particles.size() - 1;
    Runner runner(scene, {.substeps = 16, .contactRoom = 64});
    runner.run(120);
    const auto x = runner.positions();
    EXPECT_LE(deepestOf({x.begin(), x.end()}), 1) << "those of the lattice touch at rest";
    double nearest = 1;
    for (std::size_t i = 0; i < ball; ++i) nearest = std::min(nearest, (x[i] - x[ball]).norm());
    EXPECT_GE(nearest, double{spacing} * (1 - 1e-4)) << "[m]";
    EXPECT_LE(runner.velocities()[ball].norm(), 2.3 * double{scene.contacts.recoverySpeed});
}

// Recovery resumes when sleeping bodies wake: only an awake body may release a pair.
TEST(Interlocks, PartWhereBodiesSleep) {
    Scene scene = pressedCubes(0.4f);
    scene.dampingTime = 2e-3f;
    scene.damping = 2;
    Runner runner(scene, {.substeps = 16, .contactRoom = 64, .sleeps = true});
    Status status;
    for (int step = 0; step < 300; ++step) status = runner.run(1);
    EXPECT_EQ(status.sleeping, scene.particles.size());
    double nearest = 1;
    const auto x = runner.positions();
    for (std::size_t i = 0; i < 64; ++i)
        for (std::size_t j = 64; j < 128; ++j) nearest = std::min(nearest, (x[i] - x[j]).norm());
    EXPECT_GE(nearest, 0.9 * double{spacing}) << "[m]";
}
