// Tests of the skin of a sheet along a cut: no triangle is stretched over the cut or spans both sides, and
// there is no gap where nothing was cut.
#include "common/layout.h"
#include "sim/compile/compile.hpp"
#include "sim/cutting/cut_body.hpp"
#include "sim/scenes.hpp"
#include "sinew/bodies.hpp"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>
#include <numbers>
#include <random>

using namespace sinew;
using namespace sinew::sim;
using Eigen::Vector3d;
using test::CutBody;
using test::CutPlane;
using test::Sweep;
using test::sweepOf;

namespace {

constexpr float spacing = 0.05f;
const double diagonal = double{spacing} * std::numbers::sqrt2;

Scene sheet(std::array<std::uint32_t, 2> size = {13, 9}) {
    Scene scene{.name = "sheet", .gravity = {0, 0, 0}};
    addCloth(scene, {.origin = {0, 0.2f, 0},
                     .size = size,
                     .spacing = spacing,
                     .stretchCompliance = 1e-4f,
                     .shearCompliance = 1e-3f,
                     .isCuttable = true});
    return scene;
}

double areaOf(const Scene& scene) { // of one side
    const Grid& grid = scene.grids[0];
    return double{spacing} * double{spacing} * (grid.nodes[0] - 1) * (grid.nodes[2] - 1);
}

using Corners = std::array<Vector3d, 3>;

// Drawn triangles of the only skin on each side of the sheet, without degenerate ones.
struct Drawn {
    std::vector<Corners> upper, lower;
    double leastOfNormal = 1; // of a vertex normal along that of its triangle
    std::vector<std::uint32_t> indices;
    layout::DrawArguments pieces{};
};

Drawn drawn(CutBody& body) {
    const Simulation& simulation = body.runner().simulation();
    body.runner().skin();
    const auto vertices = test::queue().download<layout::SkinVertex>(simulation.skinVertices());
    Drawn result;
    result.indices = test::queue().download<std::uint32_t>(simulation.skinIndices());
    result.pieces = test::queue().download<layout::DrawArguments>(simulation.pieceDraws())[0];
    const auto at = [&](std::size_t index) {
        const layout::vec4& x = vertices[result.indices[index]].position;
        return Vector3d(x.x, x.y, x.z);
    };
    const auto add = [&](std::size_t first, std::size_t count) {
        for (std::size_t i = first; i < first + count; i += 3) {
            if (result.indices[i] == result.indices[i + 1]) continue;
            const Corners corners{at(i), at(i + 1), at(i + 2)};
            const layout::vec4& n = vertices[result.indices[i]].normal;
            const Vector3d normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalized();
            result.leastOfNormal = std::min(result.leastOfNormal, normal.dot(Vector3d(n.x, n.y, n.z)));
            (n.y > 0 ? result.upper : result.lower).push_back(corners);
        }
    };
    add(simulation.skins()[0].firstIndex, simulation.skins()[0].indexCount);
    add(result.pieces.firstIndex, result.pieces.indexCount);
    return result;
}

double areaOf(const std::vector<Corners>& triangles) {
    double area = 0;
    for (const auto& [a, b, c] : triangles) area += (b - a).cross(c - a).norm() / 2;
    return area;
}

double longestEdge(const std::vector<Corners>& triangles) {
    double longest = 0;
    for (const Corners& t : triangles)
        for (std::size_t n = 0; n < 3; ++n) longest = std::max(longest, (t[n] - t[(n + 1) % 3]).norm());
    return longest;
}

// Edges of only one triangle: their length, and the number of T-junctions, which would be visible as
// hairlines.
struct Rim {
    double length = 0;
    std::size_t tees = 0;
};

bool isWithin(const Vector3d& p, const Vector3d& a, const Vector3d& b) {
    const double part = (p - a).dot(b - a) / (b - a).squaredNorm();
    return part > 1e-3 && part < 1 - 1e-3 && (a + part * (b - a) - p).norm() < 1e-6;
}

Rim rimOf(const std::vector<Corners>& triangles) {
    using Place = std::array<double, 3>; // compared bit by bit
    std::map<std::pair<Place, Place>, int> edges;
    for (const Corners& t : triangles)
        for (std::size_t n = 0; n < 3; ++n) {
            const Vector3d &p = t[n], &q = t[(n + 1) % 3];
            const Place a{p.x(), p.y(), p.z()}, b{q.x(), q.y(), q.z()};
            ++edges[std::minmax(a, b)];
        }
    std::vector<std::array<Vector3d, 2>> open;
    Rim rim;
    for (const auto& [edge, uses] : edges) {
        EXPECT_LE(uses, 2);
        if (uses == 1) open.push_back({Vector3d(edge.first.data()), Vector3d(edge.second.data())});
    }
    for (const auto& [a, b] : open) {
        rim.length += (a - b).norm();
        for (const auto& other : open)
            for (const Vector3d& end : other) rim.tees += isWithin(end, a, b) ? 1 : 0;
    }
    return rim;
}

Vector3d middle(const CutBody& body) {
    return 0.5 * (body.at(0) + body.at(static_cast<std::uint32_t>(body.scene().particles.size() - 1)));
}

// A vertical plane through a point of the sheet [cells from its middle].
CutPlane upright(const CutBody& body, double x, double z, double angle) {
    return {middle(body) + double{spacing} * Vector3d(x, 0, z),
            Vector3d(std::cos(angle), 0, std::sin(angle))};
}

// Gives both sides of a plane opposite velocities [m/s], which open a gap once no link crosses it.
void partAlong(Scene& scene, const Vector3d& point, const Vector3d& normal, double speed) {
    for (Particle& particle : scene.particles) {
        const double side = normal.dot(test::toVector(particle.position) - point) >= 0 ? 1 : -1;
        particle.velocity = test::toFloats(side * speed * normal);
    }
}

} // namespace

