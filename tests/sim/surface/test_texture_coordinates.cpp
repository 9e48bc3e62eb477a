// Texture coordinates of everything that is drawn of skins: at every place the linear interpolation on a
// triangle of the mesh as it was given, found here by looking at all of its triangles.
#include "common/layout.h"
#include "mesh/to_scene.hpp"
#include "sim/core/hash.hpp"
#include "sim/scenes.hpp"
#include "sim/surface/split_skins.hpp"
#include "sinew/bodies.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <numbers>

using namespace sinew;
using namespace sinew::sim;
using namespace sinew::test;
using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

constexpr double tolerance = 1e-5; // of texture coordinates
constexpr double onSkin = 2e-6;    // [m]; bodies are about 1 m long

Vector2d toVector(const TexturePoint& at) {
    return {double{at.u}, double{at.v}};
}

Vector3d xyz(const layout::vec4& v) {
    return {double{v.x}, double{v.y}, double{v.z}};
}

// The nearest point of a triangle: weights of its corners.
Vector3d nearestIn(const std::array<Vector3d, 3>& corners, const Vector3d& point) {
    Eigen::Matrix<double, 3, 2> edges;
    edges << corners[1] - corners[0], corners[2] - corners[0];
    const Vector2d inside =
        (edges.transpose() * edges).inverse() * (edges.transpose() * (point - corners[0]));
    Vector3d best(1 - inside.sum(), inside[0], inside[1]);
    if (best.minCoeff() >= 0) return best;
    double least = 1e30;
    for (std::size_t n = 0; n < 3; ++n) {
        const Vector3d from = corners[n], way = corners[(n + 1) % 3] - from;
        const double share = std::clamp(way.dot(point - from) / way.squaredNorm(), 0.0, 1.0);
        const double distance = (from + share * way - point).squaredNorm();
        if (distance >= least) continue;
        least = distance;
        best = Vector3d::Zero();
        best[static_cast<Eigen::Index>(n)] = 1 - share;
        best[static_cast<Eigen::Index>((n + 1) % 3)] = share;
    }
    return best;
}

// Triangles with texture coordinates.
struct Textured {
    std::vector<std::array<Vector3d, 3>> places;
    std::vector<TextureCorners> corners;

    // The least difference from the coordinates that a triangle has at its point nearest to a place, among
    // triangles that are not farther away than this; 1e30 if there are none.
    double errorAt(const Vector3d& place, const Vector2d& at, double reach) const {
        double error = 1e30;
        for (std::size_t t = 0; t < places.size(); ++t) {
            const auto& [a, b, c] = places[t];
            const Vector3d low = a.cwiseMin(b).cwiseMin(c), high = a.cwiseMax(b).cwiseMax(c);
            if ((place - low).minCoeff() < -reach || (high - place).minCoeff() < -reach) continue;
            const Vector3d weights = nearestIn(places[t], place);
            if ((weights[0] * a + weights[1] * b + weights[2] * c - place).norm() > reach) continue;
            Vector2d expected = Vector2d::Zero();
            for (std::size_t n = 0; n < 3; ++n)
                expected += weights[static_cast<Eigen::Index>(n)] * toVector(corners[t][n]);
            error = std::min(error, (expected - at).norm());
        }
        return error;
    }
};

Textured texturedOf(const mesh::TriangleMesh& mesh) {
    Textured result;
    result.corners = mesh.textureCoordinates;
    for (const auto& triangle : mesh.triangles) {
        auto& places = result.places.emplace_back();
        for (std::size_t n = 0; n < 3; ++n) {
            const Vec3& x = mesh.positions[triangle[n]];
            places[n] = Vector3d(double{x.x}, double{x.y}, double{x.z});
        }
    }
    return result;
}

enum class Parts { skin, all };

