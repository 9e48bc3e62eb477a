// Tests of hull, core and fill: volumes, inertia (cases 23 and 24 of docs/accuracy.md), broken meshes (case
// 32), and the winding number summed triangle by triangle.
#include "mesh/voxelise.hpp"

#include "mesh/generate.hpp"
#include "mesh/inside.hpp"
#include "mesh/place_grid.hpp"
#include "meshes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

using namespace sinew::mesh;
using namespace sinew::mesh::test;

namespace {

Vector3 toMetres(const VoxelGrid& grid, const Vector3& cellUnits) {
    return toVector(grid.origin) + cellUnits * double{grid.spacing};
}

/// A sphere of radius 0.15 m with triangles much smaller than its cells.
TriangleMesh fineSphere() {
    return generate("sphere", 128);
}

/// Error of a broken mesh's filled volume, as a share of the repaired mesh's volume.
double fillError(const TriangleMesh& broken, double volume,
                 const VoxelRequest& request = {.spacing = 0.01f}) {
    return std::abs(voxelise(broken, request).filledVolume / volume - 1);
}

} // namespace

TEST(Voxelise, FillsASphereToOnePercentOfItsVolume) {
    const VoxelGrid grid = voxelise(fineSphere(), {.spacing = 0.015f}); // radius = 10 cells
    EXPECT_NEAR(grid.filledVolume / (4 * std::numbers::pi / 3 * std::pow(0.15, 3)), 1, 0.01);
    EXPECT_EQ(grid.doubtful, 0u);
}

