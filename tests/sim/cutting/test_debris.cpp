// Tests of fragments: pieces with too few particles are removed from contacts, drawing and counts, and an
// undo restores them.
#include "common/layout.h"
#include "sim/compile/compile.hpp"
#include "sim/lattice/placement.hpp"
#include "sim/scenes.hpp"
#include "sim/surface/closed_surface.hpp"
#include "sinew/bodies.hpp"
#include "sinew/validate.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <numeric>
#include <utility>

using namespace sinew;
using namespace sinew::sim;
using Eigen::Vector3d;
using test::ClosedSurface;
using test::CutBody;
using test::Runner;
using test::sweepOf;

namespace {

constexpr float spacing = 0.05f;
const double cell = std::pow(double{spacing}, 3);
constexpr float ballSpeed = 2;

// A cube with a ball that flies along the diagonal at its corner (0, 0, 0).
Scene cube(std::uint32_t debris) {
    Scene scene{.name = "cube", .gravity = {0, 0, 0}};
    const Lattice lattice{.cells = {4, 4, 4}, .spacing = spacing, .radius = spacing / 2, .isCuttable = true};
    addLatticeSkin(scene, lattice, addLattice(scene, lattice), {0.7f, 0.2f, 0.1f});
    const std::uint32_t ball = addParticles(
        scene, {.center = {-0.1f, -0.1f, -0.1f}, .count = {1, 1, 1}, .radius = spacing / 2, .mass = 1e-3f});
    scene.particles[ball].velocity = {ballSpeed, ballSpeed, ballSpeed};
    scene.debris = debris;
    return scene;
}

// A cut that separates the corner (0, 0, 0) and its three neighbours.
test::Sweep cornerCut() {
    return sweepOf({Vector3d::Constant(0.45 * double{spacing}), Vector3d(1, 1, 1).normalized()}, 1);
}

double drawnVolume(const ClosedSurface& surface) {
    double volume = 0;
    for (const auto& triangle : surface.triangles()) {
        const auto& [a, b, c] = triangle.points;
        volume += surface.drawn()[a].dot(surface.drawn()[b].cross(surface.drawn()[c])) / 6;
    }
    return volume;
}

std::size_t gone(const CutBody& body) {
    const auto pieces = body.pieces();
    return static_cast<std::size_t>(std::ranges::count(pieces, REMOVED_PIECE));
}

std::size_t counted(const CutBody& body) {
    const auto sizes = body.pieceSizes();
    return std::accumulate(sizes.begin(), sizes.end(), std::size_t{0});
}

// The particles that cornerCut() separates.
std::vector<std::uint32_t> corner(const CutBody& body) {
    return {body.particleAt(0, 0, 0), body.particleAt(1, 0, 0), body.particleAt(0, 1, 0),
            body.particleAt(0, 0, 1)};
}

double massOf(const Scene& scene, const std::vector<std::uint32_t>& particles) {
    double mass = 0;
    for (const std::uint32_t i : particles) mass += 1 / double{scene.particles[i].inverseMass};
    return mass;
}

Vector3d cornerMomentum(const CutBody& body, Runner& runner) {
    const std::vector<Vector3d> velocities = runner.velocities();
    Vector3d momentum = Vector3d::Zero();
    for (const std::uint32_t i : corner(body))
        momentum += velocities[i] / double{body.scene().particles[i].inverseMass};
    return momentum;
}

// The cube with a skin whose cells are not marked as cuttable: the skin stretches over cuts.
Scene stretchedCube(std::uint32_t debris) {
    Scene scene = cube(debris);
    const Grid& grid = scene.grids[0];
    Skin& skin = scene.skins[0];
    for (const std::uint32_t particle : std::exchange(skin.particles, {})) {
        const auto node = lattice::coordinates(grid, grid.node[particle - grid.firstParticle]);
        CellEmbedding& around = skin.cells.emplace_back();
        std::array<std::uint32_t, 3> low{};
        for (std::size_t axis = 0; axis < 3; ++axis) low[axis] = std::min(node[axis], grid.nodes[axis] - 2);
        around.weights = {static_cast<float>(node[0] - low[0]), static_cast<float>(node[1] - low[1]),
                          static_cast<float>(node[2] - low[2])};
        for (std::uint32_t c = 0; c < 8; ++c)
            around.particles[c] =
                grid.firstParticle + (low[0] + (c & 1)) +
                grid.nodes[0] * ((low[1] + (c >> 1 & 1)) + grid.nodes[1] * (low[2] + (c >> 2)));
    }
    return scene;
}

double ballSpeedAfter(CutBody& body, int steps) {
    body.runner().run(steps);
    return body.runner().velocities().back().norm();
}

} // namespace