// Drawn triangles at rest: of the skin, and pieces beside cuts.
Textured drawnAtRest(Runner& runner, Parts parts = Parts::all) {
    const Simulation& simulation = runner.simulation();
    const CutSurfaceBuffers& cut = simulation.program().cutSurface;
    std::vector<Vector3d> rest(simulation.skinVertices().size / sizeof(layout::SkinVertex));
    const auto hung = queue().download<layout::HungVertex>(simulation.view(cut.hung));
    const auto moved = queue().download<layout::vec4>(simulation.view(cut.moved));
    for (std::size_t v = 0; v < hung.size(); ++v)
        rest[hung[v].vertex] = xyz(moved[v].w >= VERTEX_MOVED ? moved[v] : hung[v].rest);
    Textured drawn;
    const auto add = [&](const std::vector<Vector3d>& places, const Triangle& triangle,
                         const TextureCorners& corners) {
        drawn.places.push_back({places[triangle[0]], places[triangle[1]], places[triangle[2]]});
        drawn.corners.push_back(corners);
    };
    const Simulation::DrawnSkins skins = simulation.drawnSkins();
    const auto triangles = queue().download<Triangle>(skins.indices);
    const auto corners = queue().download<TextureCorners>(skins.textureCoordinates);
    EXPECT_EQ(corners.size(), triangles.size());
    for (std::size_t t = 0; t < triangles.size(); ++t)
        if (isThere(triangles[t])) add(rest, triangles[t], corners[t]);
    if (parts == Parts::skin) return drawn;
    const CutSurface surface = simulation.cutSurface();
    std::vector<Vector3d> places;
    for (const auto& vertex : queue().download<layout::CutVertex>(surface.rest))
        places.push_back(xyz(vertex.rest));
    const auto points = queue().download<TexturePoint>(surface.textureCoordinates);
    const auto pieces = queue().download<Triangle>(surface.indices);
    const auto draws = queue().download<layout::DrawArguments>(surface.draws);
    for (std::size_t t = draws[1].firstIndex / 3; t < (draws[1].firstIndex + draws[1].indexCount) / 3; ++t)
        add(places, pieces[t], {points[pieces[t][0]], points[pieces[t][1]], points[pieces[t][2]]});
    return drawn;
}

struct Checked {
    std::size_t corners = 0, middles = 0; // with the coordinates of a triangle of the mesh at their places
    std::size_t beside = 0;               // others
    double worst = 0;                     // of these, compared with places around them
};

enum class Middles { leaveOut, check };

// Compares all corners, and the middles of triangles whose corners are right: a triangle across a seam has
// wrong ones. Vertices that have moved may lie beside a curved skin, and beyond an edge or a seam that they
// do not cross in the texture; `reach`: how far [m].
Checked check(const Textured& original, const Textured& drawn, double reach, Middles middles) {
    Checked checked;
    const auto compare = [&](const Vector3d& place, const Vector2d& at) {
        if (original.errorAt(place, at, onSkin) < tolerance) return true;
        checked.worst = std::max(checked.worst, original.errorAt(place, at, reach));
        ++checked.beside;
        return false;
    };
    for (std::size_t t = 0; t < drawn.places.size(); ++t) {
        std::size_t right = 0;
        for (std::size_t n = 0; n < 3; ++n)
            right += compare(drawn.places[t][n], toVector(drawn.corners[t][n])) ? 1 : 0;
        checked.corners += right;
        if (right < 3 || middles == Middles::leaveOut) continue;
        const auto& [a, b, c] = drawn.places[t];
        const Vector3d middle = (a + b + c) / 3;
        const Vector2d mean =
            (toVector(drawn.corners[t][0]) + toVector(drawn.corners[t][1]) + toVector(drawn.corners[t][2])) /
            3;
        if (original.errorAt(middle, mean, onSkin) >= 1e30) continue; // around an edge of the mesh
        checked.middles += compare(middle, mean) ? 1 : 0;
    }
    std::printf("%zu corners, %zu middles, %zu beside: %.1e\n", checked.corners, checked.middles,
                checked.beside, checked.worst);
    return checked;
}