TEST(Voxelise, FillsASphereToTwoPercentOfItsInertia) {
    const VoxelGrid grid = voxelise(fineSphere(), {.spacing = 0.015f});
    const double a = double{grid.spacing};
    Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero(); // of unit density, with the own inertia of each cell
    forEachCell(grid, [&](std::size_t index, const Vector3& low) {
        const double mass = double{grid.fill[index]} * a * a * a;
        const Vector3 x = toMetres(grid, low + Vector3::Constant(0.5));
        inertia += mass * ((x.squaredNorm() + a * a / 6) * Eigen::Matrix3d::Identity() - x * x.transpose());
    });
    const double exact = 0.4 * 4 * std::numbers::pi / 3 * std::pow(0.15, 5);
    EXPECT_LT((inertia / exact - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff(), 0.02);
}

TEST(Voxelise, AgreesWithTheWindingNumberAtEveryCentre) {
    for (const std::string_view name : {"organ", "torus_knot", "slab_with_hole"}) {
        const TriangleMesh mesh = generate(name, 16);
        const VoxelGrid grid = voxelise(mesh, {.resolution = 12});
        const std::vector<Vector3> positions = toCellUnits(mesh, grid);
        const TriangleTree tree(positions, mesh.triangles);
        const Inside inside(positions, mesh.triangles, tree, grid.cells, 1);
        forEachCell(grid, [&](std::size_t index, const Vector3& low) {
            const bool isInside =
                std::abs(windingNumber(mesh, toMetres(grid, low + Vector3::Constant(0.5)))) > 0.5;
            const Vector3 cell = low;
            const Inside::Answer answer =
                inside({static_cast<std::uint32_t>(cell.x()), static_cast<std::uint32_t>(cell.y()),
                        static_cast<std::uint32_t>(cell.z())});
            EXPECT_EQ(answer.isInside, isInside) << name << " " << low.transpose();
            EXPECT_FALSE(answer.isDoubtful) << name << " " << low.transpose();
            const Voxel voxel = grid.voxels[index];
            EXPECT_TRUE(voxel != Voxel::core || (isInside && grid.fill[index] == 1));
            EXPECT_TRUE(voxel != Voxel::empty || (!isInside && grid.fill[index] == 0));
        });
    }
}

TEST(Voxelise, FillsHullCellsByTheirSamples) {
    const TriangleMesh mesh = generate("organ", 12);
    const VoxelGrid grid = voxelise(mesh, {.resolution = 6});
    forEachCell(grid, [&](std::size_t index, const Vector3& low) {
        if (grid.voxels[index] != Voxel::hull) return;
        int count = 0;
        for (int sample = 0; sample < 64; ++sample) {
            const Vector3 offset(sample % 4, sample / 4 % 4, sample / 16);
            const Vector3 point = low + (offset + Vector3::Constant(0.5)) / 4;
            count += std::abs(windingNumber(mesh, toMetres(grid, point))) > 0.5 ? 1 : 0;
        }
        EXPECT_EQ(grid.fill[index], static_cast<float>(count) / 64) << low.transpose();
    });
}

TEST(Voxelise, CoversEverySampleOfTheSurfaceWithHullCells) {
    for (const std::string_view name : {"organ", "torus_knot", "slab_with_hole", "cloth"}) {
        const TriangleMesh mesh = generate(name, 16);
        const VoxelGrid grid = voxelise(mesh, {.resolution = 37});
        for (const std::size_t cell : cellsOfSurfaceSamples(mesh, grid))
            ASSERT_EQ(grid.voxels[cell], Voxel::hull) << name;
    }
}

TEST(Voxelise, MarksNoHullCellThatTheSurfaceMisses) {
    const TriangleMesh mesh = generate("organ", 16);
    const VoxelGrid grid = voxelise(mesh, {.resolution = 37});
    const std::vector<Vector3> positions = toCellUnits(mesh, grid);
    forEachCell(grid, [&](std::size_t index, const Vector3& low) {
        if (grid.voxels[index] != Voxel::hull) return;
        const Vector3 center = low + Vector3::Constant(0.5);
        double nearest = 1e9;
        for (const auto& [a, b, c] : mesh.triangles)
            nearest = std::min(
                nearest, (nearestPoint(positions[a], positions[b], positions[c], center) - center).norm());
        EXPECT_LE(nearest, std::sqrt(3) / 2 + 1e-6);
    });
}

TEST(Voxelise, MakesABoxOfAsManyCellsAsAsked) {
    for (const std::uint32_t resolution : {1u, 2u, 5u, 16u}) {
        const VoxelGrid grid = voxelise(box({-1, 4, 2}, {1, 6, 3}), {.resolution = resolution});
        EXPECT_EQ(grid.cells[0], resolution);
        EXPECT_EQ(grid.cells[2], resolution / 2 + resolution % 2);
        EXPECT_EQ(grid.hullCount + grid.coreCount, grid.voxels.size());
    }
}

TEST(Voxelise, BreaksTiesTheSameWayAlongEveryAxis) {
    // Cells of 1/4 in a box of 4 cells: the grid has 5 cells, with centres exactly on the box's faces.
    const VoxelGrid grid = voxelise(box({0, 0, 0}, {1, 1, 1}), {.spacing = 0.25f});
    EXPECT_EQ(grid.cells[0], 5u);
    EXPECT_EQ(grid.doubtful, 0u);
    EXPECT_NEAR(grid.filledVolume, 1, 1e-6);
    // Faces lie on the planes of the fill samples: one of two opposite faces counts.
    const VoxelGrid shifted = voxelise(box({0, 0, 0}, {1.0625f, 1.0625f, 1.0625f}), {.spacing = 0.25f});
    EXPECT_EQ(shifted.doubtful, 0u);
    EXPECT_NEAR(shifted.filledVolume, std::pow(1.0625, 3), 1e-6);
}

TEST(Voxelise, BreaksTiesOnSlantedFacesTheSameWayAlongEveryAxis) {
    // |x| + |y| + |z| = 11/8 runs exactly through many fill samples, whose coordinates are odd eighths.
    constexpr float r = 1.375f;
    TriangleMesh octahedron;
    octahedron.positions = {{r, 0, 0}, {-r, 0, 0}, {0, r, 0}, {0, -r, 0}, {0, 0, r}, {0, 0, -r}};
    octahedron.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                            {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
    const VoxelGrid grid = voxelise(octahedron, {.spacing = 1});
    EXPECT_EQ(grid.cells[0], 3u);
    EXPECT_EQ(grid.doubtful, 0u);
    EXPECT_NEAR(grid.filledVolume, 4.0 / 3 * std::pow(1.375, 3), 0.3);
}

TEST(Voxelise, PutsTheMeshStrictlyInsideAndInTheMiddle) {
    Random random(11);
    for (int i = 0; i < 50; ++i) {
        const auto value = [&](double scale) { return static_cast<float>((random.unit() - 0.5) * scale); };
        const Vec3 low{value(100), value(100), value(100)};
        const Vec3 high{low.x + 0.1f + value(0.1), low.y + 0.3f + value(0.2), low.z + 1 + value(1)};
        const VoxelGrid grid = voxelise(box(low, high), {.resolution = 1 + random.next() % 20});
        for (const auto axis : {&Vec3::x, &Vec3::y, &Vec3::z}) {
            const std::size_t number = axis == &Vec3::x ? 0 : axis == &Vec3::y ? 1 : 2;
            const double below = double{low.*axis} - grid.origin.*axis;
            const double above = grid.origin.*axis + double{grid.spacing} * grid.cells[number] - high.*axis;
            EXPECT_GT(below, 0);
            EXPECT_GT(above, 0);
            EXPECT_NEAR(below, above, 2e-5);
        }
    }
}

TEST(Voxelise, FillsOverlappingPartsOnce) {
    const TriangleMesh sphere = fineSphere();
    const double radius = 0.15, distance = 0.2, one = 4 * std::numbers::pi / 3 * std::pow(radius, 3);
    const double lens = std::numbers::pi * std::pow(2 * radius - distance, 2) *
                        (distance * distance + 4 * distance * radius) / (12 * distance);
    EXPECT_LT(fillError(joined(sphere, moved(sphere, {0.2f, 0, 0})), 2 * one - lens), 0.02);
}

TEST(Voxelise, LeavesACavityEmpty) {
    const TriangleMesh hollow =
        joined(box({0, 0, 0}, {1, 1, 1}), withFlipped(box({0.25f, 0.25f, 0.25f}, {0.75f, 0.75f, 0.75f}), 1));
    EXPECT_LT(fillError(hollow, 1 - 0.125, {.resolution = 21}), 0.03);
}

TEST(Voxelise, FillsOpenMeshes) {
    const TriangleMesh sphere = fineSphere();
    const double volume = inspect(sphere).volume;
    const TriangleMesh open = openedAbove(sphere, 0.142f); // the hole has a diameter of 0.1 m
    ASSERT_GT(inspect(open).defects.boundaryEdges, 20u);
    EXPECT_LT(fillError(open, volume), 0.02);
    EXPECT_GT(voxelise(open, {.spacing = 0.01f}).doubtful, 0u);
}

TEST(Voxelise, FillsFlippedMeshes) {
    const TriangleMesh sphere = fineSphere();
    const double volume = inspect(sphere).volume;
    EXPECT_LT(fillError(withFlipped(sphere, 1), volume), 0.02);
    EXPECT_LT(fillError(withFlipped(sphere, 2), volume), 0.02);
    EXPECT_LT(fillError(withFlipped(sphere, 9), volume), 0.02);
    EXPECT_LT(fillError(withFlipped(unwelded(openedAbove(sphere, 0.142f)), 5), volume), 0.02);
}

TEST(Voxelise, KeepsAThinFinAsHull) {
    TriangleMesh fin = box({0, 0, 0}, {1, 1, 1});
    fin.positions.insert(fin.positions.end(), {{1, 0.5f, 0.5f}, {2, 0.5f, 0.5f}, {1, 0.9f, 0.5f}});
    fin.triangles.push_back({8, 9, 10});
    const VoxelGrid grid = voxelise(fin, {.resolution = 20});
    EXPECT_NEAR(grid.filledVolume, 1, 0.03);
    double farthest = 0;
    forEachCell(grid, [&](std::size_t index, const Vector3& low) {
        if (grid.voxels[index] != Voxel::empty) farthest = std::max(farthest, toMetres(grid, low).x());
    });
    EXPECT_GT(farthest, 1.85);
}

TEST(Voxelise, CountsWhatItMarks) {
    const VoxelGrid grid = voxelise(generate("organ", 24), {.resolution = 20});
    EXPECT_EQ(grid.hullCount, static_cast<std::size_t>(std::ranges::count(grid.voxels, Voxel::hull)));
    EXPECT_EQ(grid.coreCount, static_cast<std::size_t>(std::ranges::count(grid.voxels, Voxel::core)));
    EXPECT_GT(grid.coreCount, 0u);
}

TEST(Voxelise, RefusesWhatCannotBeFilled) {
    const TriangleMesh cube = box({0, 0, 0}, {1, 1, 1});
    EXPECT_THROW(voxelise({}, {}), std::invalid_argument);
    EXPECT_THROW(voxelise(cube, {.spacing = -1}), std::invalid_argument);
    EXPECT_THROW(voxelise(cube, {.spacing = std::nanf("")}), std::invalid_argument);
    EXPECT_THROW(voxelise(cube, {.resolution = 0}), std::invalid_argument);
    EXPECT_THROW(voxelise(moved(box({}, {16, 16, 16}), {1e8f, 0, 0}), {.resolution = 4}),
                 std::invalid_argument);
    try {
        voxelise(cube, {.spacing = 1e-4f});
        ADD_FAILURE() << "a grid of 1e12 cells was made";
    } catch (const std::length_error& error) {
        EXPECT_NE(std::string(error.what()).find("16777216"), std::string::npos) << error.what();
    }
    EXPECT_THROW(voxelise(cube, {.spacing = 1e-38f}), std::length_error);
    EXPECT_THROW(voxelise(cube, {.spacing = 0.1f, .maxCells = 1000}), std::length_error);
}

TEST(VoxeliseWithin, GivesTheFinestGridThatFitsTheBudget) {
    for (const std::string_view name : {"organ", "torus_knot", "cloth"}) {
        const TriangleMesh mesh = generate(name, 24);
        for (const std::size_t most : {8u, 100u, 3000u}) {
            const VoxelGrid grid = voxeliseWithin(most, mesh, {}, voxelise);
            EXPECT_LE(particleCount(grid), most) << name;
            const std::uint32_t longest = *std::ranges::max_element(grid.cells);
            EXPECT_GT(particleCount(voxelise(mesh, {.resolution = longest + 1})), most) << name;
        }
    }
    EXPECT_EQ(voxeliseWithin(1'000'000, generate("sphere", 16), {.maxCells = 1000}, voxelise).cells[0], 10u);
    EXPECT_THROW(voxeliseWithin(7, generate("sphere", 16), {}, voxelise), std::length_error);
}

TEST(ParticleCount, IsThatOfTheBody) {
    const VoxelGrid grid = voxelise(box({0, 0, 0}, {1, 1, 1}), {.resolution = 4});
    EXPECT_EQ(particleCount(grid), 125u);
}

TEST(SignedDistance, IsThatOfASphere) {
    const TriangleMesh sphere = fineSphere();
    std::vector<Vec3> points;
    Random random(5);
    for (int i = 0; i < 300; ++i)
        points.push_back(
            toVec3(0.5 * (Vector3(random.unit(), random.unit(), random.unit()) - Vector3::Constant(0.5))));
    const std::vector<float> distances = signedDistance(sphere, points);
    for (std::size_t i = 0; i < points.size(); ++i)
        EXPECT_NEAR(double{distances[i]}, toVector(points[i]).norm() - 0.15, 1e-4);
}

TEST(TriangleTree, FindsTheNearestTriangleAndTheWindingNumber) {
    const TriangleMesh mesh = openedAbove(generate("organ", 20), 0.03f);
    std::vector<Vector3> positions;
    for (const Vec3& position : mesh.positions) positions.push_back(toVector(position));
    const TriangleTree tree(positions, mesh.triangles);
    Random random(9);
    for (int i = 0; i < 200; ++i) {
        const Vector3 point =
            0.4 * (Vector3(random.unit(), random.unit(), random.unit()) - Vector3::Constant(0.5));
        double nearest = 1e9;
        for (const auto& [a, b, c] : mesh.triangles) // dense samples, independent of nearestPoint()
            for (int u = 0; u <= 8; ++u)
                for (int v = 0; u + v <= 8; ++v)
                    nearest = std::min(nearest, (positions[a] + u / 8.0 * (positions[b] - positions[a]) +
                                                 v / 8.0 * (positions[c] - positions[a]) - point)
                                                    .norm());
        EXPECT_LE(tree.distance(point), nearest + 1e-12);
        EXPECT_GE(tree.distance(point), nearest - 0.002) << "an eighth of an edge is 0.002 m";
        EXPECT_NEAR(tree.windingNumber(point), windingNumber(mesh, point), 0.05);
    }
}