TEST(SheetPieces, OfAnUncutSheetAreNone) {
    CutBody body(sheet());
    body.runner().run(2);
    const Drawn skin = drawn(body);
    EXPECT_EQ(skin.pieces.indexCount, 0u);
    EXPECT_EQ(skin.upper.size() + skin.lower.size(), body.scene().skins[0].triangles.size());
}

TEST(SheetPieces, CoverTheSheetOnBothSidesOfTheBladeAlone) {
    const std::array<double, 3> cuts[] = {{0.5, 0, 0},        {0, 0, 0},        {0, 0.3, 1.5707},
                                          {0.2, 0.1, 0.7854}, {0, 0, 0.7854},   {0, 0, -0.7854},
                                          {0.1, 0.4, 0.3},    {-2.3, 0.2, -1.1}};
    for (const auto& [x, z, angle] : cuts) {
        CutBody body(sheet());
        const CutPlane plane = upright(body, x, z, angle);
        const Status status = body.cut(sweepOf(plane, 2, 3));
        EXPECT_EQ(status.pieces, 2u) << angle;
        EXPECT_EQ(body.bridges(plane), 0u);
        EXPECT_EQ(status.cutSurfaceMissing, 0u);
        const Drawn skin = drawn(body);
        EXPECT_GT(skin.pieces.indexCount, 0u);
        EXPECT_GT(skin.leastOfNormal, 0.9999);
        for (const auto& side : {skin.upper, skin.lower}) {
            EXPECT_NEAR(areaOf(side) / areaOf(body.scene()), 1, 1e-6) << angle;
            for (const Corners& triangle : side) {
                double low = 0, high = 0; // beyond the blade [cells]
                for (const Vector3d& corner : triangle) {
                    const double off = plane.normal.dot(corner - plane.point) / double{spacing};
                    low = std::min(low, off);
                    high = std::max(high, off);
                }
                EXPECT_LT(std::min(-low, high), 0.04) << "a triangle on both sides, at angle " << angle;
            }
        }
    }
}

