// Tests of triangle meshes: welding, counting defects, measuring, orienting.
#include "mesh/triangle_mesh.hpp"

#include "mesh/generate.hpp"
#include "mesh/split_edges.hpp"
#include "meshes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

using namespace sinew::mesh;
using namespace sinew::mesh::test;

namespace {

const TriangleMesh unitBox = box({0, 0, 0}, {1, 1, 1});

} // namespace

TEST(Inspect, MeasuresABox) {
    const MeshReport report = inspect(box({1, 2, 3}, {2, 4, 6}));
    EXPECT_TRUE(report.defects.isClosed());
    EXPECT_EQ(report.defects.flippedEdges, 0u);
    EXPECT_NEAR(report.volume, 6, 1e-12);
    EXPECT_NEAR(report.area, 2 * (2 + 3 + 6), 1e-12);
    EXPECT_EQ(report.low.y, 2);
    EXPECT_EQ(report.high.z, 6);
}

TEST(Inspect, KeepsItsDigitsFarFromTheOrigin) {
    EXPECT_NEAR(inspect(box({65536, 65536, 65536}, {65537, 65537, 65537})).volume, 1, 1e-12);
}

TEST(Inspect, CountsTheEdgesOfAHole) {
    TriangleMesh open = unitBox;
    open.triangles.resize(10); // removes one side of the box
    const MeshDefects defects = inspect(open).defects;
    EXPECT_EQ(defects.boundaryEdges, 4u);
    EXPECT_FALSE(defects.isClosed());
}

TEST(Inspect, CountsFlippedAndNonManifoldEdges) {
    EXPECT_EQ(inspect(withFlipped(unitBox, 12)).defects.flippedEdges, 3u);
    EXPECT_TRUE(inspect(withFlipped(unitBox, 12)).defects.isClosed());
    TriangleMesh fin = unitBox;
    fin.positions.push_back({0.5f, 0.5f, 3});
    fin.triangles.push_back({4, 5, 8}); // a third triangle at an edge
    EXPECT_EQ(inspect(fin).defects.nonManifoldEdges, 1u);
    EXPECT_EQ(inspect(fin).defects.boundaryEdges, 2u);
}

TEST(Inspect, SaysNothingOfAnEmptyMesh) {
    const MeshReport report = inspect({});
    EXPECT_EQ(report.volume, 0);
    EXPECT_TRUE(report.defects.isClosed());
}

TEST(Weld, JoinsVerticesOfEqualPosition) {
    TriangleMesh soup = unwelded(unitBox);
    soup.positions[0].x = -0.0f; // equals 0
    MeshDefects defects;
    const TriangleMesh welded = weld(soup, defects);
    EXPECT_EQ(welded.positions.size(), 8u);
    EXPECT_EQ(welded.triangles.size(), 12u);
    EXPECT_TRUE(defects.isClosed());
    EXPECT_EQ(welded.name, "box");
}

TEST(Weld, KeepsWhatIsMerelyNear) {
    TriangleMesh tiny = scaled(unwelded(generate("sphere", 16)), 1e-7f);
    MeshDefects defects;
    EXPECT_EQ(weld(tiny, defects).positions.size(), generate("sphere", 16).positions.size());
    EXPECT_EQ(defects.degenerateTriangles, 0u);
}

TEST(Weld, DropsAndCountsDegenerateAndDuplicateTriangles) {
    TriangleMesh mesh = unitBox;
    mesh.triangles.push_back({0, 0, 1}); // a repeated vertex
    mesh.positions.insert(mesh.positions.end(),
                          {{0, 0, 0}, {0.5f, 0, 0}}); // a copy of vertex 0; the middle of an edge
    mesh.triangles.push_back({8, 1, 0});              // a repeated position
    mesh.triangles.push_back({0, 9, 1});              // collinear corners
    mesh.triangles.push_back({3, 0, 2});              // the first one again, rotated
    mesh.triangles.push_back({0, 3, 2});              // the first one seen from behind: not a duplicate
    MeshDefects defects;
    const TriangleMesh welded = weld(mesh, defects);
    EXPECT_EQ(defects.degenerateTriangles, 3u);
    EXPECT_EQ(defects.duplicateTriangles, 1u);
    EXPECT_EQ(welded.triangles.size(), 13u);
    EXPECT_EQ(welded.positions.size(), 8u) << "the vertex only a dropped triangle used stays";
}

