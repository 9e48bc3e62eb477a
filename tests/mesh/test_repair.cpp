// Tests of mesh repair: seams, T-junctions, remnants, holes, orientation.
#include "mesh/repair.hpp"

#include "broken_meshes.hpp"
#include "mesh/generate.hpp"
#include "mesh/import.hpp"
#include "mesh/point_tree.hpp"
#include "mesh_files.hpp"
#include "meshes.hpp"
#include "support/time_limit.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

using namespace sinew::mesh;
using namespace sinew::mesh::test;
using sinew::test::ProcessorTime;

namespace {

/// Indices of all triangles at a vertex.
std::set<std::size_t> around(const TriangleMesh& mesh, std::uint32_t vertex) {
    std::set<std::size_t> found;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
        if (std::ranges::find(mesh.triangles[i], vertex) != mesh.triangles[i].end()) found.insert(i);
    return found;
}

/// A tube with `count` sides around the y axis, with a floor at y = 0, open at the top.
TriangleMesh cup(std::uint32_t count, float radius, float height) {
    TriangleMesh mesh{.name = "cup", .positions = {{0, 0, 0}}};
    for (std::uint32_t i = 0; i < count; ++i) {
        const double angle = 2 * M_PI * i / count;
        const auto x = static_cast<float>(radius * std::cos(angle)),
                   z = static_cast<float>(radius * std::sin(angle));
        mesh.positions.insert(mesh.positions.end(), {{x, 0, z}, {x, height, z}});
    }
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint32_t a = 1 + 2 * i, b = 1 + 2 * ((i + 1) % count);
        mesh.triangles.insert(mesh.triangles.end(), {{0, a, b}, {a, a + 1, b}, {b, a + 1, b + 1}});
    }
    return mesh;
}

Result imported(const std::string& name, const std::string& text, Repair how = Repair::close) {
    const Folder folder;
    Result result;
    result.mesh = importMesh(folder.write(name, text), result.defects, {}, how, &result.report);
    return result;
}

} // namespace

TEST(PointTree, FindsWhatATestOfAllPointsFinds) {
    Random random(5);
    std::vector<Vec3> positions;
    std::vector<std::uint32_t> vertices;
    for (std::uint32_t i = 0; i < 300; ++i) { // many equal coordinates
        const auto coordinate = [&] {
            return static_cast<float>(random.next() % 4) + 1e-4f * static_cast<float>(random.next() % 3);
        };
        positions.push_back({coordinate(), coordinate(), coordinate()});
        vertices.push_back(i);
    }
    const PointTree tree(positions, vertices);
    for (std::uint32_t i = 0; i < 300; i += 7)
        for (std::uint32_t j = i; j < 300; j += 11)
            for (const double radius : {1e-3, 0.5}) {
                const Vector3 a = toVector(positions[i]), b = toVector(positions[j]);
                std::vector<std::uint32_t> found, expected;
                tree.findNear(a, b, radius, found);
                for (const std::uint32_t vertex : vertices)
                    if (nearestOnSegment(a, b, toVector(positions[vertex])).distance <= radius)
                        expected.push_back(vertex);
                std::ranges::sort(found);
                EXPECT_EQ(found, expected);
            }
}

TEST(Repair, JoinsCornersThatDifferByRounding) {
    for (const float offset : {0.0f, 100.0f, -5000.0f})
        for (const float size : {1.0f, 1000.0f, 1e-3f}) {
            const Vec3 low{offset * size, 2 * offset * size, -offset * size};
            TriangleMesh mesh = unwelded(box(low, {low.x + size, low.y + size, low.z + size}));
            const double expected = inspect(mesh).volume;
            Random random(3);
            for (Vec3& p : mesh.positions)
                for (float Vec3::*axis : {&Vec3::x, &Vec3::y, &Vec3::z})
                    if (random.next() % 2 != 0) p.*axis = std::nextafter(p.*axis, 1e9f);
            EXPECT_FALSE(repaired(mesh, Repair::none).defects.isClosed());
            for (const Repair how : {Repair::weld, Repair::close}) {
                const Result result = repaired(mesh, how);
                EXPECT_EQ(result.mesh.positions.size(), 8u) << offset << " " << size;
                expectClosed(result, expected, std::max(1e-3, 1e-6 * std::abs(double{offset})));
                EXPECT_GT(result.report.joinedVertices, 0u);
            }
        }
}

