// Tests of mesh skins, which are clipped along a cut and closed with its inside.
#include "common/layout.h"
#include "mesh/generate.hpp"
#include "mesh/to_scene.hpp"
#include "mesh/voxelise.hpp"
#include "sim/scenes.hpp"
#include "sim/surface/closed_surface.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>
#include <random>

using namespace sinew;
using namespace sinew::sim;
using Eigen::Vector3d;
using test::ClosedSurface;
using test::CutBody;
using test::CutPlane;
using test::sweepOf;
using Part = test::ClosedSurface::Part;

namespace {

struct Shape {
    const char* name;
    std::uint32_t detail, resolution;
};
constexpr Shape sphere{"sphere", 24, 10}, knot{"torus_knot", 48, 18}, organ{"organ", 32, 14};

Scene sceneOf(const Shape& shape, float youngModulus = 1e5f) {
    Scene scene{.name = shape.name, .gravity = {0, 0, 0}};
    mesh::MeshBody body{.name = shape.name, .youngModulus = youngModulus, .isCuttable = true};
    body.voxels.resolution = shape.resolution;
    mesh::addMesh(scene, mesh::generate(shape.name, shape.detail), body);
    return scene;
}

double cellOf(const CutBody& body) {
    return std::pow(body.spacing(), 3);
}

// Checks the invariants of a surface; returns the number of parts with a volume.
std::size_t expectClosed(const ClosedSurface& surface, double volume, double cell, const char* what) {
    EXPECT_EQ(surface.openEdges(), 0u) << what;
    const auto volumes = surface.volumes(cell);
    EXPECT_NEAR(surface.volume() / volume, 1, 2e-3) << what; // rims move along the skin, which is curved
    EXPECT_NEAR(std::accumulate(volumes.begin(), volumes.end(), 0.0) / surface.volume(), 1, 1e-6) << what;
    return volumes.size();
}

Vector3d random(std::mt19937& numbers) {
    std::uniform_real_distribution<double> uniform(-1, 1);
    const double x = uniform(numbers), y = uniform(numbers), z = uniform(numbers);
    return {x, y, z};
}

// Number of triangles with corners on different pieces.
std::size_t stretched(const ClosedSurface& surface, double spacing) {
    std::size_t count = 0;
    for (const auto& triangle : surface.triangles())
        for (std::size_t n = 0; n < 3; ++n) {
            const std::uint32_t a = triangle.points[n], b = triangle.points[(n + 1) % 3];
            const Vector3d rest = surface.rest()[b] - surface.rest()[a],
                           drawn = surface.drawn()[b] - surface.drawn()[a];
            count += (drawn - rest).norm() > 0.1 * spacing ? 1 : 0;
        }
    return count;
}

} // namespace

namespace {

std::vector<layout::SkinVertex> drawnBy(CutBody& body, SkinDetail detail) {
    const VkCommandBuffer commands = test::queue().begin();
    body.runner().simulation().recordSkin(commands, detail);
    test::queue().wait(test::queue().submit(commands));
    return test::queue().download<layout::SkinVertex>(body.runner().simulation().skinVertices());
}

Vector3d normalOf(const layout::SkinVertex& vertex) {
    return {double{vertex.normal.x}, double{vertex.normal.y}, double{vertex.normal.z}};
}

} // namespace

