// Tests of a mesh as a lattice body with a skin: positions of the skin, rest on a plane, masses.
#include "mesh/to_scene.hpp"

#include "broken_meshes.hpp"
#include "mesh/generate.hpp"
#include "mesh/triangle_tree.hpp"
#include "meshes.hpp"
#include "sinew/bodies.hpp"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

using namespace sinew;
using namespace sinew::mesh;
using namespace sinew::mesh::test;

namespace {

MeshBody body(std::uint32_t resolution) {
    return {.name = "thing", .voxels = {.resolution = resolution}};
}

/// Position of a skin vertex for given particle positions.
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

/// Rotates the mesh about the axes x and z.
TriangleMesh turned(TriangleMesh mesh, double degrees) {
    const double angle = degrees * std::numbers::pi / 180;
    const Eigen::Matrix3d turn =
        (Eigen::AngleAxisd(angle, Vector3::UnitZ()) * Eigen::AngleAxisd(0.7 * angle, Vector3::UnitX()))
            .toRotationMatrix();
    for (sim::Vec3& p : mesh.positions) p = toVec3(turn * toVector(p));
    return mesh;
}

/// A torus around the y axis.
TriangleMesh ring(double radius, double tube) {
    constexpr std::uint32_t around = 48, across = 12;
    TriangleMesh mesh{.name = "ring"};
    const auto vertex = [](std::uint32_t i, std::uint32_t j) { return i % around * across + j % across; };
    for (std::uint32_t i = 0; i < around; ++i)
        for (std::uint32_t j = 0; j < across; ++j) {
            const double u = 2 * std::numbers::pi * i / around, v = 2 * std::numbers::pi * j / across;
            const double r = radius + tube * std::cos(v);
            mesh.positions.push_back(toVec3({r * std::cos(u), tube * std::sin(v), r * std::sin(u)}));
            mesh.triangles.push_back({vertex(i, j), vertex(i, j + 1), vertex(i + 1, j)});
            mesh.triangles.push_back({vertex(i + 1, j), vertex(i, j + 1), vertex(i + 1, j + 1)});
        }
    return mesh;
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
    // Places vertices on cell faces, edges and corners all over the box.
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
    const TriangleMesh ball = generate("sphere", 32);
    TriangleMesh hollow = joined(ball, inverted(scaled(ball, 0.95f)));
    const std::pair<const char*, TriangleMesh> meshes[]{
        {"ball", ball},
        {"hollow ball", std::move(hollow)},
        {"tube", generate("tube", 40)},
        {"slab with a hole", generate("slab_with_hole", 40)},
        {"thin ring", ring(0.15, 0.004)},
        {"plate of 6 mm", box({-0.2f, -0.003f, -0.2f}, {0.2f, 0.003f, 0.2f})},
        {"sheet of 0.2 mm", box({-0.2f, -0.0001f, -0.2f}, {0.2f, 0.0001f, 0.2f})}};
    for (const auto& [name, mesh] : meshes)
        for (const std::uint32_t resolution : {1u, 6u, 13u, 24u, 40u})
            for (const double degrees : {0.0, 17.0, 45.0}) {
                MeshBody wanted = body(resolution);
                wanted.density = 500;
                sim::Scene scene;
                const TriangleMesh placed = turned(mesh, degrees);
                addMesh(scene, placed, wanted);
                EXPECT_NEAR(massOf(scene) / (500 * inspect(placed).volume), 1, 1e-4)
                    << name << " of " << resolution << " voxels, turned by " << degrees;
            }
}

TEST(AddMesh, WeighsWhatPartsShareOnce) {
    const TriangleMesh ball = generate("sphere", 32);
    sim::Scene scene;
    addMesh(scene, joined(ball, moved(ball, {0.15f, 0, 0})), body(40));
    const double r = 0.15, lens = 5 * std::numbers::pi * std::pow(r, 3) / 12; // two balls, centres r apart
    EXPECT_NEAR(massOf(scene) / (1000 * (8 * std::numbers::pi * std::pow(r, 3) / 3 - lens)), 1, 0.01);
}

// Stability test: a node with too little mass for the stiffness of its cells would need shorter substeps.
TEST(AddMesh, WeighsAPartWithinAnotherOnce) {
    const TriangleMesh sphere = generate("sphere", 48);
    const double volume = inspect(sphere).volume;
    for (const float size : {0.1f, 0.3f, 0.6f}) {
        const TriangleMesh cyst = moved(scaled(sphere, size), {0.03f, 0.02f, 0});
        const double hollow = volume * double{1 - size * size * size};
        for (const bool isCuttable : {false, true}) {
            MeshBody cuttable = body(20);
            cuttable.isCuttable = isCuttable;
            sim::Scene solid, shell;
            addMesh(solid, joined(sphere, cyst), cuttable);
            addMesh(shell, joined(sphere, inverted(cyst)), cuttable);
            EXPECT_NEAR(massOf(solid) / (1000 * volume), 1, 5e-3) << size;
            EXPECT_NEAR(massOf(shell) / (1000 * hollow), 1, 5e-3) << size << ", a cavity";
        }
    }
}

TEST(AddMesh, LeavesNoNodeMuchLighterThanItsLinksAreWeak) {
    for (const double degrees : {0.0, 17.0, 45.0}) {
        sim::Scene scene;
        addMesh(scene, turned(box({-0.2f, -0.003f, -0.2f}, {0.2f, 0.003f, 0.2f}), degrees), body(24));
        std::vector<double> stiffness(scene.particles.size());
        for (const sim::DistanceConstraint& link : scene.distances)
            for (const std::uint32_t end : {link.a, link.b}) stiffness[end] += 1 / double{link.compliance};
        double least = 1e30, mean = 0;
        for (std::size_t i = 0; i < stiffness.size(); ++i) {
            const double ratio = 1 / (double{scene.particles[i].inverseMass} * stiffness[i]);
            least = std::min(least, ratio);
            mean += ratio / static_cast<double>(stiffness.size());
        }
        EXPECT_GT(least, 0.4 * mean) << degrees;
    }
}

TEST(AddMesh, KnowsItsRestVolume) {
    const TriangleMesh organ = generate("organ", 40);
    sim::Scene scene;
    addMesh(scene, organ, body(20));
    EXPECT_NEAR(double{scene.bodies[0].restVolume} / inspect(organ).volume, 1, 1e-6);
    EXPECT_EQ(scene.bodies[0].name, "thing");
    const VoxelGrid grid = addMesh(scene, openedAbove(organ, 0.05f), body(20)).voxels;
    EXPECT_NEAR(double{scene.bodies[1].restVolume} / grid.filledVolume, 1, 1e-6);
}

TEST(AddMesh, LetsTheSkinRestOnAPlaneNotTheHull) {
    sim::Scene scene;
    const VoxelGrid grid = addMesh(scene, generate("sphere", 64), body(12)).voxels;
    double farthest = 0, highest = -1;
    for (const sim::Particle& particle : scene.particles) {
        const double outside = toVector(particle.position).norm() - 0.15;
        EXPECT_NEAR(double{particle.contactOffset}, std::min(double{grid.spacing}, -outside), 2e-4);
        farthest = std::max(farthest, outside);
        // A plane stops the body where the first particle is at its contactOffset from the plane.
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

// Only a closed surface that the voxels resolve has an inside that cuts can show.
namespace {

struct Cuttable {
    sim::Scene scene;
    AddedMesh added;
    explicit Cuttable(const TriangleMesh& mesh, std::uint32_t resolution = 20, bool isCuttable = true) {
        MeshBody cuttable = body(resolution);
        cuttable.isCuttable = isCuttable;
        added = addMesh(scene, mesh, cuttable);
    }
    bool showsInside() const { return sim::showsInside(scene, 0, 0); }
    /// The skin at rest.
    TriangleMesh skin() const {
        TriangleMesh mesh{.triangles = scene.skins[0].triangles};
        const std::vector<Vector3> particles = positionsOf(scene);
        for (const sim::CellEmbedding& cell : scene.skins[0].cells)
            mesh.positions.push_back(toVec3(skinned(cell, particles)));
        return mesh;
    }
};

/// Removes the triangles whose number is divisible by `step`.
TriangleMesh withHoles(TriangleMesh mesh, std::size_t step) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
        if (i % step != 0) mesh.triangles[kept++] = mesh.triangles[i];
    mesh.triangles.resize(kept);
    return mesh;
}

double farthestFrom(const TriangleMesh& surface, const TriangleMesh& of) {
    double farthest = 0;
    for (const float distance : signedDistance(surface, of.positions))
        farthest = std::max(farthest, std::abs(double{distance}));
    return farthest;
}

} // namespace

TEST(AddMesh, ShowsTheMeshItselfWhereThatHasAnInside) {
    for (const char* shape : {"sphere", "organ", "tube"}) {
        const Cuttable body(generate(shape, 40));
        EXPECT_EQ(body.added.shown, Shown::mesh) << shape;
        EXPECT_TRUE(body.showsInside()) << shape;
    }
}

TEST(AddMesh, WrapsAnOpenMeshThatMayBeCut) {
    const TriangleMesh organ = generate("organ", 40);
    const double volume = inspect(organ).volume;
    const std::vector<TriangleMesh> broken{openedAbove(organ, 0.05f), withHoles(organ, 20),
                                           withHoles(organ, 7), withFlipped(withHoles(organ, 15), 3)};
    for (std::size_t i = 0; i < broken.size(); ++i) {
        const Cuttable body(broken[i]);
        EXPECT_EQ(body.added.shown, Shown::wrapped) << i;
        EXPECT_TRUE(body.showsInside()) << i;
        const MeshReport skin = inspect(body.skin());
        EXPECT_TRUE(skin.defects.isClosed()) << i;
        EXPECT_EQ(skin.defects.flippedEdges, 0u) << i;
        const double filled = voxelise(broken[i], {.resolution = 20}).filledVolume;
        EXPECT_NEAR(skin.volume / filled, 1, 0.02) << i;
        EXPECT_NEAR(double{body.scene.bodies[0].restVolume} / filled, 1, 1e-6) << i;
        if (i > 0) { // the volume above the opening is unknown for i = 0
            EXPECT_NEAR(skin.volume / volume, 1, 0.02) << i;
            EXPECT_LT(farthestFrom(organ, body.skin()), 0.5 * double{body.added.voxels.spacing}) << i;
        }
    }
}

TEST(AddMesh, WrapsPartsThatPassThroughEachOtherIntoOne) {
    const TriangleMesh sphere = generate("sphere", 40);
    const TriangleMesh pair = joined(sphere, moved(sphere, {0.1f, 0, 0}));
    const Cuttable body(pair, 24);
    EXPECT_EQ(body.added.shown, Shown::wrapped);
    EXPECT_TRUE(body.showsInside());
    const double r = 0.15, d = 0.1; // two balls less their common lens
    const double ball = 4.0 / 3 * std::numbers::pi * r * r * r,
                 lens = std::numbers::pi * (4 * r + d) * (2 * r - d) * (2 * r - d) / 12;
    EXPECT_NEAR(inspect(body.skin()).volume / (2 * ball - lens), 1, 0.02);
}

// Regression test: half a voxel beside a thick part, a plate of a tenth of a voxel fell between fill samples.
TEST(AddMesh, WrapsAThinPartBesideAThickOne) {
    for (const double degrees : {0.0, 20.0})
        for (const float gap : {0.005f, 0.03f, 0.06f, 0.2f})
            for (const float thickness : {0.001f, 0.005f, 0.03f}) {
                const TriangleMesh plate =
                    turned(box({1 + gap, 0.2f, 0.2f}, {1 + gap + thickness, 0.8f, 0.8f}), degrees);
                const Cuttable body(
                    joined(turned(openedAbove(box({0, 0, 0}, {1, 1, 1}), 0.9f), degrees), plate), 16);
                ASSERT_EQ(body.added.shown, Shown::wrapped);
                EXPECT_TRUE(body.showsInside());
                const TriangleMesh skin = body.skin();
                std::vector<Vector3> positions;
                for (const sim::Vec3& position : skin.positions) positions.push_back(toVector(position));
                const TriangleTree tree(positions, skin.triangles);
                double farthest = 0; // largest distance outside [voxels]
                Random random(1);
                for (int i = 0; i < 400; ++i) {
                    const auto& corners = plate.triangles[random.next() % plate.triangles.size()];
                    const double s = std::sqrt(random.unit()), t = random.unit();
                    const Vector3 x = (1 - s) * toVector(plate.positions[corners[0]]) +
                                      s * (1 - t) * toVector(plate.positions[corners[1]]) +
                                      s * t * toVector(plate.positions[corners[2]]);
                    if (tree.windingNumber(x) < 0.5)
                        farthest = std::max(farthest, tree.distance(x) / double{body.added.voxels.spacing});
                }
                EXPECT_LT(farthest, 0.25) << degrees << ' ' << gap << ' ' << thickness;
                const double plateVoxels =
                    (inspect(skin).volume - 1) / (0.36 * double{body.added.voxels.spacing});
                EXPECT_GT(plateVoxels, 0.3) << degrees << ' ' << gap << ' ' << thickness;
                EXPECT_LT(plateVoxels, 1.3) << degrees << ' ' << gap << ' ' << thickness;
            }
}

// No two triangles share corners, so each is a component; most are smaller than a voxel.
TEST(AddMesh, WrapsTrianglesThatHangOnNothingAsTheMeshThatTheyWere) {
    for (const std::uint32_t detail : {12u, 24u, 40u, 80u}) {
        const TriangleMesh organ = generate("organ", detail);
        const MeshReport report = inspect(organ);
        const Cuttable body(soup(organ, 1e-4 * double{report.high.x - report.low.x}), 20);
        EXPECT_EQ(body.added.shown, Shown::wrapped) << detail;
        EXPECT_TRUE(body.showsInside()) << detail;
        EXPECT_NEAR(inspect(body.skin()).volume / report.volume, 1, 0.02) << detail;
    }
}

TEST(AddMesh, WrapsASheetAsThickAsAVoxel) {
    TriangleMesh sheet = box({0, 0, 0}, {1, 1, 1}); // two triangles in one plane
    sheet.triangles.resize(2);
    const Cuttable body(turned(sheet, 20), 12);
    EXPECT_EQ(body.added.shown, Shown::wrapped);
    EXPECT_TRUE(body.showsInside());
    const double thickness = inspect(body.skin()).volume / double{body.added.voxels.spacing};
    EXPECT_NEAR(thickness, 1, 0.2); // with rounded rims
    EXPECT_NEAR(massOf(body.scene) / (1000 * inspect(body.skin()).volume), 1, 1e-3);
}

TEST(AddMesh, LosesNoPartThatIsThinnerThanAVoxel) {
    const TriangleMesh ball = moved(scaled(generate("sphere", 40), 2), {0.3f, 0, 0});
    for (const float half : {0.001f, 0.005f, 0.01f, 0.02f}) {
        const TriangleMesh leg = turned(box({-0.7f, -half, -half}, {0.03f, half, half}), 8);
        const TriangleMesh mesh = withHoles(joined(ball, leg), 25);
        const Cuttable body(mesh, 24);
        EXPECT_TRUE(body.showsInside()) << half;
        EXPECT_LT(farthestFrom(body.skin(), leg), double{body.added.voxels.spacing}) << half;
    }
}

TEST(AddMesh, ShowsAnInsideOfEveryThickness) {
    for (const float thickness : {0.002f, 0.02f, 0.04f, 0.06f, 0.1f, 0.15f})
        for (const double degrees : {0.0, 20.0})
            EXPECT_TRUE(Cuttable(turned(box({0, 0, 0}, {1, thickness, 0.7f}), degrees), 20).showsInside())
                << thickness << ", turned by " << degrees;
}

TEST(AddMesh, LeavesAnOpenMeshAsItCameWhereNothingIsCut) {
    const TriangleMesh open = openedAbove(generate("organ", 40), 0.05f);
    const Cuttable body(open, 20, false);
    EXPECT_EQ(body.added.shown, Shown::mesh);
    EXPECT_EQ(body.scene.skins[0].triangles.size(), open.triangles.size());
}

// A body that may be cut shows an inside for any triangles.
TEST(AddMesh, ShowsAnInsideOfAnyTriangles) {
    Random random(3);
    std::array<int, 3> shown{};
    for (int i = 0; i < 60; ++i) {
        TriangleMesh soup;
        const std::uint32_t triangles = 1 + random.next() % 40;
        const double length = 0.05 + random.unit();
        for (std::uint32_t t = 0; t < triangles; ++t) {
            const Vector3 middle(random.unit(), random.unit(), random.unit());
            for (int corner = 0; corner < 3; ++corner)
                soup.positions.push_back(
                    toVec3(middle + length * Vector3(random.unit(), random.unit(), random.unit())));
            soup.triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
        }
        const Cuttable body(soup, 3 + random.next() % 12);
        EXPECT_TRUE(body.showsInside()) << i;
        ++shown[static_cast<std::size_t>(body.added.shown)];
    }
    EXPECT_GT(shown[1], 0);
    EXPECT_GT(shown[2], 0) << "none needed its voxels to be shown";
    std::printf("%d as they are, %d wrapped, %d as voxels\n", shown[0], shown[1], shown[2]);
}