// The halves are pulled five cells apart.
TEST(SheetPieces, GoWithTheirHalvesUnstretched) {
    for (const double angle : {0.0, 0.4, 0.7854, 1.2, -0.5}) {
        Scene scene = sheet();
        const Vector3d point(6.2 * double{spacing}, 0.2, 4.3 * double{spacing}),
            normal(std::cos(angle), 0, std::sin(angle));
        partAlong(scene, point, normal, 0.5);
        CutBody body(scene, {.substeps = 4});
        ASSERT_EQ(body.cut(sweepOf({point, normal}, 2)).pieces, 2u);
        body.runner().run(14);
        const Drawn skin = drawn(body);
        for (const auto& side : {skin.upper, skin.lower}) {
            EXPECT_LT(longestEdge(side), 1.0001 * diagonal);
            EXPECT_NEAR(areaOf(side) / areaOf(scene), 1, 1e-4);
            for (const Corners& triangle : side) {
                int above = 0;
                for (const Vector3d& corner : triangle) above += normal.dot(corner - point) > 0 ? 1 : 0;
                EXPECT_TRUE(above == 0 || above == 3) << "a triangle over the gap, angle " << angle;
            }
        }
        const Rim rim = rimOf(skin.upper);
        EXPECT_EQ(rim.tees, 0u);
        const double around = 2 * (12 + 8) * double{spacing},
                     lip = std::min(8 / std::cos(angle), 12 / std::abs(std::sin(angle))) * double{spacing};
        EXPECT_NEAR(rim.length, around + 2 * lip, 0.1 * around) << angle;
    }
}

// A cut that ends inside the sheet: only its lips are open, although they move apart.
TEST(SheetPieces, CloseTheEndOfACut) {
    for (const double angle : {0.0, 0.3, 0.7854, -0.7854, -0.4}) {
        CutBody body(sheet());
        const Vector3d along(-std::sin(angle), 0, std::cos(angle)),
            tip = middle(body) + Vector3d(0.01, 0, 0.004);
        const Vector3d outside = tip - 0.5 * along, up(0, 0.3, 0);
        const Sweep sweep{.from = {test::toFloats(outside - up), test::toFloats(outside + up)},
                          .to = {test::toFloats(tip - up), test::toFloats(tip + up)}};
        ASSERT_EQ(body.cut(sweep).pieces, 1u);
        body.runner().writePosition(body.particleAt(6, 0, 1), 0.32f); // pulls the lips apart
        body.runner().run(2);
        const Rim rim = rimOf(drawn(body).upper);
        const double around = 2 * (12 + 8) * double{spacing}, lip = (tip.z() - 0) / std::cos(angle);
        EXPECT_EQ(rim.tees, 0u) << angle;
        EXPECT_NEAR(rim.length, around + 2 * lip, 0.15) << angle;
    }
}

TEST(SheetPieces, OfManyRandomCutsCoverTheSheetOnce) {
    std::mt19937 numbers(5);
    std::uniform_real_distribution<double> uniform(-1, 1);
    CutBody body(sheet({17, 15}));
    for (int stroke = 0; stroke < 25; ++stroke) {
        const Vector3d from = middle(body) + Vector3d(0.5 * uniform(numbers), -0.1, 0.5 * uniform(numbers)),
                       to = from + Vector3d(0.4 * uniform(numbers), 0, 0.4 * uniform(numbers)), up(0, 0.3, 0);
        const Status status = body.cut({.from = {test::toFloats(from), test::toFloats(from + up)},
                                        .to = {test::toFloats(to), test::toFloats(to + up)}});
        ASSERT_EQ(status.cutSurfaceMissing, 0u);
        ASSERT_EQ(body.pieces(), body.expectedPieces());
    }
    const Drawn skin = drawn(body);
    for (const auto& side : {skin.upper, skin.lower}) {
        EXPECT_NEAR(areaOf(side) / areaOf(body.scene()), 1, 1e-5);
        EXPECT_LT(longestEdge(side), 1.0001 * diagonal);
    }
}