// The uncut skin is drawn as the triangles of the mesh, and not as their parts, between the same vertices.
TEST(CutSkin, IsDrawnAsItsMeshUntilItIsCut) {
    constexpr Shape fine{"organ", 49, 20}; // as scenes/organ.toml
    Scene scene = sceneOf(fine);
    scene.gravity = {0, -9.81f, 0};
    scene.fixed.push_back({0});
    CutBody body(scene);
    const Simulation& simulation = body.runner().simulation();
    const Skin& skin = scene.skins[0];
    ASSERT_EQ(skin.wholeTriangles.size(), mesh::generate(fine.name, fine.detail).triangles.size());
    body.runner().run(5);
    ASSERT_TRUE(simulation.drawnSkins().areWhole);
    const auto indices =
        test::queue().download<std::array<std::uint32_t, 3>>(simulation.drawnSkins().indices);
    EXPECT_EQ(indices, skin.wholeTriangles);
    EXPECT_EQ(simulation.drawnSkins().ranges[0].indexCount, 3 * skin.wholeTriangles.size());

    const auto split = drawnBy(body, SkinDetail::all);
    body.runner().run(1);
    const auto whole = drawnBy(body, SkinDetail::drawn), after = drawnBy(body, SkinDetail::all);
    for (const auto& triangle : skin.wholeTriangles)
        for (const std::uint32_t v : triangle) {
            ASSERT_EQ(std::memcmp(&whole[v].position, &after[v].position, sizeof whole[v].position), 0) << v;
            ASSERT_NE(std::memcmp(&whole[v].position, &split[v].position, sizeof whole[v].position), 0) << v;
            ASSERT_GT(normalOf(whole[v]).dot(normalOf(after[v])), 1 - 1e-6) << v;
        }
    const std::size_t last = skin.vertexCount() - 1;
    EXPECT_EQ(std::memcmp(&whole[last], &split[last], sizeof whole[last]), 0) << "nobody asked for it";

    const vk::Buffer copy(
        test::device(),
        {.name = "state", .count = simulation.stateSize() / 4, .stride = 4, .kind = vk::MemoryKind::device});
    VkCommandBuffer commands = test::queue().begin();
    const SavedState uncut = simulation.recordSaveState(commands, copy.view());
    test::queue().wait(test::queue().submit(commands));
    body.cut(sweepOf({{0, 0, 0}, Vector3d::UnitX()}, 3));
    EXPECT_FALSE(simulation.drawnSkins().areWhole);
    EXPECT_EQ(simulation.drawnSkins().indices.buffer, simulation.skinIndices().buffer);
    EXPECT_EQ(simulation.drawnSkins().ranges[0].indexCount, 3 * skin.triangles.size());
    const auto cut = drawnBy(body, SkinDetail::drawn);
    EXPECT_NE(std::memcmp(&cut[last], &after[last], sizeof cut[last]), 0);

    commands = test::queue().begin();
    body.runner().simulation().recordLoadState(commands, copy.view(), uncut);
    test::queue().wait(test::queue().submit(commands));
    EXPECT_TRUE(simulation.drawnSkins().areWhole) << "an undo";
    body.cut(sweepOf({{0, 0, 0}, Vector3d::UnitX()}, 3));
    body.runner().reset();
    EXPECT_TRUE(simulation.drawnSkins().areWhole);
}

// After a cut all parts are drawn. The normals away from the cut must not change.
TEST(CutSkin, IsLitByItsPartsAsByWhatTheyArePartsOf) {
    Scene scene = sceneOf({"organ", 49, 20});
    scene.skins[0].wholeOf.clear();
    CutBody body(scene);
    const auto whole = drawnBy(body, SkinDetail::drawn), parts = drawnBy(body, SkinDetail::all);
    double most = 0;
    for (const auto& triangle : scene.skins[0].wholeTriangles)
        for (const std::uint32_t v : triangle)
            most = std::max(most, (normalOf(whole[v]) - normalOf(parts[v])).norm());
    std::printf("normals: %.5f degrees apart at most\n", most * 180 / std::numbers::pi);
    EXPECT_LT(most, 1e-4);
    EXPECT_GT(most, 0) << "they are not compared with themselves";
}

// Rows of vertices lie in planes between cells, up to rounding. Parts between both would be nearly points,
// which a strained body inverts.
TEST(CutSkin, HasNoPartsWithoutExtent) {
    const Scene scene = sceneOf({"tube", 72, 44});
    const Skin& skin = scene.skins[0];
    std::vector<Vector3d> rest;
    for (const CellEmbedding& cell : skin.cells) {
        Vector3d x = Vector3d::Zero();
        for (std::size_t k = 0; k < 8; ++k)
            x += double{cell.share(k)} * test::toVector(scene.particles[cell.particles[k]].position);
        rest.push_back(x);
    }
    double shortest = 1;
    for (const auto& triangle : skin.triangles)
        for (std::size_t n = 0; n < 3; ++n)
            shortest = std::min(shortest, (rest[triangle[n]] - rest[triangle[(n + 1) % 3]]).norm());
    std::printf("%zu parts, the shortest edge %.1e cells\n", skin.triangles.size(),
                shortest / double{scene.grids[0].restLength[0]});
    EXPECT_GT(shortest, 1e-4 * double{scene.grids[0].restLength[0]});
}

