// Tests of fragments of sheets: they are removed from counts, drawing and contacts of particles, faces and
// edges, as those of voxel bodies.
#include "common/layout.h"
#include "sim/compile/compile.hpp"
#include "sim/cutting/cut_body.hpp"
#include "sinew/bodies.hpp"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <utility>

using namespace sinew;
using namespace sinew::sim;
using Eigen::Vector3d;
using test::CutBody;
using test::sweepOf;

namespace {

constexpr float spacing = 0.05f;
constexpr std::array<std::uint32_t, 2> size{9, 7};
constexpr std::uint32_t particles = size[0] * size[1];

// A sheet with a ball that falls onto its corner (0, 0, 0).
Scene sheet(std::uint32_t debris, float thickness = 0.4f * spacing) {
    Scene scene{.name = "sheet", .gravity = {0, 0, 0}};
    addCloth(scene, {.size = size,
                     .spacing = spacing,
                     .stretchCompliance = 1e-4f,
                     .shearCompliance = 1e-3f,
                     .thickness = thickness,
                     .isCuttable = true});
    const std::uint32_t ball = addParticles(scene, {.center = {0.4f * spacing, 0.1f, 0.2f * spacing},
                                                    .count = {1, 1, 1},
                                                    .radius = 0.01f,
                                                    .mass = 1e-4f});
    scene.particles[ball].velocity = {0, -2, 0};
    scene.debris = debris;
    return scene;
}

// A cut that separates the corner (0, 0, 0) and two rows of neighbours.
test::Sweep cornerCut() {
    return sweepOf({Vector3d(1.3, 0, 1.3) * double{spacing}, Vector3d(1, 0, 1).normalized()}, 1);
}

// Drawn area of the only skin, both sides together.
double drawnArea(CutBody& body) {
    const Simulation& simulation = body.runner().simulation();
    body.runner().skin();
    const auto vertices = test::queue().download<layout::SkinVertex>(simulation.skinVertices());
    const auto indices = test::queue().download<std::uint32_t>(simulation.skinIndices());
    const auto pieces = test::queue().download<layout::DrawArguments>(simulation.pieceDraws())[0];
    double area = 0;
    const auto add = [&](std::size_t first, std::size_t count) {
        const auto at = [&](std::size_t index) {
            const layout::vec4& x = vertices[indices[index]].position;
            return Vector3d(x.x, x.y, x.z);
        };
        for (std::size_t i = first; i < first + count; i += 3)
            area += (at(i + 1) - at(i)).cross(at(i + 2) - at(i)).norm() / 2;
    };
    add(simulation.skins()[0].firstIndex, simulation.skins()[0].indexCount);
    add(pieces.firstIndex, pieces.indexCount);
    return area;
}

std::size_t gone(const CutBody& body) {
    const auto pieces = body.pieces();
    return static_cast<std::size_t>(std::ranges::count(pieces, REMOVED_PIECE));
}

// Height of the ball after some steps.
double ballHeight(CutBody& body, int steps) {
    body.runner().run(steps);
    return body.runner().positions().back().y();
}

template <typename T> std::vector<T> listOf(CutBody& body, BufferId buffer) {
    return test::queue().download<T>(body.runner().simulation().view(buffer));
}

} // namespace

TEST(SheetDebris, IsNoPieceAndIsNotDrawn) {
    CutBody kept(sheet(0)), body(sheet(7));
    const vk::Buffer uncut = body.runner().saveTopology();
    const double whole = drawnArea(body);
    EXPECT_EQ(kept.cut(cornerCut()).pieces, 2u);
    const Status status = body.cut(cornerCut());
    EXPECT_EQ(status.pieces, 1u);
    EXPECT_EQ(status.debris, 1u);
    EXPECT_EQ(status.debrisParticles, 6u);
    EXPECT_EQ(gone(body), 6u);
    EXPECT_EQ(body.runner().stateHash(), kept.runner().stateHash()) << "masses and ways are what they were";
    // The blade cuts 2.6 cells off both sides of the corner.
    const double cutOff = 2 * 2.6 * 2.6 / 2 * double{spacing} * double{spacing};
    EXPECT_NEAR(drawnArea(kept) / whole, 1, 1e-3);
    EXPECT_NEAR((whole - drawnArea(body)) / cutOff, 1, 0.01);
    body.runner().loadTopology(uncut);
    EXPECT_EQ(gone(body), 0u);
    EXPECT_NEAR(drawnArea(body) / whole, 1, 1e-4);
    EXPECT_EQ(body.runner().run(1).debris, 0u);
}

