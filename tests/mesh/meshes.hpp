// Test meshes: small closed ones, and typical faults of mesh files.
#pragma once

#include "mesh/triangle_mesh.hpp"
#include "mesh/vector3.hpp"
#include "mesh/voxelise.hpp"

#include <cstdint>

namespace sinew::mesh::test {

/// An axis-aligned box, 12 triangles.
TriangleMesh box(Vec3 low, Vec3 high);

TriangleMesh moved(TriangleMesh mesh, Vec3 offset);
TriangleMesh scaled(TriangleMesh mesh, float factor);
TriangleMesh joined(const TriangleMesh& a, const TriangleMesh& b);

/// Gives every triangle its own vertices, as STL stores them.
TriangleMesh unwelded(const TriangleMesh& mesh);

/// Removes the triangles whose centre lies above `height`, which leaves a hole.
TriangleMesh openedAbove(const TriangleMesh& mesh, float height);

/// Flips every `step`th triangle.
TriangleMesh withFlipped(TriangleMesh mesh, std::size_t step);

/// Flips every triangle.
TriangleMesh inverted(TriangleMesh mesh);

/// Winding number as the plain sum over all triangles.
double windingNumber(const TriangleMesh& mesh, const Vector3& point);

/// Generator of random numbers in [0, 1), equal on all machines.
class Random {
public:
    explicit Random(std::uint64_t seed) : state_(seed) {}
    std::uint32_t next() {
        state_ = state_ * 6364136223846793005ull + 1442695040888963407ull;
        return static_cast<std::uint32_t>(state_ >> 33);
    }
    double unit() { return next() / 2147483648.0; }

private:
    std::uint64_t state_;
};

std::size_t indexOf(const VoxelGrid& grid, std::size_t i, std::size_t j, std::size_t k);

/// Calls visit(index, low corner in cell units) for every cell.
template <typename Visit> void forEachCell(const VoxelGrid& grid, const Visit& visit) {
    for (std::uint32_t k = 0; k < grid.cells[2]; ++k)
        for (std::uint32_t j = 0; j < grid.cells[1]; ++j)
            for (std::uint32_t i = 0; i < grid.cells[0]; ++i) visit(indexOf(grid, i, j, k), Vector3(i, j, k));
}

/// Indices of the cells in which the corners and 27 other points of each triangle lie.
std::vector<std::size_t> cellsOfSurfaceSamples(const TriangleMesh& mesh, const VoxelGrid& grid);

} // namespace sinew::mesh::test