TEST(CutSkin, OfAnUncutBodyIsItsMesh) {
    for (const Shape& shape : {sphere, knot, organ}) {
        CutBody body(sceneOf(shape));
        ASSERT_NE(body.runner().simulation().cutSurface().vertices.size, 0u) << shape.name;
        body.runner().run(1);
        const mesh::TriangleMesh mesh = mesh::generate(shape.name, shape.detail);
        const ClosedSurface surface(body);
        const double volume = mesh::inspect(mesh).volume;
        EXPECT_EQ(expectClosed(surface, volume, cellOf(body), shape.name), 1u);
        std::printf("%-10s %zu particles, %zu triangles of the mesh, %zu of the skin (x %.2f)\n", shape.name,
                    body.scene().particles.size(), mesh.triangles.size(), surface.triangles().size(),
                    static_cast<double>(surface.triangles().size()) /
                        static_cast<double>(mesh.triangles.size()));
    }
}

// One through cut of each body, and planes through the sphere.
TEST(CutSkin, OfAPlaneIsClosedAndHasItsArea) {
    struct Case {
        Shape shape;
        const char* name;
        Vector3d at, normal; // from the origin [cells]
        double areaError;    // larger for bodies four cells thick, with much surface near the skin
    };
    const Case cases[] = {{sphere, "between layers", {0, 0, 0.5}, {0, 0, 1}, 0.001},
                          {sphere, "generic", {0.2, 0.1, 0.3}, {0.3, -0.4, 1}, 0.01},
                          {sphere, "x = y", {0, 0, 0}, {1, -1, 0}, 0.01},
                          {sphere, "x + y + z = 0", {0, 0, 0}, {1, 1, 1}, 0.01},
                          {knot, "generic", {0.2, 0.1, 0.3}, {0.3, -0.4, 1}, 0.05},
                          {knot, "along it", {0.1, 0.2, -0.4}, {1, 0.2, 0.3}, 0.05},
                          {organ, "generic", {0.2, 0.1, 0.3}, {1, 0.3, -0.4}, 0.02}};
    for (const Case& each : cases) {
        CutBody body(sceneOf(each.shape));
        const double spacing = body.spacing();
        const CutPlane plane{spacing * each.at, each.normal.normalized()};
        body.runner().run(1);
        const ClosedSurface uncut(body);
        const Status status = body.cut(sweepOf(plane, 1, 3));
        const ClosedSurface surface(body);
        expectClosed(surface, uncut.volume(), cellOf(body), each.name);
        const auto volumes = surface.volumes(cellOf(body));
        const auto parts = std::ranges::count_if(volumes, [&](double v) { return v > cellOf(body); });
        const auto pieces =
            std::ranges::count_if(body.pieceSizes(), [](std::uint32_t size) { return size > 0; });
        const bool isLinkedAcross = each.shape.resolution == knot.resolution; // strands nearer than a cell
        EXPECT_TRUE(parts == pieces || isLinkedAcross) << each.name << ": " << parts << " parts";
        std::printf("volume %+.2g; ", surface.volume() / uncut.volume() - 1);
        const double area = surface.area(Part::inside) / 2, section = uncut.section(plane).area;
        double off = 0, mean = 0; // distance from the blade
        std::vector<Vec3> inside;
        for (const auto& triangle : surface.triangles())
            for (const std::uint32_t point : triangle.points) {
                if (triangle.part != Part::inside) continue;
                inside.push_back(test::toFloats(surface.rest()[point]));
                const double away = std::abs(plane.normal.dot(surface.rest()[point] - plane.point)) / spacing;
                off = std::max(off, away);
                mean += away;
            }
        const auto depths = mesh::signedDistance(mesh::generate(each.shape.name, each.shape.detail), inside);
        const double out = double{std::ranges::max(depths)} / spacing; // beyond the skin
        std::printf("%-10s %-14s area %+.2f %%, %u pieces, %zu triangles, %zu crowded edges; off the blade "
                    "%.2f cells at most, %.3f in the mean; out of the skin %.3f\n",
                    each.shape.name, each.name, 100 * (area / section - 1), status.pieces,
                    surface.triangles().size(), surface.crowdedEdges(), off,
                    mean / static_cast<double>(inside.size()), out);
        EXPECT_NEAR(area / section, 1, each.areaError) << each.name;
        EXPECT_LT(out, 0.2) << each.name << ": no fins";
        EXPECT_LT(off, 0.1) << each.name;
    }
}