TEST(Repair, JoinsWithinAHundredThousandthOfTheSizeAndNotBeyond) {
    const TriangleMesh organ = generate("organ", 24);
    const MeshReport report = inspect(organ);
    const double size = double{report.high.x} - double{report.low.x};
    for (const double share : {1e-7, 1e-6, 2.5e-6})
        expectClosed(repaired(soup(organ, share * size), Repair::weld), report.volume, 1e-4);
    for (const double share : {4e-5, 1e-4, 1e-3})
        EXPECT_GT(repaired(soup(organ, share * size), Repair::weld).defects.boundaryEdges,
                  organ.triangles.size() / 2)
            << share;
}

TEST(Repair, LeavesAClosedMeshAsItIs) {
    for (const char* shape : {"organ", "torus_knot", "slab_with_hole", "sphere", "tube"}) {
        const TriangleMesh mesh = generate(shape, 24);
        const Result result = repaired(mesh);
        EXPECT_EQ(result.mesh.triangles, mesh.triangles) << shape;
        EXPECT_FALSE(result.report.isAny()) << shape;
    }
}

// Two closed boxes that are closer than the tolerance, and a needle much thinner than the tolerance.
TEST(Repair, NeverJoinsWhatIsClosed) {
    const TriangleMesh near = joined(unitBox, box({1.000001f, 0, 0}, {2, 1, 1}));
    EXPECT_EQ(repaired(near).mesh.triangles, near.triangles);
    const TriangleMesh thin = joined(unitBox, box({2, 0, 0}, {2.000002f, 1, 1}));
    EXPECT_EQ(repaired(thin).mesh.positions.size(), 16u);
    EXPECT_FALSE(repaired(thin).report.isAny());
}

// The small box is as large as the tolerance of the whole mesh.
TEST(Repair, KeepsATinyPartOfASoupWhole) {
    const TriangleMesh tiny = scaled(unitBox, 2e-5f);
    const TriangleMesh mesh = joined(soup(moved(box({0, 0, 0}, {1, 1, 1}), {1, 1, 1}), 1e-6), unwelded(tiny));
    const Result result = repaired(mesh);
    EXPECT_EQ(result.mesh.positions.size(), 16u);
    expectClosed(result, 1);
}

TEST(Repair, SplitsTJunctions) {
    for (const double at : {0.5, 0.25, 0.01}) {
        TriangleMesh one = unitBox;
        addJunction(one, 0, 0, at);
        const Result result = repaired(one, Repair::weld);
        EXPECT_EQ(result.report.splitEdges, 1u);
        expectClosed(result, 1, 1e-6);
        EXPECT_FALSE(repaired(one, Repair::none).defects.isClosed());
    }
}

// Triangles keep their component when they are split and holes are closed.
TEST(Repair, KeepsTheNumberOfThePart) {
    TriangleMesh mesh = unitBox;
    addJunction(mesh, 0, 0, 0.5);
    mesh.triangles.erase(mesh.triangles.begin() + 5);
    mesh.parts.assign(mesh.triangles.size(), 7);
    const Result result = repaired(mesh);
    EXPECT_EQ(result.report.splitEdges, 1u);
    EXPECT_EQ(result.report.closedHoles, 1u);
    EXPECT_EQ(result.mesh.parts, std::vector<std::uint32_t>(result.mesh.triangles.size(), 7));
}