TEST(SheetPieces, HaveTheSameBitsInReversedOrder) {
    std::vector<std::vector<std::uint32_t>> indices;
    std::vector<std::vector<std::uint32_t>> vertices;
    for (const bool isReversed : {false, true}) {
        CutBody body(sheet(), {.substeps = 4, .isReversed = isReversed});
        body.cut(sweepOf(upright(body, 0.3, 0.2, 0.5), 2));
        body.cut(sweepOf(upright(body, 0.1, -0.7, -0.9), 2));
        body.runner().run(3);
        indices.push_back(drawn(body).indices);
        vertices.push_back(test::queue().download<std::uint32_t>(body.runner().simulation().skinVertices()));
    }
    EXPECT_EQ(indices[0], indices[1]);
    EXPECT_EQ(vertices[0], vertices[1]);
}

TEST(SheetPieces, OfAStepThatIsUndoneAreUndoneWithItAndComeBackWithTheTopology) {
    CutBody body(sheet());
    body.cut(sweepOf(upright(body, 0.3, 0.2, 0.5), 2));
    const Drawn before = drawn(body);
    const auto saved = body.runner().save();
    const vk::Buffer topology = body.runner().saveTopology();
    const Sweep second = sweepOf(upright(body, 0.1, -0.7, -0.9), 2);
    body.runner().writePosition(3, std::numeric_limits<float>::quiet_NaN());
    EXPECT_GT(body.cut(second).nonFinite, 0u);
    EXPECT_EQ(drawn(body).indices, before.indices);
    EXPECT_EQ(body.cut(second).pieces, 4u);
    EXPECT_NE(drawn(body).indices, before.indices);
    body.runner().loadTopology(topology);
    EXPECT_EQ(drawn(body).indices, before.indices);
    EXPECT_EQ(body.cut(second).pieces, 4u);
    const Drawn after = drawn(body);
    body.runner().load(saved);
    EXPECT_EQ(drawn(body).indices, before.indices);
    EXPECT_EQ(body.cut(second).pieces, 4u);
    EXPECT_EQ(drawn(body).indices, after.indices) << "the same once more";
    body.runner().reset();
    body.runner().run(1);
    EXPECT_EQ(drawn(body).pieces.indexCount, 0u);
}

TEST(SheetPieces, ForWhichThereIsNoRoomAreSaidAndNoneIsDrawn) {
    CutBody body(sheet({40, 40}));
    const std::size_t whole = body.scene().skins[0].triangles.size();
    const RayCut everything{.from = {1, 0, 1}, .to = {1, 1, 1}, .radius = 9};
    const Status status = body.runner().cut({}, everything);
    EXPECT_EQ(status.pieces, 1600u);
    EXPECT_GT(status.cutSurfaceMissing, 6 * whole - 1);
    const Drawn skin = drawn(body);
    EXPECT_EQ(skin.pieces.indexCount, 0u);
    EXPECT_EQ(skin.upper.size() + skin.lower.size(), whole);
    const Settings enough{.substeps = 2, .cutSurfaceRoom = status.cutSurfaceMissing};
    CutBody roomy(body.scene(), enough);
    roomy.runner().takeOver(body.runner());
    EXPECT_EQ(roomy.runner().run(1).cutSurfaceMissing, 0u);
    const Drawn pieces = drawn(roomy);
    EXPECT_EQ(pieces.upper.size() + pieces.lower.size(), 6 * whole) << "each in three, of two triangles";
}

