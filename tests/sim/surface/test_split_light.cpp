// How split skins are lit once they are cut: as before the cut.
#include "sim/surface/rest_normals.hpp"
#include "sim/surface/split_skins.hpp"
#include "sinew/bodies.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <set>

using namespace sinew;
using namespace sinew::sim;
using namespace sinew::test;
using Eigen::Vector3d;

// Away from a cut, the normals must not become those of the more numerous parts.
TEST(SplitSkin, IsLitAwayFromACutAsBefore) {
    const Scene scene = organScene();
    const Skin& skin = scene.skins[0];
    CutBody body(scene);
    body.runner().run(1);
    const auto before = drawnBy(body.runner(), SkinDetail::drawn);
    const CutPlane plane{{0, 0, 0}, Vector3d::UnitX()};
    body.cut(sweepOf(plane, reach));
    const auto after = drawnBy(body.runner(), SkinDetail::drawn);
    std::set<std::uint32_t> beside;
    for (const Triangle& whole : skin.wholeTriangles)
        for (const std::uint32_t v : whole)
            if (std::abs(plane.normal.dot(placeOf(before[v]) - plane.point)) < 4 * body.spacing())
                beside.insert(whole.begin(), whole.end());
    std::size_t same = 0;
    for (const Triangle& triangle : skin.wholeTriangles)
        for (const std::uint32_t v : triangle) {
            const double alike = normalOf(before[v]).dot(normalOf(after[v]));
            ASSERT_GT(alike, beside.contains(v) ? 0.7 : 1 - 1e-6) << v;
            same += beside.contains(v) ? 0 : 1;
        }
    EXPECT_GT(same, skin.wholeTriangles.size());
    EXPECT_GT(beside.size(), 50u);
}

namespace {

std::vector<surface::Point> pointsOf(const std::vector<layout::SkinVertex>& vertices) {
    std::vector<surface::Point> points;
    for (const auto& vertex : vertices) points.push_back(surface::pointOf(vertex.position));
    return points;
}

Vector3d vectorOf(const surface::Point& point) {
    return {point.x, point.y, point.z};
}

// Normals at rest, by vertex.
std::vector<Vector3d> litNormals(const Skin& skin, const std::vector<surface::Point>& rest) {
    std::vector<Vector3d> normals;
    for (const auto& normal : surface::litNormals(skin, surface::partVertices(skin, rest), rest))
        normals.push_back(vectorOf(normal));
    return normals;
}

} // namespace

// Compares the host's normals at rest with the device's; a difference would make rims visible.
TEST(SplitSkin, HasTheNormalsAtRestThatTheDeviceMakes) {
    const Scene scene = organScene();
    test::Runner runner(scene, {.substeps = 2});
    const auto vertices = drawnBy(runner, SkinDetail::all);
    const std::vector<Vector3d> normals = litNormals(scene.skins[0], pointsOf(vertices));
    for (std::size_t v = 0; v < vertices.size(); ++v)
        ASSERT_GT(normalOf(vertices[v]).dot(normals[v]), 1 - 1e-5) << v;
}

// Vertices of parts must have the normal interpolated over their whole triangle, and not a flat one.
TEST(SplitSkin, IsLitByItsPartsAsByWhatTheyArePartsOf) {
    const Scene scene = organScene();
    const Skin& skin = scene.skins[0];
    test::Runner runner(scene, {.substeps = 2});
    runner.run(3);
    const auto vertices = drawnBy(runner, SkinDetail::all);
    const std::vector<layout::PartVertex> parts = surface::partVertices(skin, pointsOf(vertices));
    ASSERT_GT(parts.size(), skin.wholeTriangles.size() / 2);
    std::size_t flat = 0;
    for (const layout::PartVertex& part : parts) {
        const Triangle& whole = skin.wholeTriangles[part.whole];
        Vector3d place = Vector3d::Zero(), normal = Vector3d::Zero(), corners[3];
        const double ofB = double{part.shares[0]}, ofC = double{part.shares[1]};
        for (std::size_t n = 0; n < 3; ++n) {
            const double share = n == 0 ? 1 - ofB - ofC : n == 1 ? ofB : ofC;
            corners[n] = placeOf(vertices[whole[n]]);
            place += share * corners[n];
            normal += share * normalOf(vertices[whole[n]]);
        }
        const Vector3d lit = normalOf(vertices[part.vertex]);
        ASSERT_LT((place - placeOf(vertices[part.vertex])).norm(), 1e-5) << "it lies elsewhere in it";
        ASSERT_LT(normal.normalized().cross(lit).norm(), 1e-5);
        const Vector3d across = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalized();
        flat += across.dot(lit) > 1 - 1e-7 ? 1 : 0;
    }
    EXPECT_LT(flat, parts.size() / 4) << "of " << parts.size();
}