TEST(Repair, SplitsSeveralJunctionsOnAnEdgeAndOnEachEdgeOfATriangle) {
    TriangleMesh two = unitBox; // the first triangle keeps the corner, the rest is split again
    addJunction(two, 0, 0, 0.3);
    addJunction(two, two.triangles.size() - 1, 0, 0.5);
    addJunction(two, two.triangles.size() - 1, 0, 0.5);
    expectClosed(repaired(two, Repair::weld), 1, 1e-6);
    EXPECT_EQ(repaired(two).report.splitEdges, 1u) << "one edge at three vertices";

    TriangleMesh three = unitBox; // all triangles but one are split at the edges shared with it
    const auto inner = three.triangles[3];
    for (std::size_t i = 0; i < 12; ++i)
        for (std::size_t corner = 0; corner < 3; ++corner) {
            const std::uint32_t from = three.triangles[i][corner], to = three.triangles[i][(corner + 1) % 3];
            for (std::size_t k = 0; k < 3; ++k)
                if (i != 3 && inner[k] == to && inner[(k + 1) % 3] == from) {
                    addJunction(three, i, corner, 0.4);
                    corner = 3;
                    break;
                }
        }
    expectClosed(repaired(three, Repair::weld), 1, 1e-6);
}

// Chains of T-junctions on both sides: along a line, triangles on one side end where those on the other side
// do not.
TEST(Repair, SplitsChainsOfJunctions) {
    TriangleMesh mesh = box({0, 0, 0}, {4, 1, 1});
    for (std::size_t i = 0; i < 12; ++i)
        for (std::size_t corner = 0; corner < 3; ++corner) {
            const Vec3 from = mesh.positions[mesh.triangles[i][corner]],
                       to = mesh.positions[mesh.triangles[i][(corner + 1) % 3]];
            if (from.y != 1 || to.y != 1 || from.z != to.z || from.z != 1) continue;
            const double at = from.x < to.x ? 0.3 : 0.4; // for the two triangles at that edge
            addJunction(mesh, i, corner, at);
            addJunction(mesh, mesh.triangles.size() - 1, 0, at);
            break;
        }
    EXPECT_FALSE(repaired(mesh, Repair::none).defects.isClosed());
    const Result result = repaired(mesh, Repair::weld);
    EXPECT_GE(result.report.splitEdges, 2u);
    expectClosed(result, 4, 1e-6);
}

TEST(Repair, SplitsNothingWhereAVertexOnlyTouchesAnEdge) {
    TriangleMesh sheets{.name = "",
                        .positions = {{0, 0, 0}, {2, 0, 0}, {1, 2, 0}, {1, 0, 0}, {0, -1, 1}, {2, -1, 1}},
                        .triangles = {{0, 1, 2}, {3, 4, 5}}};
    EXPECT_EQ(repaired(sheets).report.splitEdges, 0u);
}

TEST(Repair, ClosesHolesOfThreeFourAndManyEdges) {
    const TriangleMesh sphere = generate("sphere", 24);
    const double volume = inspect(sphere).volume;
    std::map<std::size_t, std::size_t> edges; // edges of the hole around a vertex
    for (std::uint32_t vertex = 0; vertex < sphere.positions.size(); vertex += 31) {
        const std::set<std::size_t> fan = around(sphere, vertex);
        const Result result = repaired(without(sphere, fan));
        EXPECT_EQ(result.report.closedHoles, 1u);
        EXPECT_EQ(result.report.holeEdges, fan.size());
        EXPECT_EQ(result.report.holeTriangles, fan.size() - 2);
        expectClosed(result, volume, 1e-2);
        ++edges[fan.size()];
    }
    EXPECT_GE(edges.size(), 2u);
    for (std::size_t triangle = 0; triangle < sphere.triangles.size(); triangle += 97) {
        const Result result = repaired(without(sphere, {triangle}));
        EXPECT_EQ(result.mesh.triangles.size(), sphere.triangles.size());
        expectClosed(result, volume, 1e-6);
    }
}

TEST(Repair, ClosesATriangleOfACubeAndHolesInItsFaces) {
    for (std::size_t triangle = 0; triangle < 12; ++triangle)
        expectClosed(repaired(without(unitBox, {triangle})), 1, 1e-6);
    const TriangleMesh mesh = generate("slab_with_hole", 48); // has a concave hole of many edges in a plane
    const double volume = inspect(mesh).volume;
    const std::set<std::size_t> fan = around(mesh, mesh.triangles[mesh.triangles.size() / 2][0]);
    std::set<std::size_t> larger = fan;
    for (const std::size_t triangle : fan) larger.merge(around(mesh, mesh.triangles[triangle][1]));
    expectClosed(repaired(without(mesh, larger)), volume, 1e-2);
}