TEST(Debris, IsNoPieceAnyMore) {
    CutBody kept(cube(0)), body(cube(5));
    EXPECT_EQ(kept.cut(cornerCut()).pieces, 2u);
    const Status status = body.cut(cornerCut());
    EXPECT_EQ(status.pieces, 1u);
    EXPECT_EQ(status.linksCut, kept.runner().simulation().status(0).linksCut);
    EXPECT_EQ(gone(body), 4u);
    EXPECT_EQ(counted(body), 125u - 4);
    EXPECT_EQ(status.debris, 1u);
    EXPECT_EQ(status.debrisParticles, 4u);
    EXPECT_NEAR(double{status.debrisMass} / massOf(body.scene(), corner(body)), 1, 1e-6);
    EXPECT_EQ(body.runner().stateHash(), kept.runner().stateHash()) << "masses and ways are what they were";
    // They stay removed in steps that cut elsewhere or find smaller pieces.
    EXPECT_EQ(body.cut(sweepOf({Vector3d(0.11, 0, 0), Vector3d(1, 0, 0)}, 1)).pieces, 2u);
    EXPECT_EQ(gone(body), 4u);
    EXPECT_EQ(body.cut(sweepOf({Vector3d(0.02, 0, 0), Vector3d(1, 0, 0)}, 1)).pieces, 3u);
    EXPECT_EQ(gone(body), 4u);
    EXPECT_EQ(counted(body), 125u - 4);
}

// Blades do not cut removed fragments.
TEST(Debris, IsMetByNoBlade) {
    CutBody kept(cube(0)), body(cube(5));
    kept.cut(cornerCut());
    body.cut(cornerCut());
    const test::Sweep beside =
        sweepOf({Vector3d(0.5 * double{spacing}, 0, 0), Vector3d::UnitX()}, 0.3 * double{spacing});
    EXPECT_GT(kept.cut(beside).linksCut, 0u);
    const Status status = body.cut(beside);
    EXPECT_EQ(status.linksCut, 0u);
    EXPECT_EQ(status.debris, 1u);
    EXPECT_EQ(gone(body), 4u);
    EXPECT_EQ(body.cut(sweepOf({Vector3d(0.02, 0, 0), Vector3d(1, 0, 0)}, 1)).debris, 1u);
}

TEST(Debris, OfAsManyParticlesAsAreAskedForStay) {
    CutBody body(cube(4));
    EXPECT_EQ(body.cut(cornerCut()).pieces, 2u);
    EXPECT_EQ(gone(body), 0u);
}

TEST(Debris, IsNotDrawn) {
    CutBody kept(cube(0)), body(cube(5));
    kept.cut(cornerCut());
    body.cut(cornerCut());
    const ClosedSurface all(kept), rest(body);
    const std::vector<double> volumes = all.volumes(cell);
    ASSERT_EQ(volumes.size(), 2u);
    EXPECT_NEAR(drawnVolume(all) / (64 * cell), 1, 1e-4);
    EXPECT_NEAR(drawnVolume(rest) / volumes[0], 1, 1e-4);
    EXPECT_EQ(rest.openEdges(), 0u);
    double reach = 1;
    for (const auto& triangle : rest.triangles()) {
        const auto& [a, b, c] = triangle.points;
        const Vector3d x = rest.drawn()[a];
        if ((rest.drawn()[b] - x).cross(rest.drawn()[c] - x).norm() > 1e-9 * double{spacing})
            reach = std::min(reach, x.sum());
    }
    EXPECT_GT(reach, 1.3 * double{spacing}) << "what lies before the cut";
}

