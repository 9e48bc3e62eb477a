// Tests of voxels made on the device: against the winding number summed in double, against voxels made on the
// host, and in reversed order.
#include "mesh/gpu/voxelise.hpp"

#include "mesh/generate.hpp"
#include "mesh/place_grid.hpp"
#include "mesh/triangle_tree.hpp"
#include "meshes.hpp"
#include "support/device.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <optional>

using namespace sinew;
using namespace sinew::mesh;
using namespace sinew::mesh::test;

namespace {

/// Voxelisers in both invocation orders; all tests share their pipelines.
class DeviceVoxels : public testing::Test {
protected:
    static void SetUpTestSuite() { // name given by GoogleTest
        forward_.emplace(sinew::test::device(), sinew::test::queue());
        reversed_.emplace(sinew::test::device(), sinew::test::queue(), true);
    }
    static void TearDownTestSuite() {
        forward_.reset();
        reversed_.reset();
    }

    static VoxelGrid onDevice(const TriangleMesh& mesh, const VoxelRequest& request) {
        return (*forward_)(mesh, request);
    }
    static VoxelGrid onDeviceReversed(const TriangleMesh& mesh, const VoxelRequest& request) {
        return (*reversed_)(mesh, request);
    }
    static VoxelGrid expectSameEverywhere(const TriangleMesh& mesh, const VoxelRequest& request,
                                          std::string_view name);
    static void expectWindingNumbers(const TriangleMesh& mesh, const VoxelRequest& request,
                                     std::string_view name, std::size_t step = 7);
    static double fillError(const TriangleMesh& broken, double volume);

private:
    static inline std::optional<gpu::Voxeliser> forward_, reversed_;
};

void expectEqual(const VoxelGrid& grid, const VoxelGrid& other, std::string_view name) {
    EXPECT_EQ(grid.cells, other.cells) << name;
    EXPECT_EQ(grid.spacing, other.spacing) << name;
    EXPECT_EQ(grid.voxels, other.voxels) << name;
    EXPECT_EQ(grid.fill, other.fill) << name;
    EXPECT_EQ(grid.hullCount, other.hullCount) << name;
    EXPECT_EQ(grid.coreCount, other.coreCount) << name;
    EXPECT_EQ(grid.doubtful, other.doubtful) << name;
    EXPECT_EQ(grid.filledVolume, other.filledVolume) << name;
}

TriangleMesh inCells(const PlacedMesh& placed) {
    TriangleMesh mesh = placed.mesh;
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) mesh.positions[i] = toVec3(placed.positions[i]);
    return mesh;
}

TriangleMesh tetrahedron(const std::array<Vec3, 4>& corners) {
    TriangleMesh mesh;
    mesh.positions = {corners.begin(), corners.end()};
    mesh.triangles = {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}};
    return orient(mesh);
}

/// Overlapping tetrahedra in a cube of `size` units, with corners on multiples of `unit`.
TriangleMesh heap(int count, std::uint32_t size, float unit, std::uint64_t seed) {
    Random random(seed);
    const auto corner = [&] {
        const auto at = [&] { return unit * static_cast<float>(random.next() % (size + 1)); };
        return Vec3{at(), at(), at()};
    };
    TriangleMesh mesh;
    for (int i = 0; i < count;) {
        const TriangleMesh one = tetrahedron({corner(), corner(), corner(), corner()});
        if (inspect(one).volume < 1e-3 * std::pow(double{unit} * size, 3)) continue;
        mesh = joined(mesh, one);
        ++i;
    }
    return mesh;
}