TEST(Repair, ClosesHolesBesideEachOtherAndHolesThatTouchInAVertex) {
    const TriangleMesh sphere = generate("sphere", 24);
    const double volume = inspect(sphere).volume;
    // Removes every second triangle around a vertex, so that holes touch there.
    std::size_t touching = 0;
    for (std::uint32_t vertex = 5; vertex < sphere.positions.size(); vertex += 111) {
        const std::uint32_t first = vertex;
        const std::set<std::size_t> fan = around(sphere, first);
        std::set<std::size_t> gone;
        std::vector<std::size_t> order{*fan.begin()};
        while (order.size() < fan.size()) { // in order around the vertex
            const std::size_t last = order.back();
            for (const std::size_t next : fan) {
                std::size_t common = 0;
                for (const std::uint32_t corner : sphere.triangles[next])
                    common +=
                        std::ranges::find(sphere.triangles[last], corner) != sphere.triangles[last].end();
                if (common == 2 && std::ranges::find(order, next) == order.end()) {
                    order.push_back(next);
                    break;
                }
            }
            if (order.back() == last) break;
        }
        for (std::size_t i = 0; i + 1 < order.size(); i += 2) gone.insert(order[i]);
        const Result result = repaired(without(sphere, gone));
        expectClosed(result, volume, 1e-2);
        touching += result.report.closedHoles >= 2;
    }
    EXPECT_GT(touching, 0u);
}

TEST(Repair, LeavesCupsPlanesAndClothsOpen) {
    for (const std::uint32_t sides : {3u, 4u, 6u, 24u})
        for (const float height : {0.5f, 1.0f, 2.0f, 5.0f}) {
            const TriangleMesh mesh = cup(sides, 0.5f, height);
            const Result result = repaired(mesh);
            EXPECT_EQ(result.defects.boundaryEdges, sides) << height;
            EXPECT_EQ(result.report.openEdges, sides);
            EXPECT_EQ(result.report.openHoles, 1u);
            EXPECT_NEAR(double{result.report.largest.middle.y}, double{height}, 1e-5);
            EXPECT_EQ(result.mesh.triangles.size(), mesh.triangles.size());
        }
    for (const TriangleMesh& mesh :
         {openedAbove(generate("sphere", 24), 0.05f), without(unitBox, {0, 1}), generate("cloth", 16)}) {
        const std::size_t edges = inspect(mesh).defects.boundaryEdges;
        EXPECT_GT(edges, 0u);
        EXPECT_EQ(repaired(mesh).defects.boundaryEdges, edges);
    }
    TriangleMesh triangle{
        .name = "", .positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, .triangles = {{0, 1, 2}}};
    EXPECT_EQ(repaired(triangle).mesh.triangles.size(), 1u);
}

// Each triangle is a component of its own, which its back face would close.
TEST(Repair, NeverClosesLoneTrianglesAndQuads) {
    const TriangleMesh organ = generate("organ", 24);
    const MeshReport report = inspect(organ);
    const TriangleMesh noisy = soup(organ, 1e-2 * (double{report.high.x} - double{report.low.x}));
    for (const TriangleMesh& mesh : {noisy, joined(noisy, moved(unitBox, {9, 0, 0}))}) {
        const Result result = repaired(mesh);
        EXPECT_EQ(result.report.closedHoles, 0u);
        EXPECT_EQ(result.mesh.triangles.size(), mesh.triangles.size());
        EXPECT_EQ(result.defects.boundaryEdges, 3 * organ.triangles.size());
    }
    TriangleMesh quads; // faces of boxes, each separate and far smaller than the whole
    for (std::size_t face = 0; face < 6; ++face) {
        std::set<std::size_t> others;
        for (std::size_t i = 0; i < 12; ++i)
            if (i / 2 != face) others.insert(i);
        const TriangleMesh quad = scaled(without(unitBox, others), 0.01f);
        quads = joined(quads, moved(quad, {static_cast<float>(face), 0, 0}));
    }
    const Result result = repaired(quads);
    EXPECT_EQ(result.report.closedHoles, 0u);
    EXPECT_EQ(result.mesh.triangles.size(), 12u);
}

