// A mesh as a lattice body with a skin: what the skin promises, what rests on a plane, what is weighed.
#include "mesh/to_scene.hpp"

#include "mesh/generate.hpp"
#include "meshes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

using namespace sinew;
using namespace sinew::mesh;
using namespace sinew::mesh::test;

namespace {

MeshBody body(std::uint32_t resolution) {
    return {.name = "thing", .voxels = {.resolution = resolution}};
}

/// Where the skin puts a vertex, from given particle positions.
Vector3 skinned(const sim::CellEmbedding& cell, const std::vector<Vector3>& particles) {
    Vector3 x = Vector3::Zero();
    for (unsigned corner = 0; corner < 8; ++corner) {
        const auto weight = [&](unsigned axis, float w) {
            return (corner >> axis & 1) != 0 ? double{w} : 1 - double{w};
        };
        x += weight(0, cell.weights.x) * weight(1, cell.weights.y) * weight(2, cell.weights.z) *
             particles[cell.particles[corner]];
    }
    return x;
}

std::vector<Vector3> positionsOf(const sim::Scene& scene) {
    std::vector<Vector3> positions;
    for (const sim::Particle& particle : scene.particles) positions.push_back(toVector(particle.position));
    return positions;
}

double massOf(const sim::Scene& scene) {
    double mass = 0;
    for (const sim::Particle& particle : scene.particles) mass += 1 / double{particle.inverseMass};
    return mass;
}

} // namespace

TEST(AddMesh, SkinsEveryVertexWhereItLies) {
    for (const Shape& shape : shapes()) {
        const TriangleMesh mesh = generate(shape.name, 30);
        sim::Scene scene;
        addMesh(scene, mesh, body(23));
        ASSERT_EQ(scene.skins.size(), 1u);
        const sim::Skin& skin = scene.skins[0];
        EXPECT_EQ(skin.triangles, mesh.triangles) << shape.name;
        ASSERT_EQ(skin.cells.size(), mesh.positions.size());
        EXPECT_TRUE(skin.particles.empty());
        const std::vector<Vector3> positions = positionsOf(scene);
        for (std::size_t i = 0; i < skin.cells.size(); ++i) {
            for (const std::uint32_t particle : skin.cells[i].particles)
                ASSERT_LT(particle, positions.size());
            const Vec3 w = skin.cells[i].weights;
            EXPECT_TRUE(w.x >= 0 && w.x <= 1 && w.y >= 0 && w.y <= 1 && w.z >= 0 && w.z <= 1);
            EXPECT_LT((skinned(skin.cells[i], positions) - toVector(mesh.positions[i])).norm(), 1e-6)
                << shape.name;
        }
    }
}

TEST(AddMesh, CarriesTheSkinExactlyThroughAnAffineMap) {
    const TriangleMesh mesh = generate("organ", 40);
    sim::Scene scene;
    addMesh(scene, mesh, body(17));
    Eigen::Matrix3d map;
    map << 1.3, 0.4, -0.2, 0.1, 0.7, 0.5, -0.6, 0.2, 1.1;
    const Vector3 shift(0.5, -2, 1);
    std::vector<Vector3> positions = positionsOf(scene);
    for (Vector3& position : positions) position = map * position + shift;
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const Vector3 exact = map * toVector(mesh.positions[i]) + shift;
        EXPECT_LT((skinned(scene.skins[0].cells[i], positions) - exact).norm(), 1e-5 * 0.3);
    }
}

TEST(AddMesh, FindsCellsForVerticesOnTheirBorders) {
    // Vertices on cell faces, edges and corners, all over the box.
    TriangleMesh mesh;
    for (int corner = 0; corner < 3; ++corner)
        for (int i = 0; i <= 8; ++i)
            for (int j = 0; j <= 8; ++j) {
                const float u = static_cast<float>(i) / 8, v = static_cast<float>(j) / 8;
                const auto at = [&](float x, float y) {
                    return corner == 0 ? Vec3{0.5f, x, y} : corner == 1 ? Vec3{x, 0.5f, y} : Vec3{x, y, 0.5f};
                };
                const auto first = static_cast<std::uint32_t>(mesh.positions.size());
                mesh.positions.insert(mesh.positions.end(), {at(u, v), at(u + 0.125f, v), at(u, v + 0.125f)});
                mesh.triangles.push_back({first, first + 1, first + 2});
            }
    sim::Scene scene;
    MeshBody wanted = body(0);
    wanted.voxels.spacing = 0.125f;
    addMesh(scene, mesh, wanted);
    MeshDefects defects;
    const TriangleMesh welded = weld(mesh, defects);
    for (std::size_t i = 0; i < welded.positions.size(); ++i)
        EXPECT_LT(
            (skinned(scene.skins[0].cells[i], positionsOf(scene)) - toVector(welded.positions[i])).norm(),
            1e-6);
}