TriangleMesh torus(int around, int across, float radius, float thickness) {
    TriangleMesh mesh;
    for (int i = 0; i < around; ++i)
        for (int j = 0; j < across; ++j) {
            const double u = 2 * std::numbers::pi * i / around, v = 2 * std::numbers::pi * j / across;
            const double r = double{radius} + double{thickness} * std::cos(v);
            mesh.positions.push_back(
                toVec3({r * std::cos(u), double{thickness} * std::sin(v), r * std::sin(u)}));
            const auto at = [&](int a, int b) {
                return static_cast<std::uint32_t>(a % around * across + b % across);
            };
            mesh.triangles.push_back({at(i, j), at(i, j + 1), at(i + 1, j)});
            mesh.triangles.push_back({at(i, j + 1), at(i + 1, j + 1), at(i + 1, j)});
        }
    return mesh;
}

/// Whether a point lies inside a closed mesh, summed triangle by triangle. `isTie`: it lies on the surface.
struct Truth {
    bool isInside = false, isTie = false;
};

Truth truthAt(const TriangleMesh& cellMesh, const TriangleTree& tree, const Vector3& point) {
    return {std::abs(windingNumber(cellMesh, point)) > 0.5, tree.distance(point) < 1e-6};
}

/// Bounds of the fill of a hull cell: without and with the samples that lie on the surface.
std::array<int, 2> fillBounds(const TriangleMesh& cellMesh, const TriangleTree& tree, const Vector3& low) {
    int least = 0, most = 0;
    for (int sample = 0; sample < 64; ++sample) {
        const Vector3 offset(sample % 4, sample / 4 % 4, sample / 16);
        const Truth truth = truthAt(cellMesh, tree, low + (offset + Vector3::Constant(0.5)) / 4);
        least += truth.isInside && !truth.isTie ? 1 : 0;
        most += truth.isInside || truth.isTie ? 1 : 0;
    }
    return {least, most};
}

} // namespace

/// Expects equal voxels on the host, on the device and there in reversed order. Returns them.
VoxelGrid DeviceVoxels::expectSameEverywhere(const TriangleMesh& mesh, const VoxelRequest& request,
                                             std::string_view name) {
    const VoxelGrid grid = onDevice(mesh, request);
    expectEqual(grid, onDeviceReversed(mesh, request), std::string(name) + ", reversed");
    expectEqual(grid, voxelise(mesh, request), std::string(name) + ", host");
    return grid;
}

/// Compares the voxels of a closed mesh with the plain sum over its triangles: all centres outside the hull,
/// and all fill samples of every `step`th hull cell. No vote may be doubtful.
void DeviceVoxels::expectWindingNumbers(const TriangleMesh& mesh, const VoxelRequest& request,
                                        std::string_view name, std::size_t step) {
    const VoxelGrid grid = onDevice(mesh, request);
    expectEqual(grid, onDeviceReversed(mesh, request), name);
    EXPECT_EQ(grid.doubtful, 0u) << name;
    const PlacedMesh placed = placeGrid(mesh, request);
    const TriangleMesh cellMesh = inCells(placed);
    const TriangleTree tree(placed.positions, placed.mesh.triangles);
    std::size_t hull = 0;
    forEachCell(grid, [&](std::size_t index, const Vector3& low) {
        if (grid.voxels[index] != Voxel::hull) {
            const Truth truth = truthAt(cellMesh, tree, low + Vector3::Constant(0.5));
            ASSERT_FALSE(truth.isTie) << name << " " << low.transpose();
            ASSERT_EQ(grid.voxels[index], truth.isInside ? Voxel::core : Voxel::empty)
                << name << " " << low.transpose();
        } else if (hull++ % step == 0) {
            const auto [least, most] = fillBounds(cellMesh, tree, low);
            const long found = std::lround(64 * grid.fill[index]);
            ASSERT_GE(found, least) << name << " " << low.transpose();
            ASSERT_LE(found, most) << name << " " << low.transpose();
        }
    });
    EXPECT_GT(hull, 0u) << name;
}

/// Error of a broken mesh's volume, as a share of the repaired mesh's volume.
double DeviceVoxels::fillError(const TriangleMesh& broken, double volume) {
    return std::abs(onDevice(broken, {.spacing = 0.01f}).filledVolume / volume - 1);
}