TEST(SheetDebris, TouchesNothing) {
    for (const bool isUndone : {false, true}) {
        CutBody kept(sheet(0), {.substeps = 8}), body(sheet(7), {.substeps = 8});
        const vk::Buffer uncut = body.runner().saveTopology();
        kept.cut(cornerCut());
        body.cut(cornerCut());
        if (isUndone) body.runner().loadTopology(uncut);
        const double free = 0.1 - 2.0 * 7 / 60; // height without an obstacle
        const double stopped = ballHeight(kept, 6), further = ballHeight(body, 6);
        std::printf("the ball at %.4f m, where the corner was removed%s at %.4f m\n", stopped,
                    isUndone ? " and put back" : "", further);
        EXPECT_GT(stopped, free + 0.01);
        if (isUndone)
            EXPECT_GT(further, free + 0.01);
        else
            EXPECT_NEAR(further, free, 1e-5);
    }
}

// The corner is pulled apart as soon as it is cut off.
TEST(SheetDebris, TearsNoMore) {
    for (const std::uint32_t debris : {0u, 7u}) {
        Scene scene = sheet(debris);
        scene.grids[0].tearStrain = 0.3f;
        scene.particles[0].velocity = {-3, 0, -3};
        CutBody body(scene);
        const std::uint32_t cut = body.cut(cornerCut()).linksCutInAll;
        const std::uint32_t torn = body.runner().run(5).linksCutInAll - cut;
        EXPECT_EQ(torn > 0, debris == 0) << torn;
    }
}

// Edges are searched by their middles. Those of a removed fragment must have left the grid.
TEST(SheetDebris, HasNoEdgesThatTouch) {
    Scene scene = sheet(7, 0.1f * spacing); // thin sheet: edges touch, too
    CutBody body(scene);
    const BufferId edges = body.runner().simulation().program().contacts.edges;
    ASSERT_NE(edges, BufferId{});
    const auto touching = [&](const std::vector<std::uint32_t>& of) {
        std::size_t count = 0;
        for (const auto& edge : listOf<layout::ContactEdge>(body, edges))
            count += edge.radius > 0 && std::ranges::count(of, edge.a) + std::ranges::count(of, edge.b) == 2
                         ? 1
                         : 0;
        return count;
    };
    const StateLayout layout = stateLayout(scene, {});
    std::vector<std::uint32_t> corner;
    for (const auto& [x, z] : {std::pair{0u, 0u}, {1u, 0u}, {2u, 0u}, {0u, 1u}, {1u, 1u}, {0u, 2u}})
        corner.push_back(layout.slot[body.particleAt(x, 0, z)]);
    EXPECT_EQ(touching(corner), 7u) << "six sides of cells, and the diagonal of the first";
    body.cut(cornerCut());
    EXPECT_EQ(touching(corner), 0u);
}

// Fixed particles have no radius for fixed faces, but this does not make them fragments.
TEST(SheetDebris, IsNoSheetThatIsHeldEverywhere) {
    Scene scene = sheet(0);
    for (std::uint32_t i = 0; i < particles; ++i) scene.particles[i].inverseMass = 0;
    CutBody body(scene);
    const test::Sweep beside{.from = {{5, -1, -1}, {5, -1, 1}}, .to = {{5, 1, -1}, {5, 1, 1}}};
    ASSERT_EQ(body.cut(beside).linksCutInAll, 0u);
    body.runner().run(30);
    EXPECT_GT(body.runner().positions()[particles].y(), 0) << "a ball of 2 m/s fell through";
}
