// Pieces of too few particles are removed: from contacts, from what is drawn and from counts, and an undo
// brings them back.
#include "layout.h"
#include "sim/bodies.hpp"
#include "sim/compile.hpp"
#include "sim/scenes.hpp"
#include "sim/surface/closed_surface.hpp"
#include "sim/validate.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <numeric>

using namespace sinew;
using namespace sinew::sim;
using Eigen::Vector3d;
using test::ClosedSurface;
using test::CutBody;
using test::sweepOf;

namespace {

constexpr float spacing = 0.05f;
const double cell = std::pow(double{spacing}, 3);
constexpr float ballSpeed = 2;

// A cube with a ball that flies at its corner (0, 0, 0), along the diagonal.
Scene cube(std::uint32_t crumbs) {
    Scene scene{.name = "cube", .gravity = {0, 0, 0}};
    const Lattice lattice{.cells = {4, 4, 4}, .spacing = spacing, .radius = spacing / 2, .isCuttable = true};
    addLatticeSkin(scene, lattice, addLattice(scene, lattice), {0.7f, 0.2f, 0.1f});
    const std::uint32_t ball = addParticles(
        scene, {.center = {-0.1f, -0.1f, -0.1f}, .count = {1, 1, 1}, .radius = spacing / 2, .mass = 1e-3f});
    scene.particles[ball].velocity = {ballSpeed, ballSpeed, ballSpeed};
    scene.crumbs = crumbs;
    return scene;
}

// Parts the corner (0, 0, 0) and its three neighbours from the rest.
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
    return static_cast<std::size_t>(
        std::count(pieces.begin(), pieces.end() - 1, NO_PARTICLE)); // but the ball, which nothing may cut
}

std::size_t counted(const CutBody& body) {
    const auto sizes = body.pieceSizes();
    return std::accumulate(sizes.begin(), sizes.end(), std::size_t{0});
}

double ballSpeedAfter(CutBody& body, int steps) {
    body.runner().run(steps);
    return body.runner().velocities().back().norm();
}

} // namespace

TEST(Crumbs, AreNoPiecesAnyMore) {
    CutBody kept(cube(0)), body(cube(5));
    EXPECT_EQ(kept.cut(cornerCut()).pieces, 2u);
    const Status status = body.cut(cornerCut());
    EXPECT_EQ(status.pieces, 1u);
    EXPECT_EQ(status.linksCut, kept.runner().simulation().status(0).linksCut);
    EXPECT_EQ(gone(body), 4u);
    EXPECT_EQ(counted(body), 125u - 4);
    EXPECT_EQ(body.runner().stateHash(), kept.runner().stateHash()) << "masses and ways are what they were";
    // and stay none in steps that cut elsewhere, or find pieces smaller still
    EXPECT_EQ(body.cut(sweepOf({Vector3d(0.11, 0, 0), Vector3d(1, 0, 0)}, 1)).pieces, 2u);
    EXPECT_EQ(gone(body), 4u);
    EXPECT_EQ(body.cut(sweepOf({Vector3d(0.02, 0, 0), Vector3d(1, 0, 0)}, 1)).pieces, 3u);
    EXPECT_EQ(gone(body), 4u);
    EXPECT_EQ(counted(body), 125u - 4);
}

TEST(Crumbs, OfAsManyParticlesAsAreAskedForStay) {
    CutBody body(cube(4));
    EXPECT_EQ(body.cut(cornerCut()).pieces, 2u);
    EXPECT_EQ(gone(body), 0u);
}

TEST(Crumbs, AreNotDrawn) {
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

TEST(Crumbs, TouchNothing) {
    CutBody kept(cube(0)), body(cube(5)), whole(cube(5));
    kept.cut(cornerCut());
    body.cut(cornerCut());
    const double start = std::sqrt(3) * double{ballSpeed};
    // where the corner was in the ball's way it is not now: the ball gets on to the next particles behind
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

TEST(Crumbs, ComeBackWithTheTopology) {
    CutBody body(cube(5));
    const vk::Buffer uncut = body.runner().saveTopology();
    const auto words = body.words();
    EXPECT_EQ(body.cut(cornerCut()).pieces, 1u);
    EXPECT_EQ(gone(body), 4u);
    body.runner().loadTopology(uncut);
    EXPECT_EQ(body.words(), words);
    EXPECT_EQ(gone(body), 0u);
    EXPECT_EQ(counted(body), 125u);
    EXPECT_NEAR(drawnVolume(ClosedSurface(body)) / (64 * cell), 1, 1e-3);
    EXPECT_LT(ballSpeedAfter(body, 3), 0.9 * std::sqrt(3) * double{ballSpeed}) << "and touch again";
}

TEST(Crumbs, OfAStepThatIsUndoneAreNone) {
    CutBody body(cube(5));
    body.runner().writePosition(60, std::numeric_limits<float>::quiet_NaN());
    EXPECT_GT(body.cut(cornerCut()).nonFinite, 0u);
    EXPECT_EQ(gone(body), 0u);
    EXPECT_EQ(body.cut(cornerCut()).pieces, 1u);
    EXPECT_EQ(gone(body), 4u);
}

TEST(Crumbs, LeaveTheSameBitsInReversedOrder) {
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

TEST(Crumbs, AreInNoSceneThatKeepsThem) {
    for (const char* kernel : {"remove_crumbs", "forget_crumbs", "leave_contacts"}) {
        EXPECT_FALSE(test::usesKernel(cube(0), kernel)) << kernel;
        EXPECT_TRUE(test::usesKernel(cube(5), kernel)) << kernel;
    }
    EXPECT_EQ(describe(compile(cube(0), {})), describe(compile(cube(1), {}))) << "no piece has less than one";
}

TEST(Crumbs, AreAskedForWithANumberInRange) {
    const auto complaints = validate(cube(2'000'000), Settings{});
    ASSERT_EQ(complaints.size(), 1u);
    EXPECT_EQ(complaints[0].find("scene.crumbs: is 2e+06"), 0u) << complaints[0];
}