// A skin that does not say what its triangles are parts of is lit by them alone, which divide its angles.
TEST(SplitSkin, WouldBeLitAlikeByItsParts) {
    Scene scene = organScene();
    scene.skins[0].wholeOf.clear();
    test::Runner runner(scene, {.substeps = 2});
    const auto vertices = drawnBy(runner, SkinDetail::all);
    const std::vector<surface::Point> rest = pointsOf(vertices);
    const auto ofParts = surface::restNormals(scene.skins[0].triangles, rest),
               ofWholes = surface::restNormals(scene.skins[0].wholeTriangles, rest);
    for (std::size_t v = 0; v < vertices.size(); ++v)
        ASSERT_LT(normalOf(vertices[v]).cross(vectorOf(ofParts[v])).norm(), 5e-3) << v;
    for (const Triangle& whole : scene.skins[0].wholeTriangles)
        for (const std::uint32_t v : whole)
            ASSERT_LT(vectorOf(ofWholes[v]).cross(vectorOf(ofParts[v])).norm(), 1e-4) << v;
}

namespace {

// Corners of the skin's pieces, from the cut surface.
std::vector<layout::SkinVertex> piecesOf(const Simulation& simulation) {
    const CutSurface cut = simulation.cutSurface();
    const auto draws = test::queue().download<layout::DrawArguments>(cut.draws);
    const auto indices = test::queue().download<std::uint32_t>(cut.indices);
    const auto vertices = test::queue().download<layout::SkinVertex>(cut.vertices);
    std::vector<layout::SkinVertex> corners;
    for (std::uint32_t n = 0; n < draws[1].indexCount; ++n)
        corners.push_back(vertices[indices[draws[1].firstIndex + n]]);
    return corners;
}

// Interpolated normal in the nearest triangle of the mesh at rest.
Vector3d litAt(const Vector3d& x, const Skin& skin, const std::vector<surface::Point>& rest,
               const std::vector<Vector3d>& lit) {
    double nearest = 1e9;
    Vector3d normal = Vector3d::Zero();
    for (const Triangle& whole : skin.wholeTriangles) {
        const Vector3d a = vectorOf(rest[whole[0]]), ab = vectorOf(rest[whole[1]]) - a,
                       ac = vectorOf(rest[whole[2]]) - a, across = ab.cross(ac), ax = x - a;
        const double area = across.squaredNorm(), b = ax.cross(ac).dot(across) / area,
                     c = ab.cross(ax).dot(across) / area;
        const double outside = std::max({0.0, -b, -c, b + c - 1});
        const double away = std::abs(across.normalized().dot(ax)) + outside * std::sqrt(area);
        if (away >= nearest) continue;
        nearest = away;
        normal = (1 - b - c) * lit[whole[0]] + b * lit[whole[1]] + c * lit[whole[2]];
    }
    return normal.normalized();
}

} // namespace

// A cut of a body at rest moves nothing. All drawn vertices must keep their normals, beside the cut and away
// from it, on rims and in pieces, also where the skin folds onto itself.
TEST(SplitSkin, IsLitBesideACutAsBefore) {
    const Scene scene = organScene();
    const Skin& skin = scene.skins[0];
    CutBody body(scene);
    const std::vector<surface::Point> rest = pointsOf(drawnBy(body.runner(), SkinDetail::all));
    const std::vector<Vector3d> lit = litNormals(skin, rest);
    for (const double x : {0.031, -0.06}) {
        const CutPlane plane{{x, 0, 0}, Vector3d(1, 0.3, 0.2).normalized()};
        ASSERT_GT(body.cut(sweepOf(plane, reach)).linksCutInAll, 0u);
        const auto vertices = drawnBy(body.runner(), SkinDetail::drawn);
        std::set<std::uint32_t> seen;
        const std::vector<Triangle> drawn = drawnOf(body.runner().simulation());
        for (const Triangle& triangle : drawn) seen.insert(triangle.begin(), triangle.end());
        double most = 0, ofPieces = 0;
        std::vector<double> off;
        for (const std::uint32_t v : seen) most = std::max(most, (normalOf(vertices[v]) - lit[v]).norm());
        const std::vector<layout::SkinVertex> pieces = piecesOf(body.runner().simulation());
        for (const layout::SkinVertex& corner : pieces) {
            const Vector3d before = litAt(placeOf(corner), skin, rest, lit);
            off.push_back((normalOf(corner) - before).norm());
            ofPieces += off.back() * off.back() / static_cast<double>(pieces.size());
        }
        std::printf("normals of %zu vertices: %.4f degrees off at most, of %zu corners of pieces %.2f rms\n",
                    seen.size(), most * 180 / std::numbers::pi, pieces.size(),
                    std::sqrt(ofPieces) * 180 / std::numbers::pi);
        EXPECT_LT(most, 1e-4);
        // Vertices that moved onto the rim, by up to 1.5 cells, have the normals of their old positions.
        EXPECT_LT(std::sqrt(ofPieces), 0.25);
        const auto third = off.begin() + static_cast<std::ptrdiff_t>(off.size() / 3);
        std::ranges::nth_element(off, third);
        std::printf("a third of them less than %.4f\n", *third * 180 / std::numbers::pi);
        EXPECT_LT(*third, 0.02) << "those that have not moved";
        EXPECT_GT(seen.size(), 1000u);
        EXPECT_GT(pieces.size(), 300u);
    }
}