TEST(Repair, ClosesTheSurfaceAroundLooseTrianglesAndNotThese) {
    const TriangleMesh sphere = generate("sphere", 24);
    TriangleMesh mesh = sphere;
    std::size_t loose = 0;
    for (std::size_t i = 0; i < mesh.triangles.size(); i += 10) {
        const float factor = 1.001f + 0.0001f * static_cast<float>(++loose); // no two quads share a corner
        for (std::uint32_t& vertex : mesh.triangles[i]) {
            const Vec3 corner = mesh.positions[vertex];
            mesh.positions.push_back({corner.x * factor, corner.y * factor, corner.z * factor});
            vertex = static_cast<std::uint32_t>(mesh.positions.size() - 1);
        }
    }
    const Result result = repaired(mesh);
    EXPECT_EQ(result.report.openEdges, 3 * loose);
    EXPECT_EQ(result.mesh.triangles.size(), sphere.triangles.size() + loose);
}

TEST(Repair, OfAHoleDependsOnItsPartAndNotOnTheRestOfTheFile) {
    const TriangleMesh deep = cup(24, 0.5f, 2), large = moved(scaled(unitBox, 100), {9, 0, 0});
    const Result alone = repaired(deep), beside = repaired(joined(deep, large));
    EXPECT_EQ(alone.report.openEdges, 24u);
    EXPECT_EQ(beside.report.openEdges, 24u);
    EXPECT_EQ(beside.report.closedHoles, 0u);
    const TriangleMesh sphere = generate("sphere", 24);
    const TriangleMesh holed = without(sphere, around(sphere, 5));
    EXPECT_EQ(repaired(holed).report.closedHoles, 1u);
    EXPECT_EQ(repaired(joined(holed, large)).report.closedHoles, 1u);
}

TEST(Repair, RemovesATriangleThatSticksOutAndAWallWithin) {
    TriangleMesh fin = unitBox;
    fin.positions.push_back({0.5f, 0.5f, 3});
    fin.triangles.push_back({4, 5, 8});
    const Result withoutFin = repaired(fin);
    EXPECT_EQ(withoutFin.report.removedTriangles, 1u);
    expectClosed(withoutFin, 1, 1e-9);
    EXPECT_EQ(repaired(fin, Repair::weld).defects.nonManifoldEdges, 1u);

    MeshDefects defects; // a box of two halves with one wall between them
    const TriangleMesh walled =
        weld(joined(box({0, 0, 0}, {1, 1, 1}), without(box({1, 0, 0}, {2, 1, 1}), {8, 9})), defects);
    EXPECT_EQ(defects.nonManifoldEdges, 4u);
    const Result open = repaired(walled);
    EXPECT_EQ(open.report.removedTriangles, 2u);
    expectClosed(open, 2, 1e-9);
}

TEST(Repair, TurnsFlippedTrianglesAndCountsThem) {
    const TriangleMesh organ = generate("organ", 16);
    const double volume = inspect(organ).volume;
    const TriangleMesh flipped = withFlipped(organ, 7);
    const Result result = repaired(flipped);
    EXPECT_EQ(result.report.turnedTriangles, (organ.triangles.size() + 6) / 7);
    expectClosed(result, volume, 1e-9);
    EXPECT_GT(repaired(flipped, Repair::weld).defects.flippedEdges, 0u);
    EXPECT_EQ(repaired(flipped, Repair::none).mesh.triangles, flipped.triangles);
    TriangleMesh half = organ; // a half that is flipped and has a hole
    for (auto& triangle : half.triangles)
        if (organ.positions[triangle[0]].x > 0) std::swap(triangle[1], triangle[2]);
    expectClosed(repaired(without(half, {3, 500})), volume, 1e-6);
}