// A box whose faces have n x n squares. Each face is an island of the texture, and one has a seam in the
// middle. With `bend` the coordinates are not linear on a face.
mesh::TriangleMesh boxMesh(std::uint32_t n, double bend) {
    const Vector3d size(1, 0.6, 0.8);
    mesh::TriangleMesh mesh;
    for (std::uint32_t face = 0; face < 6; ++face) {
        const auto axis = static_cast<Eigen::Index>(face / 2), right = (axis + 1) % 3, up = (axis + 2) % 3;
        const auto add = [&](std::array<std::array<std::uint32_t, 2>, 3> corners) {
            if (face % 2 == 0) std::swap(corners[1], corners[2]);
            TextureCorners at;
            const bool isBeyond = face == 1 && corners[0][0] + corners[1][0] + corners[2][0] > 3 * n / 2;
            for (std::size_t k = 0; k < 3; ++k) {
                const double x = 1.0 * corners[k][0] / n, y = 1.0 * corners[k][1] / n;
                Vector3d place;
                place[axis] = face % 2 == 0 ? 0 : 1;
                place[right] = x;
                place[up] = y;
                place = size.cwiseProduct(place - Vector3d::Constant(0.5));
                mesh.positions.push_back(test::toFloats(place));
                at[k] = {static_cast<float>(2 * face + x + bend * x * y + (isBeyond ? 20 : 0)),
                         static_cast<float>(y + 0.5 * x + bend * x * x)};
            }
            const auto first = static_cast<std::uint32_t>(mesh.positions.size() - 3);
            mesh.triangles.push_back({first, first + 1, first + 2});
            mesh.textureCoordinates.push_back(at);
        };
        for (std::uint32_t j = 0; j < n; ++j)
            for (std::uint32_t i = 0; i < n; ++i) {
                add({{{i, j}, {i + 1, j}, {i + 1, j + 1}}});
                add({{{i, j}, {i + 1, j + 1}, {i, j + 1}}});
            }
    }
    return mesh;
}

// The organ with a texture around its longest axis, which has one seam.
mesh::TriangleMesh organMesh() {
    mesh::TriangleMesh mesh = mesh::generate("organ", 25);
    for (const auto& triangle : mesh.triangles) {
        TextureCorners& at = mesh.textureCoordinates.emplace_back();
        for (std::size_t n = 0; n < 3; ++n) {
            const Vec3& x = mesh.positions[triangle[n]];
            at[n] = {std::atan2(x.z, x.y) / (2 * std::numbers::pi_v<float>), 3 * x.x};
        }
        for (std::size_t n = 1; n < 3; ++n) // beyond the seam
            if (std::abs(at[n].u - at[0].u) > 0.5f) at[n].u += at[0].u > 0 ? 1.0f : -1.0f;
    }
    return mesh;
}

Sweep plane(const Vector3d& point, const Vector3d& normal) {
    return sweepOf({point, normal.normalized()}, reach);
}

// Uncut, split, cut and cut twice.
template <typename Look> void cutTwice(CutBody& body, const Look& look) {
    look("uncut");
    EXPECT_TRUE(body.runner().simulation().drawnSkins().areWhole);
    ASSERT_EQ(body.cut(plane({0, 5, 0}, Vector3d::UnitY())).linksCutInAll, 0u);
    EXPECT_FALSE(body.runner().simulation().drawnSkins().areWhole);
    look("split");
    ASSERT_GT(body.cut(plane({0.03, 0.02, 0}, {1, 0.3, 0.2})).linksCutInAll, 0u);
    look("cut");
    body.runner().run(3);
    body.cut(plane({0, 0.01, 0.03}, {0.2, -0.1, 1}));
    look("cut twice");
}

Scene sceneOf(const mesh::TriangleMesh& mesh) {
    Scene scene{.name = "textured", .gravity = {0, 0, 0}};
    addBody(scene, mesh);
    return scene;
}

// Gives the first skin, whose vertices are particles, coordinates by the places of its corners. Those of most
// triangles are moved, so that there are seams.
template <typename At> Textured addTexture(Scene& scene, const At& at) {
    Skin& skin = scene.skins[0];
    Textured original;
    for (std::size_t t = 0; t < skin.triangles.size(); ++t) {
        auto& places = original.places.emplace_back();
        TextureCorners& corners = skin.textureCoordinates.emplace_back();
        for (std::size_t n = 0; n < 3; ++n) {
            const Vec3& x = scene.particles[skin.particles[skin.triangles[t][n]]].position;
            places[n] = Vector3d(double{x.x}, double{x.y}, double{x.z});
            const TexturePoint point = at(x);
            corners[n] = {point.u + 0.1f * static_cast<float>(t % 7), point.v - static_cast<float>(t % 5)};
        }
    }
    original.corners = skin.textureCoordinates;
    return original;
}

} // namespace