TEST(Debris, TouchesNothing) {
    CutBody kept(cube(0)), body(cube(5)), whole(cube(5));
    kept.cut(cornerCut());
    body.cut(cornerCut());
    const double start = std::sqrt(3) * double{ballSpeed};
    // The removed corner no longer blocks the ball, which reaches the next particles behind it.
    const auto height = [](CutBody& of) {
        double farthest = -1;
        for (int step = 0; step < 3; ++step) {
            of.runner().run(1);
            farthest = std::max(farthest, of.runner().positions().back().sum());
        }
        return farthest;
    };
    EXPECT_LT(ballSpeedAfter(whole, 3), 0.9 * start) << "the ball hits the corner";
    const double stopped = height(kept), further = height(body);
    EXPECT_GT(further, stopped + double{spacing} / 2);
}

// Triangles that are not clipped disappear if any of their corners belongs to a fragment.
TEST(Debris, TakesTheTrianglesOfASkinThatStretchesWithIt) {
    for (const std::uint32_t debris : {0u, 5u}) {
        CutBody body(stretchedCube(debris));
        const auto shown = [&body] {
            const auto indices =
                test::queue().download<std::uint32_t>(body.runner().simulation().skinIndices());
            std::vector<std::array<std::uint32_t, 3>> triangles;
            for (std::size_t t = 0; t < indices.size(); t += 3)
                if (indices[t] != indices[t + 1])
                    triangles.push_back({indices[t], indices[t + 1], indices[t + 2]});
            return triangles;
        };
        const vk::Buffer uncut = body.runner().saveTopology();
        const auto all = body.scene().skins[0].triangles;
        EXPECT_EQ(shown(), all);
        body.cut(cornerCut());
        auto left = all;
        const Scene named = cube(0); // the same vertices, named by particle
        const std::vector<std::uint32_t> removed = corner(body);
        if (debris > 0)
            std::erase_if(left, [&](const auto& triangle) {
                return std::ranges::any_of(triangle, [&](std::uint32_t vertex) {
                    return std::ranges::count(removed, named.skins[0].particles[vertex]) > 0;
                });
            });
        EXPECT_EQ(shown(), left);
        EXPECT_EQ(left.size() < all.size(), debris > 0);
        body.runner().loadTopology(uncut);
        EXPECT_EQ(shown(), all);
    }
}

TEST(Debris, IsHeldByNoGrab) {
    for (const bool isHeldBefore : {false, true})
        for (const std::uint32_t debris : {0u, 5u}) {
            CutBody body(cube(debris), {.substeps = 2, .grabs = 1});
            Runner& runner = body.runner();
            const Grab grab{.particle = body.particleAt(0, 0, 0), .radius = 0.06f, .target = {0, -1, 0}};
            const std::span<const Grab> grabs = isHeldBefore ? std::span(&grab, 1) : std::span<const Grab>{};
            const test::Sweep sweep = cornerCut();
            runner.step({.dt = 1.0f / 60, .gravity = {}, .grabs = grabs});
            runner.step({.dt = 1.0f / 60, .gravity = {}, .grabs = grabs, .blade = sweep.blade()});
            const Vector3d before = cornerMomentum(body, runner);
            runner.step({.dt = 1.0f / 60, .gravity = {}, .grabs = std::span(&grab, 1)});
            Grab pulled = grab;
            pulled.target = {0, -2, 0};
            for (int step = 0; step < 3; ++step)
                runner.step({.dt = 1.0f / 60, .gravity = {}, .grabs = std::span(&pulled, 1)});
            const double gained = (cornerMomentum(body, runner) - before).norm();
            const double some = 0.1 * massOf(body.scene(), corner(body)); // at 0.1 m/s
            if (debris > 0)
                EXPECT_LT(gained, 1e-5 * some);
            else
                EXPECT_GT(gained, some);
        }
}