TEST(SheetPieces, HaveTheRoomThatTheirOwnSheetCanNeed) {
    Scene scene = sheet({40, 40});
    addCloth(scene, {.origin = {0, 0.4f, 0}, .size = {5, 4}, .spacing = spacing, .isCuttable = true});
    const auto roomOf = [&](std::uint32_t room) { // triangles, by sheet
        const StepProgram program = compile(scene, {.substeps = 2, .cutSurfaceRoom = room});
        std::vector<std::uint64_t> rooms;
        for (const PieceVertices& pieces : program.pieceSkins)
            rooms.push_back(program.buffers.at(pieces.vertices.index).count * 3 / 7);
        return rooms;
    };
    const std::uint64_t large = scene.skins[0].triangles.size(), small = scene.skins[1].triangles.size();
    EXPECT_LT(roomOf(0).at(0), 6 * large);
    EXPECT_EQ(roomOf(0).at(1), 6 * small) << "each in three, of two triangles";
    EXPECT_EQ(roomOf(30'000), (std::vector<std::uint64_t>{30'000, 6 * small}));
    EXPECT_EQ(roomOf(1'000'000), (std::vector<std::uint64_t>{6 * large, 6 * small}));
}

TEST(SheetPieces, AreInNoOtherScene) {
    Scene plain = sheet();
    plain.grids[0].isCuttable = false;
    const StepProgram program = compile(plain, {.substeps = 2});
    EXPECT_EQ(program.pieceDraws, BufferId{});
    EXPECT_EQ(program.pieceVertices, 0u);
    EXPECT_TRUE(std::ranges::none_of(program.buffers, [](const BufferSpec& buffer) {
        return buffer.label.find("piece") != std::string::npos;
    }));
}

namespace {

// A sheet held at its rim, with a small ball above the middle of a row of cells, within one cell.
Scene sheetUnderABall(float facesThickness, float sheetSpacing) {
    Scene scene{.name = "sheet under a ball", .damping = 2};
    ClothSheet cloth{.origin = {0, 0, 0},
                     .size = {9, 9},
                     .spacing = sheetSpacing,
                     .areaDensity = 2,
                     .thickness = facesThickness,
                     .isCuttable = true};
    for (std::uint32_t i = 0; i < 81; ++i)
        if (i % 9 == 0 || i % 9 == 8 || i < 9 || i >= 72) cloth.pinned.push_back(i);
    addCloth(scene, cloth);
    scene.particles.push_back({.position = {4.5f * sheetSpacing, 0.03f, 4.45f * sheetSpacing},
                               .inverseMass = 100,
                               .contactOffset = 0.015f,
                               .radius = 0.015f});
    return scene;
}

} // namespace

TEST(CutFaces, LetABallThrough) {
    for (const bool isReversed : {false, true}) {
        const Scene scene = sheetUnderABall(0.02f, 0.1f);
        const std::size_t ball = scene.particles.size() - 1;
        CutBody body(scene, {.substeps = 8, .isReversed = isReversed});
        // A slot from one rim to the other, along x below the ball.
        const Sweep slot{.from = {{-0.05f, -1, 0.452f}, {-0.05f, 1, 0.452f}},
                         .to = {{0.85f, -1, 0.452f}, {0.85f, 1, 0.452f}}};
        EXPECT_GT(body.cut(slot).linksCut, 20u);
        ASSERT_EQ(body.runner().run(20).contactRoom, 0u);
        const double height = body.runner().positions()[ball].y();
        std::printf("the ball is at %.3f m 20 steps after the cut\n", height);
        EXPECT_LT(height, -0.2);
    }
}

TEST(CutFaces, ComeBackWithTheTopologyAndCarryTheBall) {
    const Scene scene = sheetUnderABall(0.02f, 0.1f);
    const std::size_t ball = scene.particles.size() - 1;
    CutBody body(scene, {.substeps = 8});
    body.runner().run(15);
    const vk::Buffer topology = body.runner().saveTopology();
    const Sweep slot{.from = {{-0.05f, -1, 0.452f}, {-0.05f, 1, 0.452f}},
                     .to = {{0.85f, -1, 0.452f}, {0.85f, 1, 0.452f}}};
    body.cut(slot);
    body.runner().loadTopology(topology);
    body.runner().run(15);
    EXPECT_GT(body.runner().positions()[ball].y(), -0.06);
}