TEST_F(DeviceVoxels, AreThoseOfTheHostForEveryShape) {
    for (const Shape& shape : shapes())
        for (const std::uint32_t resolution : {1u, 5u, 24u, 47u}) {
            const VoxelGrid grid =
                expectSameEverywhere(generate(shape.name, 32), {.resolution = resolution}, shape.name);
            EXPECT_GT(grid.hullCount, 0u);
        }
}

TEST_F(DeviceVoxels, AgreeWithTheWindingNumberAtEveryCentre) {
    expectWindingNumbers(box({0, 0, 0}, {1, 1, 1}), {.resolution = 9}, "box", 1);
    expectWindingNumbers(generate("sphere", 16), {.resolution = 14}, "sphere");
    expectWindingNumbers(torus(24, 12, 0.4f, 0.15f), {.resolution = 17}, "torus");
    expectWindingNumbers(generate("organ", 16), {.resolution = 15}, "organ");
    expectWindingNumbers(generate("torus_knot", 16), {.resolution = 13}, "torus knot");
}

TEST_F(DeviceVoxels, AgreeWithTheWindingNumberOfManyParts) {
    const TriangleMesh sphere = generate("sphere", 12);
    expectWindingNumbers(joined(sphere, moved(sphere, {0.2f, 0.05f, 0.03f})), {.resolution = 20}, "overlap");
    expectWindingNumbers(joined(sphere, moved(sphere, {0.5f, 0, 0})), {.resolution = 21}, "apart");
    expectWindingNumbers(
        joined(box({0, 0, 0}, {1, 1, 1}), withFlipped(box({0.25f, 0.25f, 0.25f}, {0.75f, 0.75f, 0.75f}), 1)),
        {.resolution = 15}, "cavity");
    expectWindingNumbers(heap(12, 1u << 20, 1.0f / (1u << 20), 4), {.resolution = 19}, "heap");
}

TEST_F(DeviceVoxels, BreakTiesTheSameWayAlongEveryAxis) {
    // Corners lie on multiples of a quarter cell, so edges and faces pass through sample points and cell
    // corners and along cell faces. Every vote depends on the sign of a value that is often exactly 0.
    for (std::uint64_t seed = 0; seed < 6; ++seed) {
        expectWindingNumbers(heap(6, 48, 0.25f, seed), {.spacing = 1}, "quarters");
        expectWindingNumbers(heap(5, 12, 1, 100 + seed), {.spacing = 1}, "whole cells");
    }
    for (std::uint64_t seed = 0; seed < 3; ++seed) { // 30 bits a coordinate; double has doubtful votes here
        const TriangleMesh mesh = heap(6, 508, 0.25f, seed);
        const VoxelGrid grid = onDevice(mesh, {.spacing = 1}), host = voxelise(mesh, {.spacing = 1});
        expectEqual(grid, onDeviceReversed(mesh, {.spacing = 1}), "quarters of 128 cells");
        EXPECT_EQ(grid.doubtful, 0u);
        EXPECT_EQ(grid.voxels, host.voxels);
    }
}

TEST_F(DeviceVoxels, FillBoxesToTheSampleWhereFacesLieOnSamples) {
    const VoxelGrid grid = expectSameEverywhere(box({0, 0, 0}, {1, 1, 1}), {.spacing = 0.25f}, "centres");
    EXPECT_EQ(grid.cells[0], 5u);
    EXPECT_NEAR(grid.filledVolume, 1, 1e-6);
    const VoxelGrid shifted =
        expectSameEverywhere(box({0, 0, 0}, {1.0625f, 1.0625f, 1.0625f}), {.spacing = 0.25f}, "samples");
    EXPECT_NEAR(shifted.filledVolume, std::pow(1.0625, 3), 1e-6);
}