TEST(Weld, ChangesNothingTheSecondTime) {
    MeshDefects defects;
    const TriangleMesh once = weld(unwelded(generate("organ", 16)), defects), twice = weld(once, defects);
    EXPECT_EQ(once.triangles, twice.triangles);
    ASSERT_EQ(once.positions.size(), twice.positions.size());
    for (std::size_t i = 0; i < once.positions.size(); ++i)
        EXPECT_EQ(once.positions[i].x, twice.positions[i].x);
}

TEST(Orient, TurnsFlippedTrianglesBack) {
    const TriangleMesh organ = generate("organ", 16);
    const MeshReport report = inspect(orient(withFlipped(organ, 7)));
    EXPECT_EQ(report.defects.flippedEdges, 0u);
    EXPECT_NEAR(report.volume, inspect(organ).volume, 1e-12);
}

TEST(Orient, TurnsAMeshThatIsInsideOut) {
    EXPECT_NEAR(inspect(orient(withFlipped(unitBox, 1))).volume, 1, 1e-12);
}

TEST(Orient, LeavesACavityACavity) {
    const TriangleMesh hollow = joined(box({0, 0, 0}, {3, 3, 3}), withFlipped(box({1, 1, 1}, {2, 2, 2}), 1));
    EXPECT_NEAR(inspect(orient(hollow)).volume, 26, 1e-12);
}

namespace {

// Triangles at each edge, lower vertex first: number along the edge, number against it.
std::map<std::array<std::uint32_t, 2>, std::array<int, 2>> edgesOf(const TriangleMesh& mesh) {
    std::map<std::array<std::uint32_t, 2>, std::array<int, 2>> edges;
    for (const auto& triangle : mesh.triangles)
        for (std::size_t n = 0; n < 3; ++n) {
            const std::uint32_t a = triangle[n], b = triangle[(n + 1) % 3];
            ++edges[{std::min(a, b), std::max(a, b)}][a < b ? 0 : 1];
        }
    return edges;
}

// One mesh of boxes around the z axis that have an edge on the axis in common.
TriangleMesh boxesAroundAnEdge(std::initializer_list<std::array<float, 2>> corners) {
    TriangleMesh mesh;
    for (const auto& [x, y] : corners)
        mesh = joined(
            mesh, box({std::min(x, 0.0f), std::min(y, 0.0f), 0}, {std::max(x, 0.0f), std::max(y, 0.0f), 1}));
    MeshDefects defects;
    return weld(mesh, defects);
}

} // namespace

TEST(SplitCrowdedEdges, GivesEachPairOfTrianglesAMiddleOfItsOwn) {
    for (TriangleMesh mesh :
         {boxesAroundAnEdge({{1, 1}, {-1, -1}}), boxesAroundAnEdge({{1, 1}, {-1, -2}, {0.5f, -1}})}) {
        const MeshReport before = inspect(mesh);
        EXPECT_GT(before.defects.nonManifoldEdges, 0u);
        const std::size_t vertices = mesh.positions.size(), triangles = mesh.triangles.size();
        EXPECT_EQ(splitCrowdedEdges(mesh), before.defects.nonManifoldEdges);
        for (const auto& [edge, sides] : edgesOf(mesh)) EXPECT_EQ(sides, (std::array{1, 1}));
        EXPECT_NEAR(inspect(mesh).volume, before.volume, 1e-6);
        EXPECT_EQ(mesh.triangles.size(), triangles + 2 * (mesh.positions.size() - vertices));
        for (std::uint32_t middle = static_cast<std::uint32_t>(vertices); middle < mesh.positions.size();
             ++middle)
            for (const auto& triangle : mesh.triangles) { // triangles around a middle belong to one box
                if (std::ranges::find(triangle, middle) == triangle.end()) continue;
                EXPECT_EQ(mesh.positions[middle].z, 0.5f);
            }
        EXPECT_EQ(splitCrowdedEdges(mesh), 0u) << "nothing is left to do";
    }
}

// A pyramid of three corners, with others at one, two and all three edges of its base.
TEST(SplitCrowdedEdges, OfOneTriangleAreSplitOneAfterAnother) {
    for (std::uint32_t crowded = 1; crowded <= 3; ++crowded) {
        TriangleMesh mesh{.name = "",
                          .positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.3f, 0.3f, 1}},
                          .triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
        for (std::uint32_t a = 0; a < crowded; ++a) { // outside and below the pyramid
            const std::uint32_t b = (a + 1) % 3, c = 4 + 2 * a, d = c + 1;
            const Vec3 &x = mesh.positions[a], &y = mesh.positions[b];
            const Vec3 away{x.x + y.x - 0.6f, x.y + y.y - 0.6f, -0.5f};
            mesh.positions.push_back({0.5f * (x.x + y.x) + away.x, 0.5f * (x.y + y.y) + away.y, away.z});
            mesh.positions.push_back({mesh.positions[c].x, mesh.positions[c].y, -1});
            mesh.triangles.insert(mesh.triangles.end(), {{a, b, c}, {b, a, d}, {b, d, c}, {a, c, d}});
        }
        const MeshReport before = inspect(mesh);
        ASSERT_EQ(before.defects.nonManifoldEdges, crowded);
        EXPECT_EQ(splitCrowdedEdges(mesh), crowded);
        for (const auto& [edge, sides] : edgesOf(mesh)) EXPECT_EQ(sides, (std::array{1, 1}));
        EXPECT_NEAR(inspect(mesh).volume, before.volume, 1e-6);
        EXPECT_EQ(mesh.triangles.size(), 4 + 8 * crowded);
    }
}