TEST(CutSkin, OfCutsThatCrossOrEndInsideIsClosed) {
    std::mt19937 numbers(7);
    for (const Shape& shape : {sphere, knot, organ}) {
        CutBody body(sceneOf(shape));
        body.runner().run(1);
        const double volume = ClosedSurface(body).volume(), spacing = body.spacing();
        for (int cut = 0; cut < 6; ++cut) {
            const CutPlane plane{3 * spacing * random(numbers), random(numbers).normalized()};
            const Status status = body.cut(sweepOf(plane, cut % 2 == 0 ? 4 * spacing : 1, 2));
            const ClosedSurface surface(body);
            const std::size_t parts = expectClosed(surface, volume, cellOf(body), shape.name);
            std::printf("%-10s after %d cuts: %zu parts, %u pieces, %zu crowded edges\n", shape.name, cut + 1,
                        parts, status.pieces, surface.crowdedEdges());
            EXPECT_EQ(body.runner().simulation().status(status.frame).cutSurfaceMissing, 0u);
        }
    }
}

TEST(CutSkin, HasTheSameBitsInReversedOrder) {
    std::vector<std::uint64_t> hashes;
    for (const bool isReversed : {false, true}) {
        CutBody body(sceneOf(sphere), {.substeps = 2, .isReversed = isReversed});
        body.cut(sweepOf({Vector3d::Zero(), Vector3d(0.2, 1, 0.1).normalized()}, 1, 2));
        body.cut(sweepOf({Vector3d::Zero(), Vector3d(1, 0.2, -0.3).normalized()}, 0.1, 2));
        body.runner().run(3);
        hashes.push_back(ClosedSurface(body).hash());
    }
    EXPECT_EQ(hashes[0], hashes[1]);
}

// Area of the skin that faces away from its normals.
double turnedArea(const ClosedSurface& surface) {
    double turned = 0;
    for (const auto& triangle : surface.triangles()) {
        const Vector3d a = surface.rest()[triangle.points[0]], b = surface.rest()[triangle.points[1]],
                       c = surface.rest()[triangle.points[2]], area = (b - a).cross(c - a) / 2;
        bool isTurned = false;
        for (const Vector3d& normal : triangle.normals) {
            EXPECT_NEAR(normal.norm(), 1, 1e-5);
            isTurned = isTurned || normal.dot(area) < 0;
        }
        if (triangle.part != Part::inside && isTurned) turned += area.norm();
    }
    return turned;
}

// At rest, a cut moves nothing drawn and only adds the cut surface.
TEST(CutSkin, IsWhereItWasAfterACut) {
    for (const Shape& shape : {sphere, organ}) {
        CutBody body(sceneOf(shape));
        body.runner().run(1);
        body.cut(sweepOf({Vector3d::Zero(), Vector3d(1, 0.3, -0.4).normalized()}, 1, 2));
        const ClosedSurface surface(body);
        double off = 0;
        for (std::size_t p = 0; p < surface.rest().size(); ++p)
            off = std::max(off, (surface.rest()[p] - surface.drawn()[p]).norm());
        const double turned = turnedArea(surface) / (surface.area(Part::skin) + surface.area(Part::outside));
        std::printf("%s: %.2g cells off at most, %.2g of the skin turned away from its normals\n", shape.name,
                    off / body.spacing(), turned);
        EXPECT_LT(off, 1e-5 * body.spacing());
        EXPECT_LT(turned, 1e-3) << "more than slivers on the blade";
    }
}

// The halves are pulled apart. No triangle is stretched between them, and the skin far from the cut moves as
// without one.
TEST(CutSkin, GoesWithItsPieces) {
    Scene scene = sceneOf(sphere);
    const double spacing = double{scene.grids[0].restLength[0]}, height = 0.3 * spacing;
    for (Particle& particle : scene.particles)
        particle.velocity = {0, 0, double{particle.position.z} < height ? -0.25f : 0.25f};
    CutBody body(scene, {.substeps = 4});
    body.cut(sweepOf({Vector3d(0, 0, height), Vector3d::UnitZ()}, 1, 2));
    body.runner().run(59);
    const ClosedSurface surface(body);
    EXPECT_EQ(surface.openEdges(), 0u);
    EXPECT_EQ(stretched(surface, spacing), 0u);
    double farthest = 0;
    for (std::size_t p = 0; p < surface.rest().size(); ++p)
        farthest = std::max(farthest, (surface.drawn()[p] - surface.rest()[p]).norm());
    EXPECT_NEAR(farthest, 0.25, 0.01);
}

