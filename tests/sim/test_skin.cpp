// Tests of skins on the device: vertices in lattice cells, vertices on particles, smooth normals.
#include "sim/runner.hpp"
#include "sim/scenes.hpp"
#include "sinew/bodies.hpp"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

using namespace sinew;
using namespace sinew::sim;
using Eigen::Vector3d;

namespace {

// The layout documented in simulation.hpp: position and normal, stride 32.
struct Vertex {
    std::array<float, 4> position, normal;
};
static_assert(sizeof(Vertex) == 32);

Vector3d xyz(const std::array<float, 4>& v) {
    return {double{v[0]}, double{v[1]}, double{v[2]}};
}

std::vector<Vertex> skinOf(test::Runner& runner) {
    runner.skin();
    return test::queue().download<Vertex>(runner.simulation().skinVertices());
}

// A unit cube of 8^3 lattice cells without links, filled with a ball around its centre.
Scene ballOfCells() {
    Scene scene;
    Lattice lattice{.cells = {8, 8, 8}, .spacing = 0.125f, .fill = std::vector<float>(512, 0)};
    for (std::size_t c = 0; c < 512; ++c) {
        const Vector3d centre(double(c % 8) + 0.5, double(c / 8 % 8) + 0.5, double(c / 64) + 0.5);
        lattice.fill[c] = (centre / 8 - Vector3d::Constant(0.5)).norm() < 0.5 ? 1.0f : 0.0f;
    }
    const LatticeCorners corners = addLattice(scene, lattice);
    addLatticeSkin(scene, lattice, corners, {1, 1, 1});
    scene.distances.clear();
    scene.grids.clear();
    return scene;
}

// One cell with vertices in it, in the corner order of CellEmbedding.
Scene cell(const std::vector<Vec3>& weights) {
    Scene scene;
    scene.gravity = {0, 0, 0};
    Skin skin{.name = "cell"};
    for (std::uint32_t k = 0; k < 8; ++k) {
        scene.particles.push_back({.position = {float(k & 1), float(k >> 1 & 1), float(k >> 2)}});
    }
    for (const Vec3& w : weights) skin.cells.push_back({{0, 1, 2, 3, 4, 5, 6, 7}, w});
    for (std::uint32_t v = 0; v + 2 < weights.size(); ++v) skin.triangles.push_back({v, v + 1, v + 2});
    scene.skins = {skin};
    return scene;
}

} // namespace

TEST(SkinInCells, FollowsAnAffineMotionExactly) {
    const std::vector<Vec3> weights{{0, 0, 0},       {1, 1, 1},    {0.25f, 0.5f, 0.75f},
                                    {0.9f, 0.1f, 1}, {0, 1, 0.3f}, {0.5f, 0.5f, 0.5f}};
    Scene scene = cell(weights);
    Eigen::Matrix3d stretch;
    stretch << 1.3, 0.2, -0.4, 0.1, 0.7, 0.3, -0.2, 0.5, 1.1;
    const Vector3d shift(2, -1, 0.5);
    for (Particle& particle : scene.particles) {
        const Vector3d x = stretch * test::toVector(particle.position) + shift;
        particle.position = {static_cast<float>(x.x()), static_cast<float>(x.y()), static_cast<float>(x.z())};
    }
    test::Runner runner(scene);
    const std::vector<Vertex> vertices = skinOf(runner);
    ASSERT_EQ(vertices.size(), weights.size());
    for (std::size_t v = 0; v < weights.size(); ++v) {
        const Vector3d expected = stretch * test::toVector(weights[v]) + shift;
        EXPECT_LE((xyz(vertices[v].position) - expected).norm(), 1e-5) << v;
        EXPECT_EQ(vertices[v].position[3], 1);
    }
}

TEST(SkinInCells, MovesWithTheNewestRecordedState) {
    Scene scene = cell({{0.5f, 0.5f, 0.5f}, {0, 0.5f, 0.5f}, {0, 0, 0.5f}});
    for (Particle& particle : scene.particles) particle.velocity = {3, 0, 0};
    test::Runner runner(scene);
    runner.run(60);
    EXPECT_NEAR(double{skinOf(runner)[0].position[0]}, 3.5, 1e-4);
}

TEST(SkinOnParticles, SitsOnThem) {
    Scene scene = test::sheet(5);
    test::disturb(scene, 0.05f, 0);
    test::Runner runner(scene);
    runner.run(3);
    const auto x = runner.positions();
    const std::vector<Vertex> vertices = skinOf(runner);
    const Skin& skin = scene.skins[0];
    ASSERT_EQ(vertices.size(), skin.particles.size());
    for (std::size_t v = 0; v < vertices.size(); ++v)
        EXPECT_EQ(xyz(vertices[v].position), x[skin.particles[v]]);
}

// A box of cells whose particles have a radius of 0.04 m, moved by `stretch`.
Scene boxThatTouches(bool isCuttable, const Eigen::Matrix3d& stretch) {
    Lattice lattice{
        .cells = {3, 2, 4}, .spacing = 0.1f, .youngModulus = 1e5f, .density = 1000, .radius = 0.04f};
    lattice.isCuttable = isCuttable;
    Scene scene{.gravity = {}};
    addLatticeSkin(scene, lattice, addLattice(scene, lattice), {1, 1, 1});
    for (Particle& particle : scene.particles) {
        const Vector3d x = stretch * test::toVector(particle.position);
        particle.position = {static_cast<float>(x.x()), static_cast<float>(x.y()), static_cast<float>(x.z())};
    }
    return scene;
}