TEST(SplitCrowdedEdges, KeepsBoxesApart) {
    TriangleMesh mesh = boxesAroundAnEdge({{1, 1}, {-1, -1}});
    const auto vertices = static_cast<std::uint32_t>(mesh.positions.size());
    splitCrowdedEdges(mesh);
    ASSERT_EQ(mesh.positions.size(), vertices + 2);
    for (std::uint32_t middle = vertices; middle < vertices + 2; ++middle) {
        float side = 0;
        for (const auto& triangle : mesh.triangles)
            if (std::ranges::find(triangle, middle) != triangle.end())
                for (const std::uint32_t corner : triangle) {
                    const float x = mesh.positions[corner].x;
                    EXPECT_GE(side * x, 0) << "a middle joins two boxes";
                    side = x == 0 ? side : x;
                }
        EXPECT_NE(side, 0);
    }
}

TEST(SplitCrowdedEdges, LeavesAloneWhatIsOpenOrClosedAlready) {
    TriangleMesh closed = box({0, 0, 0}, {1, 1, 1});
    EXPECT_EQ(splitCrowdedEdges(closed), 0u);
    EXPECT_EQ(closed.triangles.size(), 12u);
    TriangleMesh fins{.name = "", // three triangles at an edge, and one without area
                      .positions = {{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}},
                      .triangles = {{0, 1, 2}, {0, 1, 3}, {1, 0, 4}, {0, 0, 1}}};
    EXPECT_EQ(splitCrowdedEdges(fins), 0u);
    EXPECT_EQ(fins.triangles.size(), 4u);
    TriangleMesh none;
    EXPECT_EQ(splitCrowdedEdges(none), 0u);
}

// Two boxes that have the triangles of a face as duplicates, with a triangle of zero area between them.
TEST(Weld, KeepsTheObjectOfEachTriangle) {
    TriangleMesh two = joined(box({0, 0, 0}, {1, 1, 1}), box({3, 0, 0}, {4, 1, 1}));
    two.objectNames = {"left", "right"};
    two.objects.assign(24, 0);
    std::fill(two.objects.begin() + 12, two.objects.end(), 1u);
    two.objects[13] = noObject;
    two.triangles.insert(two.triangles.begin() + 3, {0, 0, 1});
    two.objects.insert(two.objects.begin() + 3, 1u);
    two.triangles.insert(two.triangles.begin() + 8, two.triangles[0]);
    two.objects.insert(two.objects.begin() + 8, 1u);
    MeshDefects defects;
    const TriangleMesh welded = orient(weld(unwelded(two), defects));
    ASSERT_EQ(welded.triangles.size(), 24u);
    ASSERT_EQ(welded.objects.size(), 24u);
    EXPECT_EQ(welded.objectNames, two.objectNames);
    for (std::size_t i = 0; i < 24; ++i) {
        const bool isRight = welded.positions[welded.triangles[i][0]].x > 2;
        EXPECT_EQ(welded.objects[i], i == 13 ? noObject : isRight ? 1u : 0u) << i;
    }
}

TEST(Keep, DropsTrianglesWithTheirObjectsAndVertices) {
    TriangleMesh two = joined(box({0, 0, 0}, {1, 1, 1}), box({3, 0, 0}, {4, 1, 1}));
    two.objectNames = {"left", "right"};
    two.objects.assign(24, 0);
    std::fill(two.objects.begin() + 12, two.objects.end(), 1u);
    std::vector<bool> isRight(24);
    std::fill(isRight.begin() + 12, isRight.end(), true);
    const TriangleMesh right = keep(two, isRight);
    EXPECT_EQ(right.positions.size(), 8u);
    EXPECT_EQ(right.objects, std::vector<std::uint32_t>(12, 1));
    EXPECT_EQ(inspect(right).low.x, 3);
    EXPECT_NEAR(inspect(right).volume, 1, 1e-6);
}