TEST_F(DeviceVoxels, CoverEverySampleOfTheSurfaceAndNothingFarFromIt) {
    for (const std::string_view name : {"organ", "torus_knot", "slab_with_hole", "cloth"}) {
        const TriangleMesh mesh = generate(name, 16);
        const VoxelGrid grid = onDevice(mesh, {.resolution = 37});
        for (const std::size_t cell : cellsOfSurfaceSamples(mesh, grid))
            ASSERT_EQ(grid.voxels[cell], Voxel::hull) << name;
        const TriangleTree tree(toCellUnits(mesh, grid), mesh.triangles);
        forEachCell(grid, [&](std::size_t index, const Vector3& low) {
            if (grid.voxels[index] != Voxel::hull) return;
            EXPECT_LE(tree.distance(low + Vector3::Constant(0.5)), std::sqrt(3) / 2 + 1e-6) << name;
        });
    }
}

TEST_F(DeviceVoxels, TakeThinPlatesAndNeedles) {
    const VoxelGrid plate = expectSameEverywhere(box({0, 0, 0}, {1, 1, 1e-4f}), {.spacing = 0.05f}, "plate");
    EXPECT_EQ(plate.cells[2], 1u);
    EXPECT_EQ(plate.hullCount, plate.voxels.size());
    EXPECT_EQ(plate.doubtful, 0u);
    expectSameEverywhere(box({0, 0, 0}, {1e-5f, 1, 1e-5f}), {.resolution = 40}, "needle");
    // Vertices almost on the edges of a box split them. The triangles are a thousandth of a unit high, and
    // the mesh stays closed.
    TriangleMesh slivers = box({0, 0, 0}, {1, 1, 1});
    const std::array<std::uint32_t, 3> split = slivers.triangles.front();
    const Vector3 a = toVector(slivers.positions[split[0]]), b = toVector(slivers.positions[split[1]]),
                  c = toVector(slivers.positions[split[2]]);
    slivers.triangles.erase(slivers.triangles.begin());
    slivers.positions.push_back(toVec3(a + 0.37 * (b - a) + 1e-7 * (c - a)));
    const auto middle = static_cast<std::uint32_t>(slivers.positions.size() - 1);
    for (std::size_t side = 0; side < 3; ++side)
        slivers.triangles.push_back({split[side], split[(side + 1) % 3], middle});
    expectWindingNumbers(slivers, {.resolution = 11}, "slivers", 3);
}

TEST_F(DeviceVoxels, IgnoreTrianglesWithoutArea) {
    const TriangleMesh sphere = generate("sphere", 16);
    TriangleMesh extended = sphere;
    extended.positions.insert(extended.positions.end(), {{0, 0, 0}, {0.05f, 0, 0}, {0.1f, 0, 0}});
    const auto first = static_cast<std::uint32_t>(sphere.positions.size());
    extended.triangles.push_back({first, first + 1, first + 2});
    extended.triangles.push_back({first, first, first + 1});
    expectEqual(onDevice(extended, {.resolution = 12}), onDevice(sphere, {.resolution = 12}), "no area");
}

TEST_F(DeviceVoxels, AreTheSameFarFromTheOrigin) {
    const TriangleMesh far = moved(generate("organ", 24), {1000, -2000, 500});
    const VoxelGrid grid = expectSameEverywhere(far, {.resolution = 20}, "far");
    EXPECT_GT(grid.coreCount, 0u);
    EXPECT_EQ(grid.doubtful, 0u);
    EXPECT_THROW(onDevice(moved(box({}, {16, 16, 16}), {1e8f, 0, 0}), {.resolution = 4}),
                 std::invalid_argument);
}