TEST(CutSkin, OfAStepThatIsUndoneIsUndoneWithItAndComesBackWithTheTopology) {
    CutBody body(sceneOf(sphere));
    body.cut(sweepOf({Vector3d::Zero(), Vector3d(0.2, 1, 0.1).normalized()}, 1, 2));
    const vk::Buffer topology = body.runner().saveTopology();
    const auto second = sweepOf({Vector3d::Zero(), Vector3d(1, 0.2, -0.3).normalized()}, 1, 2);
    EXPECT_EQ(body.cut(second).pieces, 4u);
    EXPECT_EQ(ClosedSurface(body).volumes(cellOf(body)).size(), 4u);
    body.runner().loadTopology(topology);
    EXPECT_EQ(ClosedSurface(body).volumes(cellOf(body)).size(), 2u);
    const std::uint64_t hash = ClosedSurface(body).hash();
    body.runner().writePosition(3, std::numeric_limits<float>::quiet_NaN());
    EXPECT_GT(body.cut(second).nonFinite, 0u);
    EXPECT_EQ(ClosedSurface(body).hash(), hash);
    body.runner().reset();
    body.runner().run(1);
    EXPECT_EQ(ClosedSurface(body).triangles().size(), body.scene().skins[0].triangles.size());
}

// On the front of a cut its two sides share their points: the normals of both cancel out, and the vertex says
// so.
TEST(CutSkin, HasNoNormalOnItsFront) {
    for (const Shape& shape : {sphere, organ}) {
        CutBody body(sceneOf(shape));
        const Vector3d ahead = Vector3d(-0.17, 0.42, 0.89).normalized(), along(0, -0.9, 0.42);
        const auto edge = [&](double way) -> std::vector<Vec3> {
            return {test::toFloats(way * ahead - along), test::toFloats(way * ahead + along)};
        };
        ASSERT_EQ(body.cut({.from = edge(-1), .to = edge(0)}).pieces, 1u);
        body.runner().skin();
        const CutSurface cut = body.runner().simulation().cutSurface();
        const auto inside = test::queue().download<layout::DrawArguments>(cut.draws)[0];
        const auto indices = test::queue().download<std::uint32_t>(cut.indices);
        const auto vertices = test::queue().download<layout::SkinVertex>(cut.vertices);
        const auto rest = test::queue().download<layout::CutVertex>(cut.rest);
        const auto placeOf = [&](std::uint32_t v) -> Vector3d {
            return {double{rest[v].rest.x}, double{rest[v].rest.y}, double{rest[v].rest.z}};
        };
        std::map<std::uint32_t, std::pair<Vector3d, double>>
            areas; // sums by vertex: with direction, and without
        for (std::uint32_t n = inside.firstIndex; n < inside.firstIndex + inside.indexCount; n += 3) {
            const Vector3d a = placeOf(indices[n]),
                           area = (placeOf(indices[n + 1]) - a).cross(placeOf(indices[n + 2]) - a);
            for (std::uint32_t corner = 0; corner < 3; ++corner) {
                auto& [sum, size] =
                    areas.try_emplace(indices[n + corner], Vector3d::Zero(), 0.0).first->second;
                sum += area;
                size += area.norm();
            }
        }
        std::size_t front = 0;
        for (const auto& [v, area] : areas) {
            const bool isFront = area.first.norm() < 1e-3 * area.second;
            EXPECT_EQ(vertices[v].normal.w, isFront ? 1 : 0) << shape.name << ", vertex " << v;
            front += isFront ? 1 : 0;
        }
        EXPECT_GT(front, 10u);
        EXPECT_GT(areas.size(), 5 * front);
    }
}

// A skin with invalid anchors is not clipped and stretches over a cut.
TEST(CutSkin, OfWrongAnchorsIsNotClipped) {
    Scene scene = sceneOf(sphere);
    scene.skins[0].triangles.pop_back();
    scene.skins[0].wholeOf.pop_back();
    EXPECT_EQ(test::Runner(scene).simulation().cutSurface().vertices.size, 0u) << "an open skin";
    scene = sceneOf(sphere);
    std::swap(scene.skins[0].anchors.front(), scene.skins[0].anchors.back());
    EXPECT_EQ(test::Runner(scene).simulation().cutSurface().vertices.size, 0u) << "no corners of a cell";
}