TEST(Repair, TurnsPartsThatAreInsideOutAndKeepsCavities) {
    const TriangleMesh outer = box({0, 0, 0}, {3, 3, 3}), inner = box({1, 1, 1}, {2, 2, 2}),
                       beside = box({5, 0, 0}, {6, 1, 1});
    const TriangleMesh cavity = withFlipped(inner, 1);
    const auto volumeAndTurns = [](const TriangleMesh& mesh) {
        const Result result = repaired(mesh);
        EXPECT_EQ(result.defects.boundaryEdges, 0u);
        return std::pair{std::round(1e6 * result.volume()) / 1e6, result.report.turnedParts};
    };
    EXPECT_EQ(volumeAndTurns(withFlipped(unitBox, 1)), (std::pair{1.0, std::size_t{1}}));
    EXPECT_EQ(volumeAndTurns(joined(outer, cavity)), (std::pair{26.0, std::size_t{0}}));
    EXPECT_EQ(volumeAndTurns(withFlipped(joined(outer, cavity), 1)), (std::pair{26.0, std::size_t{1}}));
    EXPECT_EQ(volumeAndTurns(joined(joined(outer, cavity), withFlipped(beside, 1))),
              (std::pair{27.0, std::size_t{1}}));
    EXPECT_EQ(volumeAndTurns(joined(outer, inner)), (std::pair{28.0, std::size_t{0}})) << "a body in a body";
    EXPECT_EQ(volumeAndTurns(joined(beside, withFlipped(moved(beside, {1, 1, 0}), 1))), // a common edge
              (std::pair{2.0, std::size_t{1}}));
}

// Relative to the middle of the mesh, the volume of a tiny box is smaller than the rounding of its terms.
TEST(Repair, TurnsNoSoundSpeckFarFromTheMiddle) {
    Random random(4);
    const auto coordinate = [&] { return static_cast<float>(900 + 100 * random.unit()); };
    TriangleMesh mesh = box({0.1234567f, 0.2345678f, 0.3456789f}, {500, 500, 500});
    for (int i = 0; i < 200; ++i) {
        const Vec3 low{coordinate(), coordinate(), coordinate()};
        mesh = joined(mesh, box(low, {low.x + 3e-4f, low.y + 3e-4f, low.z + 3e-4f}));
    }
    EXPECT_EQ(repaired(mesh).report.turnedParts, 0u);
}

TEST(Repair, TakesSecondsForManyPartsThatAreInsideOut) {
    TriangleMesh mesh;
    constexpr std::uint32_t side = 50;
    for (std::uint32_t i = 0; i < side * side * side; ++i) {
        const Vec3 p{static_cast<float>(i % side), static_cast<float>(i / side % side),
                     static_cast<float>(i / side / side)};
        mesh.positions.insert(mesh.positions.end(),
                              {p, {p.x + 0.5f, p.y, p.z}, {p.x, p.y + 0.5f, p.z}, {p.x, p.y, p.z + 0.5f}});
        const std::uint32_t a = 4 * i;
        mesh.triangles.insert(
            mesh.triangles.end(),
            {{a, a + 1, a + 2}, {a, a + 3, a + 1}, {a, a + 2, a + 3}, {a + 1, a + 3, a + 2}});
    }
    const ProcessorTime taken;
    const Result result = repaired(mesh);
    EXPECT_LT(taken.seconds(), 20);
    EXPECT_EQ(result.report.turnedParts, side * side * side);
}

TEST(Repair, TakesSecondsForManyTrianglesAtOneVertex) {
    TriangleMesh mesh;
    constexpr std::uint32_t count = 300000;
    for (std::uint32_t i = 0; i < 2 * count; ++i) {
        const double angle = M_PI * i / count;
        mesh.positions.push_back(toVec3(Vector3(std::cos(angle), std::sin(angle), 1e-3 * (i % 64))));
    }
    mesh.positions.push_back({0, 0, -1});
    for (std::uint32_t i = 0; i < count; ++i) mesh.triangles.push_back({2 * i, 2 * i + 1, 2 * count});
    const ProcessorTime taken;
    const Result result = repaired(mesh, Repair::none);
    EXPECT_LT(taken.seconds(), 20);
    EXPECT_EQ(result.report.openHoles, count);
}