TEST(TextureCoordinates, AreLinearOnFlatFacesAlsoBesideCutsAndSeams) {
    const mesh::TriangleMesh mesh = boxMesh(6, 0);
    const Textured original = texturedOf(mesh);
    CutBody body(sceneOf(mesh));
    ASSERT_EQ(body.scene().skins[0].wholeTriangles.size(), mesh.triangles.size());
    cutTwice(body, [&](const char* what) {
        SCOPED_TRACE(what);
        const Checked checked =
            check(original, drawnAtRest(body.runner()), 2 * body.spacing(), Middles::check);
        // The second plane lies along the seam, which holds back some ends of edges.
        const bool isAtSeam = std::string(what) == "cut twice";
        EXPECT_LT(checked.worst, isAtSeam ? 1e-3 : tolerance);
        EXPECT_LE(checked.beside, isAtSeam ? checked.corners / 500 : 0);
        EXPECT_GE(checked.corners, 3 * mesh.triangles.size());
        EXPECT_GE(checked.middles, checked.corners * 99 / 300);
    });
}

TEST(TextureCoordinates, AreThoseOfTheTriangleOfTheMeshWhereAVertexLies) {
    const mesh::TriangleMesh mesh = boxMesh(10, 0.4);
    const Textured original = texturedOf(mesh);
    CutBody body(sceneOf(mesh));
    cutTwice(body, [&](const char* what) {
        SCOPED_TRACE(
            what); // points of pieces lie on edges, which lead through several triangles if an end has moved
        const Checked checked =
            check(original, drawnAtRest(body.runner(), Parts::skin), 2 * body.spacing(), Middles::leaveOut);
        EXPECT_LT(checked.worst, tolerance);
        EXPECT_LE(500 * checked.beside, checked.corners);
        EXPECT_GE(checked.corners, 3 * mesh.triangles.size());
    });
}

TEST(TextureCoordinates, OfACurvedSkinWithASeamAreLinearInEachTriangle) {
    const mesh::TriangleMesh mesh = organMesh();
    const Textured original = texturedOf(mesh);
    CutBody body(sceneOf(mesh));
    ASSERT_FALSE(body.scene().skins[0].wholeTriangles.empty());
    cutTwice(body, [&](const char* what) {
        SCOPED_TRACE(what);
        const Checked checked = check(original, drawnAtRest(body.runner()), body.spacing(), Middles::check);
        EXPECT_LT(checked.worst, 0.02); // a vertex has moved along the tangent, the seam is 1 wide
        EXPECT_LE(5 * checked.beside, checked.corners);
        EXPECT_GE(checked.middles, mesh.triangles.size());
        if (std::string(what) == "uncut" || std::string(what) == "split") {
            EXPECT_EQ(checked.beside, 0u);
        }
    });
}

namespace {

// Hash of the coordinates that are drawn.
std::uint64_t hashOf(Runner& runner) {
    std::vector<TextureCorners> corners = drawnAtRest(runner).corners;
    return fnv1a(std::as_bytes(std::span(corners)));
}

} // namespace

TEST(TextureCoordinates, AreTheSameInAnyOrderAndAreTakenOverUndoneAndReset) {
    const Scene scene = sceneOf(organMesh());
    CutBody body(scene), reversed(scene, {.substeps = 2, .isReversed = true});
    std::vector<std::uint64_t> hashes;
    cutTwice(body, [&](const char*) { hashes.push_back(hashOf(body.runner())); });
    cutTwice(reversed, [&](const char* what) {
        SCOPED_TRACE(what);
        static std::size_t next = 0;
        EXPECT_EQ(hashOf(reversed.runner()), hashes[next++ % hashes.size()]);
    });
    const auto room = static_cast<std::uint32_t>(body.runner().simulation().cutSurface().vertices.size /
                                                 sizeof(layout::SkinVertex));
    test::Runner roomy(scene, {.substeps = 2, .cutSurfaceRoom = 2 * room});
    roomy.takeOver(body.runner());
    EXPECT_EQ(hashOf(roomy), hashes[3]);
    const vk::Buffer cut = body.runner().saveTopology();
    body.cut(plane({-0.1, 0, 0}, Vector3d::UnitX()));
    EXPECT_NE(hashOf(body.runner()), hashes[3]);
    body.runner().loadTopology(cut);
    EXPECT_EQ(hashOf(body.runner()), hashes[3]);
    body.runner().reset();
    EXPECT_EQ(hashOf(body.runner()), hashes[0]);
}