// Bodies that touch keep two radii between their particles: faces, edges and corners stand a radius outside.
TEST(SkinOnParticles, IsRaisedToTheSurfaceThatTouches) {
    for (const bool isCuttable : {false, true}) {
        const Scene scene = boxThatTouches(isCuttable, Eigen::Matrix3d::Identity());
        test::Runner runner(scene);
        const auto x = runner.positions();
        const std::vector<Vertex> vertices = skinOf(runner);
        const Skin& skin = scene.skins[0];
        std::map<std::uint32_t, std::vector<std::size_t>> meeting; // vertices by particle, one for each face
        for (std::size_t v = 0; v < vertices.size(); ++v) meeting[skin.particles[v]].push_back(v);
        std::map<std::size_t, int> seen;
        for (const auto& [particle, here] : meeting) {
            ++seen[here.size()];
            for (const std::size_t v : here) {
                const Vector3d way = xyz(vertices[v].position) - x[particle];
                EXPECT_NEAR(way.dot(xyz(vertices[v].normal)), isCuttable ? 0 : 0.04, 1e-6) << here.size();
                EXPECT_EQ(vertices[v].position, vertices[here.front()].position) << "edges stay closed";
            }
        }
        EXPECT_EQ(seen.at(3), 8) << "corners";
        EXPECT_GT(seen.at(2), 0) << "edges";
        EXPECT_GT(seen.at(1), 0) << "faces";
    }
}

// A needle of a corner would have its tip far away.
TEST(SkinOnParticles, IsRaisedByALittleMoreThanTheRadiusAtASharpCorner) {
    Eigen::Matrix3d shear = Eigen::Matrix3d::Identity();
    shear(0, 1) = shear(1, 2) = 8;
    const Scene scene = boxThatTouches(false, shear);
    test::Runner runner(scene);
    const auto x = runner.positions();
    const std::vector<Vertex> vertices = skinOf(runner);
    double farthest = 0;
    for (std::size_t v = 0; v < vertices.size(); ++v)
        farthest = std::max(farthest, (xyz(vertices[v].position) - x[scene.skins[0].particles[v]]).norm());
    EXPECT_NEAR(farthest, 0.04 * std::sqrt(3.0), 1e-6);
}

TEST(SkinNormals, AreOfUnitLengthAndPointOutOfABall) {
    test::Runner runner(ballOfCells());
    const std::vector<Vertex> vertices = skinOf(runner);
    ASSERT_GT(vertices.size(), 100u);
    for (const Vertex& vertex : vertices) {
        const Vector3d outward = xyz(vertex.position) - Vector3d::Constant(0.5), normal = xyz(vertex.normal);
        EXPECT_NEAR(normal.norm(), 1, 1e-6);
        EXPECT_GT(normal.dot(outward), 0) << outward.transpose();
    }
}

TEST(SkinNormals, AreThoseOfTheTrianglesByTheirAngles) {
    Scene scene = test::sheet(6);
    test::disturb(scene, 0.03f, 0);
    test::Runner runner(scene);
    const std::vector<Vertex> vertices = skinOf(runner);
    std::vector<Vector3d> sums(vertices.size(), Vector3d::Zero());
    for (const auto& triangle : scene.skins[0].triangles)
        for (std::size_t n = 0; n < 3; ++n) {
            const Vector3d here = xyz(vertices[triangle[n]].position);
            const Vector3d u = xyz(vertices[triangle[(n + 1) % 3]].position) - here,
                           v = xyz(vertices[triangle[(n + 2) % 3]].position) - here;
            const double angle = std::acos(u.normalized().dot(v.normalized()));
            sums[triangle[n]] += angle * u.cross(v).normalized();
        }
    for (std::size_t v = 0; v < vertices.size(); ++v) {
        EXPECT_LE((xyz(vertices[v].normal) - sums[v].normalized()).norm(), 1e-5) << v;
    }
}

// Rounding may invert a triangle that is nearly a point; its normal then opposes all others around a vertex.
TEST(SkinNormals, AreNotThoseOfATriangleThatRoundingTurnedOver) {
    const Vec3 corner{0.5f, 0.5f, 0.5f};
    Scene scene = cell(
        {corner, {1, 0.5f, 0.5f}, {0.5f, 1, 0.5f}, {0.5f + 3e-7f, 0.5f, 0.5f}, {0.5f, 0.5f + 3e-7f, 0.5f}});
    scene.skins[0].triangles = {{0, 1, 2}, {0, 4, 3}};
    test::Runner runner(scene);
    EXPECT_GT(skinOf(runner)[0].normal[2], 0.9999f);
    scene.skins[0].triangles = {{0, 4, 3}}; // alone, it gives its normal
    test::Runner alone(scene);
    EXPECT_LT(skinOf(alone)[0].normal[2], -0.9999f);
}

TEST(Skins, LieBehindOneAnotherInOneBuffer) {
    Scene scene = test::sheet(3);
    addCloth(scene, {.name = "second", .origin = {0, 2, 0}, .size = {4, 2}, .spacing = 0.1f});
    test::Runner runner(scene);
    const std::vector<Vertex> vertices = skinOf(runner);
    const auto indices = test::queue().download<std::uint32_t>(runner.simulation().skinIndices());
    const std::vector<SkinRange>& ranges = runner.simulation().skins();
    ASSERT_EQ(ranges.size(), 2u);
    EXPECT_EQ(ranges[1].name, "second");
    EXPECT_EQ(ranges[1].firstIndex, ranges[0].indexCount);
    ASSERT_EQ(indices.size(), ranges[0].indexCount + ranges[1].indexCount);
    for (std::size_t i = 0; i < indices.size(); ++i) {
        const double y = double{vertices.at(indices[i]).position[1]};
        EXPECT_NEAR(y, i < ranges[1].firstIndex ? 1 : 2, 1e-6);
    }
}