TEST(Repair, SaysEachThingItDid) {
    TriangleMesh mesh = soup(generate("sphere", 24), 1e-7);
    const std::vector<std::string> joinedOnly = sentencesOf(repaired(mesh).report);
    ASSERT_EQ(joinedOnly.size(), 1u);
    EXPECT_NE(joinedOnly[0].find("vertices were joined with another one nearer than "), std::string::npos);
    EXPECT_TRUE(joinedOnly[0].ends_with(" in units of the file")) << joinedOnly[0];
    const std::vector<std::string> closed = sentencesOf(repaired(without(unitBox, {0})).report);
    ASSERT_EQ(closed.size(), 1u);
    EXPECT_EQ(closed[0], "1 hole was closed: 3 edges, 1 new triangle");
    EXPECT_EQ(sentencesOf(repaired(withFlipped(unitBox, 1)).report),
              std::vector<std::string>{"1 closed part was inside out and reversed"});
    EXPECT_TRUE(sentencesOf(repaired(unitBox).report).empty());
    EXPECT_EQ(openText(repaired(without(unitBox, {2, 3})).report),
              "4 boundary edges around 1 hole, the largest with 4 edges and a rim of 4 in units of the file "
              "around (0.5, 0.5, 1)");
}

TEST(Repair, OfAnImportIsDoneUnlessItIsSwitchedOff) {
    const std::string text = objText(without(unitBox, {4}));
    EXPECT_TRUE(imported("a.obj", text).defects.isClosed());
    EXPECT_EQ(imported("a.obj", text).report.closedHoles, 1u);
    EXPECT_EQ(imported("a.obj", text, Repair::weld).defects.boundaryEdges, 3u);
    const Result none = imported("a.stl", stlBinary(soup(unitBox, 1e-6)), Repair::none);
    EXPECT_EQ(none.mesh.positions.size(), 36u);
    EXPECT_EQ(none.report.openEdges, none.defects.boundaryEdges);
    EXPECT_TRUE(imported("a.stl", stlBinary(soup(unitBox, 1e-6)), Repair::weld).defects.isClosed());
}

TEST(Repair, KeepsTheObjectsOfTriangles) {
    TriangleMesh mesh = joined(unitBox, moved(unitBox, {3, 0, 0}));
    mesh.objectNames = {"a", "b"};
    for (std::size_t i = 0; i < 24; ++i) mesh.objects.push_back(i < 12 ? 0 : 1);
    mesh = without(mesh, {13});
    addJunction(mesh, 0, 0, 0.5);
    mesh.objects.push_back(0);
    const Result result = repaired(mesh);
    expectClosed(result, 2, 1e-6);
    ASSERT_EQ(result.mesh.objects.size(), result.mesh.triangles.size());
    for (std::size_t i = 0; i < result.mesh.triangles.size(); ++i)
        EXPECT_EQ(result.mesh.objects[i], result.mesh.positions[result.mesh.triangles[i][0]].x > 2 ? 1u : 0u);
}

TEST(Repair, ChangesNothingTheSecondTime) {
    TriangleMesh mesh = soup(generate("organ", 16), 1e-7);
    mesh = without(withFlipped(mesh, 5), {3, 77});
    const Result once = repaired(mesh), twice = repaired(once.mesh);
    EXPECT_EQ(once.mesh.triangles, twice.mesh.triangles);
    EXPECT_FALSE(twice.report.isAny());
    EXPECT_EQ(repaired(mesh).mesh.triangles, once.mesh.triangles) << "the same bytes each run";
}

// Closed shapes with four kinds of faults at once.
TEST(Repair, BringsBackTheVolumeOfBrokenMeshes) {
    for (const char* shape : {"organ", "torus_knot", "slab_with_hole", "sphere", "tube"})
        for (std::uint64_t seed = 1; seed <= 8; ++seed) {
            TriangleMesh mesh = generate(shape, 40);
            const double volume = inspect(mesh).volume;
            Random random(seed);
            for (int n = 0; n < 20; ++n) {
                const std::size_t triangle = random.next() % mesh.triangles.size();
                addJunction(mesh, triangle, random.next() % 3, 0.2 + 0.6 * random.unit());
            }
            std::set<std::size_t> gone;
            for (std::uint64_t n = 0; n < seed; ++n) gone.insert(random.next() % mesh.triangles.size());
            mesh = withFlipped(without(mesh, gone), 9 + seed);
            const Result result = repaired(soup(mesh, 2e-7, seed));
            SCOPED_TRACE(std::string(shape) + " " + std::to_string(seed));
            expectClosed(result, volume, 1e-3);
        }
}