// Normals are also kept if the cut surface exceeds its capacity and is not drawn.
TEST(SplitSkin, IsLitBesideACutThatHasNoRoom) {
    const Scene scene = organScene();
    CutBody body(scene);
    const std::vector<Vector3d> lit =
        litNormals(scene.skins[0], pointsOf(drawnBy(body.runner(), SkinDetail::all)));
    const Status status = body.runner().cut({}, {.from = {0, -1, 0}, .to = {0, 1, 0}, .radius = 0.4f});
    ASSERT_GT(status.cutSurfaceMissing, 0u);
    const auto vertices = drawnBy(body.runner(), SkinDetail::drawn);
    const std::vector<Triangle> drawn = drawnOf(body.runner().simulation());
    for (const Triangle& triangle : drawn)
        for (const std::uint32_t v : triangle) ASSERT_LT((normalOf(vertices[v]) - lit[v]).norm(), 1e-4) << v;
}

// Normals depend on the current topology: after an older one is loaded, none of a later cut may remain.
TEST(SplitSkin, IsLitAsItWasWhereACutIsGoneBackTo) {
    const Scene scene = organScene();
    CutBody body(scene);
    body.cut(sweepOf({{0.031, 0, 0}, Vector3d(1, 0.3, 0.2).normalized()}, reach));
    test::Runner& runner = body.runner();
    const vk::Buffer topology = runner.saveTopology();
    runner.run(10);
    const test::Runner::Saved state = runner.save();
    const auto first = drawnBy(runner, SkinDetail::drawn);
    const std::vector<Triangle> drawn = drawnOf(runner.simulation());
    body.cut(sweepOf({{-0.06, 0, 0}, Vector3d::UnitX()}, reach));
    runner.load(state);
    runner.loadTopology(topology);
    const auto again = drawnBy(runner, SkinDetail::drawn);
    test::Runner other(scene, {.substeps = 2});
    other.takeOver(runner);
    const auto taken = drawnBy(other, SkinDetail::drawn);
    for (const Triangle& triangle : drawn)
        for (const std::uint32_t v : triangle) {
            ASSERT_EQ(normalOf(again[v]), normalOf(first[v])) << v;
            ASSERT_EQ(normalOf(taken[v]), normalOf(first[v])) << v;
        }
}

// Pieces of the sheet lie behind the vertices of the skins.
TEST(SplitSkin, IsLitAsBeforeWhereSheetsAreCutAsWell) {
    Scene scene = organScene();
    addCloth(scene, {.origin = {0, 5, 0},
                     .size = {5, 5},
                     .spacing = 0.1f,
                     .stretchCompliance = 1e-4f,
                     .shearCompliance = 1e-4f,
                     .isCuttable = true});
    test::Runner runner(scene, {.substeps = 2});
    const auto before = drawnBy(runner, SkinDetail::all);
    ASSERT_GT(
        runner.cut(sweepOf({{0.031, 0, 0}, Vector3d(1, 0.3, 0.2).normalized()}, reach).blade()).linksCut, 0u);
    const auto after = drawnBy(runner, SkinDetail::all);
    const auto left = test::queue().download<Triangle>(runner.simulation().skinIndices());
    double most = 0;
    for (std::size_t t = 0; t < scene.skins[0].triangles.size(); ++t)
        for (const std::uint32_t v : left[t])
            if (isThere(left[t])) most = std::max(most, (normalOf(after[v]) - normalOf(before[v])).norm());
    std::printf("beside a sheet: %.3f degrees off at most\n", most * 180 / std::numbers::pi);
    EXPECT_LT(most, 1e-4);
}