// Removed fragments fall without a floor, and soon fall asleep, so that they cost nothing.
TEST(Debris, Sleeps) {
    for (const std::uint32_t debris : {0u, 5u}) {
        Scene scene = cube(debris);
        scene.gravity = {0, -9.81f, 0};
        const std::vector<std::uint32_t> loose = corner(CutBody(scene));
        for (std::uint32_t i = 0; i < scene.particles.size(); ++i)
            if (std::ranges::count(loose, i) == 0) scene.fixed.push_back({i});
        CutBody body(scene, {.substeps = 2, .sleeps = true});
        const vk::Buffer uncut = body.runner().saveTopology();
        body.cut(cornerCut());
        EXPECT_EQ(body.runner().run(60).sleeping, debris > 0 ? 4u : 0u);
        body.runner().loadTopology(uncut);
        EXPECT_EQ(body.runner().run(2).sleeping, 0u) << "and are pulled back";
    }
}

TEST(Debris, ComesBackWithTheTopology) {
    CutBody body(cube(5));
    const vk::Buffer uncut = body.runner().saveTopology();
    const auto words = body.words();
    EXPECT_EQ(body.cut(cornerCut()).pieces, 1u);
    EXPECT_EQ(gone(body), 4u);
    body.runner().loadTopology(uncut);
    EXPECT_EQ(body.words(), words);
    EXPECT_EQ(gone(body), 0u);
    EXPECT_EQ(counted(body), 125u);
    EXPECT_EQ(body.runner().run(1).debris, 0u);
    EXPECT_NEAR(drawnVolume(ClosedSurface(body)) / (64 * cell), 1, 1e-3);
    EXPECT_LT(ballSpeedAfter(body, 3), 0.9 * std::sqrt(3) * double{ballSpeed}) << "and touch again";
}

TEST(Debris, OfAStepThatIsUndoneIsNone) {
    CutBody body(cube(5));
    body.runner().writePosition(60, std::numeric_limits<float>::quiet_NaN());
    EXPECT_GT(body.cut(cornerCut()).nonFinite, 0u);
    EXPECT_EQ(gone(body), 0u);
    EXPECT_EQ(body.cut(cornerCut()).pieces, 1u);
    EXPECT_EQ(gone(body), 4u);
}

TEST(Debris, LeavesTheSameBitsInReversedOrder) {
    std::vector<std::uint64_t> states, surfaces;
    for (const bool isReversed : {false, true}) {
        CutBody body(cube(5), {.substeps = 2, .isReversed = isReversed});
        body.cut(cornerCut());
        body.runner().run(4);
        states.push_back(body.runner().stateHash());
        surfaces.push_back(ClosedSurface(body).hash());
    }
    EXPECT_EQ(states[0], states[1]);
    EXPECT_EQ(surfaces[0], surfaces[1]);
}

// Only a cut makes fragments.
TEST(Debris, IsNoSmallBodyThatNobodyCut) {
    Scene scene = cube(10);
    addLattice(
        scene,
        {.name = "small", .origin = {1, 1, 1}, .cells = {1, 1, 1}, .spacing = spacing, .isCuttable = true});
    Runner runner(scene, {.substeps = 2});
    const Status status = runner.cut(cornerCut().blade());
    EXPECT_EQ(status.debris, 1u);
    EXPECT_EQ(status.debrisParticles, 4u);
    EXPECT_EQ(status.pieces, 2u);
}

TEST(Debris, IsInNoSceneThatKeepsIt) {
    for (const char* kernel : {"remove_debris", "clear_debris_sizes", "remove_debris_contacts"}) {
        EXPECT_FALSE(test::usesKernel(cube(0), kernel)) << kernel;
        EXPECT_TRUE(test::usesKernel(cube(5), kernel)) << kernel;
    }
    EXPECT_EQ(describe(compile(cube(0), {})), describe(compile(cube(1), {}))) << "no piece has less than one";
}

TEST(Debris, IsAskedForWithANumberInRange) {
    const auto complaints = validate(cube(2'000'000), Settings{});
    ASSERT_EQ(complaints.size(), 1u);
    EXPECT_EQ(complaints[0].find("scene.debris: is 2e+06"), 0u) << complaints[0];
}