TEST_F(DeviceVoxels, FillOpenFlippedAndSelfIntersectingMeshes) {
    const TriangleMesh sphere = generate("sphere", 64);
    const double volume = inspect(sphere).volume;
    const TriangleMesh open = openedAbove(sphere, 0.142f);
    ASSERT_GT(inspect(open).defects.boundaryEdges, 20u);
    EXPECT_LT(fillError(open, volume), 0.02);
    EXPECT_GT(onDevice(open, {.spacing = 0.01f}).doubtful, 0u);
    expectEqual(onDevice(open, {.spacing = 0.01f}), onDeviceReversed(open, {.spacing = 0.01f}), "open");
    for (const std::size_t step : {1u, 2u, 9u}) EXPECT_LT(fillError(withFlipped(sphere, step), volume), 0.02);
    EXPECT_LT(fillError(withFlipped(unwelded(openedAbove(sphere, 0.142f)), 5), volume), 0.02);
    const double radius = 0.15, distance = 0.2;
    const double lens = std::numbers::pi * std::pow(2 * radius - distance, 2) *
                        (distance * distance + 4 * distance * radius) / (12 * distance);
    EXPECT_LT(fillError(joined(sphere, moved(sphere, {0.2f, 0, 0})), 2 * volume - lens), 0.02);
}

TEST_F(DeviceVoxels, OfOpenMeshesDifferFromTheHostsByRoundingAtMost) {
    const TriangleMesh open = openedAbove(generate("organ", 32), 0.03f);
    const VoxelGrid grid = onDevice(open, {.resolution = 30}), host = voxelise(open, {.resolution = 30});
    EXPECT_EQ(grid.hullCount, host.hullCount);
    EXPECT_EQ(grid.doubtful, host.doubtful);
    EXPECT_GT(grid.doubtful, 1000u);
    EXPECT_NEAR(grid.filledVolume, host.filledVolume, 1e-4 * host.filledVolume);
}

TEST_F(DeviceVoxels, TakeLargeTrianglesInManyItems) {
    const VoxelGrid grid = expectSameEverywhere(heap(6, 1u << 20, 1.0f / (1u << 20), 8), {.resolution = 128},
                                                "large"); // 24 triangles, 3e5 rows: several batches
    EXPECT_GT(grid.hullCount, 10000u);
    EXPECT_EQ(grid.doubtful, 0u);
}

TEST_F(DeviceVoxels, TakeMoreCellsThanOneDispatch) {
    const TriangleMesh sphere = generate("sphere", 12);
    const VoxelGrid grid = onDevice(sphere, {.resolution = 206});
    EXPECT_GT(grid.voxels.size(), 65535u * 128u);
    expectEqual(grid, voxelise(sphere, {.resolution = 206}), "206");
}

TEST_F(DeviceVoxels, TakeMemoryLinearInCellsAndTriangles) {
    const TriangleMesh sphere = generate("sphere", 48);
    for (const std::uint32_t resolution : {8u, 32u, 128u}) {
        const VoxelGrid grid = onDevice(sphere, {.resolution = resolution});
        const double cells = static_cast<double>(grid.voxels.size());
        const double columns = 3 * std::pow(resolution, 2);
        // The number of hull cells that a triangle touches is its share of the hull and at most 8 more.
        const double most = 12.5 * cells + (88 + 4) * static_cast<double>(grid.hullCount) + 72 * columns +
                            (20 + 4 * 8) * static_cast<double>(sphere.triangles.size()) +
                            16 * static_cast<double>(sphere.positions.size());
        EXPECT_LT(static_cast<double>(grid.workBytes), most) << resolution;
        EXPECT_GT(static_cast<double>(grid.workBytes), 12 * cells) << resolution;
    }
}

TEST_F(DeviceVoxels, RefuseWhatTheHostRefuses) {
    const TriangleMesh cube = box({0, 0, 0}, {1, 1, 1});
    EXPECT_THROW(onDevice({}, {}), std::invalid_argument);
    EXPECT_THROW(onDevice(cube, {.spacing = -1}), std::invalid_argument);
    EXPECT_THROW(onDevice(cube, {.spacing = 1e-4f}), std::length_error);
}