TEST(AddMesh, WeighsTheVolumeTimesTheDensity) {
    sim::Scene scene;
    MeshBody wanted = body(24);
    wanted.density = 500;
    const VoxelGrid grid = addMesh(scene, generate("sphere", 64), wanted);
    double cells = 0; // slivers count as an eighth of a cell
    for (std::size_t i = 0; i < grid.voxels.size(); ++i)
        cells += grid.voxels[i] == Voxel::empty ? 0 : std::max(0.125, double{grid.fill[i]});
    EXPECT_NEAR(massOf(scene) / (500 * cells * std::pow(double{grid.spacing}, 3)), 1, 1e-5);
    EXPECT_NEAR(massOf(scene) / (500 * 4 * std::numbers::pi / 3 * std::pow(0.15, 3)), 1, 0.03);
}

TEST(AddMesh, KnowsItsRestVolume) {
    const TriangleMesh organ = generate("organ", 40);
    sim::Scene scene;
    addMesh(scene, organ, body(20));
    EXPECT_NEAR(double{scene.bodies[0].restVolume} / inspect(organ).volume, 1, 1e-6);
    EXPECT_EQ(scene.bodies[0].name, "thing");
    const VoxelGrid grid = addMesh(scene, openedAbove(organ, 0.05f), body(20));
    EXPECT_NEAR(double{scene.bodies[1].restVolume} / grid.filledVolume, 1, 1e-6);
}

TEST(AddMesh, LetsTheSkinRestOnAPlaneNotTheHull) {
    sim::Scene scene;
    const VoxelGrid grid = addMesh(scene, generate("sphere", 64), body(12));
    double farthest = 0, highest = -1;
    for (const sim::Particle& particle : scene.particles) {
        const double outside = toVector(particle.position).norm() - 0.15;
        EXPECT_NEAR(double{particle.contactOffset}, std::min(double{grid.spacing}, -outside), 2e-4);
        farthest = std::max(farthest, outside);
        // A plane stops the body where the first particle is contactOffset away from it.
        highest = std::max(highest, double{particle.contactOffset} - double{particle.position.y});
    }
    EXPECT_GT(farthest, 0.01) << "no particle lies outside: the test tests nothing";
    EXPECT_NEAR(highest, 0.15, 0.004);
}

TEST(AddMesh, TurnsTheSkinOfAnInsideOutMesh) {
    sim::Scene scene;
    addMesh(scene, withFlipped(box({0, 0, 0}, {1, 1, 1}), 1), body(4));
    const std::vector<Vector3> positions = positionsOf(scene);
    double volume = 0;
    for (const auto& [a, b, c] : scene.skins[0].triangles) {
        const auto x = [&](std::uint32_t vertex) { return skinned(scene.skins[0].cells[vertex], positions); };
        volume += x(a).dot(x(b).cross(x(c))) / 6;
    }
    EXPECT_NEAR(volume, 1, 1e-5);
}

TEST(AddMesh, AppendsToWhatIsThere) {
    sim::Scene twice, once;
    addMesh(once, generate("sphere", 24), body(9));
    addMesh(twice, generate("torus_knot", 24), body(20));
    const auto first = static_cast<std::uint32_t>(twice.particles.size());
    addMesh(twice, generate("sphere", 24), body(9));
    EXPECT_EQ(twice.bodies[1].firstParticle, first);
    EXPECT_EQ(twice.bodies[1].particleCount, once.particles.size());
    EXPECT_EQ(twice.skins[1].cells[5].particles[3], once.skins[0].cells[5].particles[3] + first);
    EXPECT_EQ(twice.distances.back().a, once.distances.back().a + first);
    EXPECT_EQ(twice.distances.back().compliance, once.distances.back().compliance);
}

TEST(AddMesh, HasAsGoodAsNoStressAtRest) {
    sim::Scene scene;
    addMesh(scene, moved(generate("organ", 32), {3, 20, -7}), body(24));
    for (const sim::DistanceConstraint& link : scene.distances) {
        const double length =
            (toVector(scene.particles[link.a].position) - toVector(scene.particles[link.b].position)).norm();
        ASSERT_NEAR(length / double{link.restLength}, 1, 1e-4); // positions are rounded to float32
    }
}

TEST(AddMesh, RefusesAnEmptyMesh) {
    sim::Scene scene;
    EXPECT_THROW(addMesh(scene, {}, body(8)), std::invalid_argument);
    EXPECT_TRUE(scene.particles.empty());
}