TEST(TextureCoordinates, OfFacesOfCellsAreLinearInEachTriangle) {
    Scene scene{.name = "cells", .gravity = {0, 0, 0}};
    const Lattice lattice{
        .origin = {-0.5f, -0.5f, -0.5f}, .cells = {5, 5, 5}, .spacing = 0.2f, .isCuttable = true};
    addLatticeSkin(scene, lattice, addLattice(scene, lattice), {});
    const Textured original = addTexture(scene, [](const Vec3& x) {
        return TexturePoint{x.x + x.y * x.z, x.y};
    });
    CutBody body(scene);
    ASSERT_GT(body.cut(plane({0.03, 0.02, 0}, {1, 0.3, 0.2})).linksCutInAll, 0u);
    body.cut(plane({0, 0.01, 0.03}, {0.2, -0.1, 1}));
    const Simulation& simulation = body.runner().simulation();
    const CutSurface surface = simulation.cutSurface();
    const auto rest = queue().download<layout::CutVertex>(surface.rest);
    const auto points = queue().download<TexturePoint>(surface.textureCoordinates);
    const auto draws = queue().download<layout::DrawArguments>(surface.draws);
    const auto indices = queue().download<std::uint32_t>(surface.indices);
    ASSERT_GT(draws[1].indexCount, 300u);
    for (std::uint32_t i = draws[1].firstIndex; i < draws[1].firstIndex + draws[1].indexCount; i += 3) {
        Vector3d middle = Vector3d::Zero();
        Vector2d mean = Vector2d::Zero();
        for (std::uint32_t n = 0; n < 3; ++n) {
            const std::uint32_t v = indices[i + n];
            ASSERT_LT(original.errorAt(xyz(rest[v].rest), toVector(points[v]), onSkin), tolerance) << v;
            middle += xyz(rest[v].rest) / 3;
            mean += toVector(points[v]) / 3;
        }
        ASSERT_LT(original.errorAt(middle, mean, onSkin), tolerance) << i;
    }
}

TEST(TextureCoordinates, OfCutClothAreLinearInEachTriangle) {
    Scene scene{.name = "cloth", .gravity = {0, 0, 0}};
    addCloth(scene, {.size = {9, 7}, .spacing = 0.1f, .isCuttable = true});
    ASSERT_EQ(scene.skins.size(), 1u);
    const Textured original = addTexture(scene, [](const Vec3& x) { return TexturePoint{x.x, x.z}; });
    test::Runner runner(scene, {.substeps = 2});
    const Vec3& far = scene.particles.back().position;
    const Vector3d middle(double{far.x} / 2, double{far.y} / 2, double{far.z} / 2);
    runner.cut(plane(middle, {1, 0, 0.4}).blade());
    ASSERT_GT(runner.cut(plane(middle, {0.3, 0, -1}).blade()).linksCutInAll, 0u);
    runner.skin();
    const Simulation& simulation = runner.simulation();
    const auto draws = queue().download<layout::DrawArguments>(simulation.pieceDraws());
    const auto indices = queue().download<std::uint32_t>(simulation.skinIndices());
    const auto points = queue().download<TexturePoint>(simulation.textureCoordinates());
    ASSERT_EQ(points.size(), indices.size());
    const auto vertices =
        queue().download<layout::SkinVertex>(simulation.skinVertices()); // at rest: nothing moves
    ASSERT_GT(draws[0].indexCount, 60u);
    for (std::uint32_t i = draws[0].firstIndex; i < draws[0].firstIndex + draws[0].indexCount; i += 3) {
        Vector3d place = Vector3d::Zero();
        Vector2d mean = Vector2d::Zero();
        for (std::uint32_t n = 0; n < 3; ++n) {
            const Vector3d at = xyz(vertices[indices[i + n]].position);
            ASSERT_LT(original.errorAt(at, toVector(points[i + n]), 1e-5), tolerance) << i + n;
            place += at / 3;
            mean += toVector(points[i + n]) / 3;
        }
        ASSERT_LT(original.errorAt(place, mean, 1e-5), tolerance) << i;
    }
}

TEST(TextureCoordinates, AddNothingToAScene) {
    const auto without = sceneOf(mesh::generate("organ", 25));
    CutBody body(without);
    const StepProgram& program = body.runner().simulation().program();
    for (const BufferSpec& buffer : program.buffers)
        EXPECT_EQ(buffer.label.find("texture"), std::string::npos);
    EXPECT_EQ(body.runner().simulation().textureCoordinates().size, 0u);
    EXPECT_EQ(body.runner().simulation().drawnSkins().textureCoordinates.size, 0u);
    EXPECT_EQ(body.runner().simulation().cutSurface().textureCoordinates.size, 0u);
}
