// Size of the cells and position of the grid.
#include "mesh/place_grid.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace sinew::mesh {
namespace {

/// [cells] Least total extent of the grid beyond the mesh: covers the rounding of its origin.
constexpr double margin = 1e-4;
/// [cells] Space left along the longest side if its number of cells is given, so that sides of a half or a
/// tenth of it get whole numbers of cells too.
constexpr double slack = 0.04;

struct Bounds {
    Vector3 low, high;
    Vector3 size() const { return high - low; }
};

Bounds boundsOf(const TriangleMesh& mesh) {
    Bounds bounds{toVector(mesh.positions.front()), toVector(mesh.positions.front())};
    for (const Vec3& position : mesh.positions) {
        bounds.low = bounds.low.cwiseMin(toVector(position));
        bounds.high = bounds.high.cwiseMax(toVector(position));
    }
    return bounds;
}

float chooseSpacing(const Bounds& bounds, const VoxelRequest& request) {
    if (!(request.spacing >= 0) || !std::isfinite(request.spacing))
        throw std::invalid_argument(
            "voxelise: the spacing must be positive, or 0 to choose it by resolution");
    if (request.spacing > 0) return request.spacing;
    if (request.resolution == 0)
        throw std::invalid_argument("voxelise: the resolution must be at least 1 cell");
    const double longest = bounds.size().maxCoeff();
    return static_cast<float>(longest / std::max(request.resolution - slack, 0.5));
}

/// An empty grid centred on the mesh.
VoxelGrid makeGrid(const TriangleMesh& mesh, const VoxelRequest& request) {
    const Bounds bounds = boundsOf(mesh);
    VoxelGrid grid{.spacing = chooseSpacing(bounds, request)};
    const double spacing = double{grid.spacing};
    if (!(spacing > 0)) throw std::invalid_argument("voxelise: the mesh has no extent");
    const Vector3 needed = ((bounds.size() / spacing).array() + margin).ceil().cwiseMax(1);
    if (needed.prod() > static_cast<double>(request.maxCells))
        throw std::length_error("voxelise: cells of " + std::to_string(spacing) + " m make a grid of " +
                                std::to_string(static_cast<long long>(std::min(needed.prod(), 1e18))) +
                                " cells, the limit is " + std::to_string(request.maxCells) +
                                ": ask for larger cells");
    grid.origin = toVec3((bounds.low + bounds.high - needed * spacing) / 2);
    for (Eigen::Index axis = 0; axis < 3; ++axis) grid.cells[axis] = static_cast<std::uint32_t>(needed[axis]);
    grid.voxels.assign(static_cast<std::size_t>(needed.prod()), Voxel::empty);
    grid.fill.assign(grid.voxels.size(), 0);
    return grid;
}

/// Throws if a vertex is outside: far from the origin of coordinates, the grid's own origin is rounded.
void checkPlacement(const VoxelGrid& grid, const std::vector<Vector3>& positions) {
    const Vector3 size(grid.cells[0], grid.cells[1], grid.cells[2]);
    const bool isInside = std::ranges::all_of(positions, [&](const Vector3& position) {
        return (position.array() > 0).all() && (position.array() < size.array()).all();
    });
    if (!isInside)
        throw std::invalid_argument(
            "voxelise: the mesh lies too far from the origin for its size: move it closer");
}

} // namespace

float cellEdge(const TriangleMesh& mesh, const VoxelRequest& request) {
    return chooseSpacing(boundsOf(mesh), request);
}

std::vector<Vector3> toCellUnits(const TriangleMesh& mesh, const VoxelGrid& grid) {
    std::vector<Vector3> positions;
    positions.reserve(mesh.positions.size());
    for (const Vec3& position : mesh.positions)
        positions.push_back((toVector(position) - toVector(grid.origin)) / double{grid.spacing});
    return positions;
}

PlacedMesh placeGrid(const TriangleMesh& mesh, const VoxelRequest& request) {
    MeshDefects defects;
    PlacedMesh placed{.mesh = orient(weld(mesh, defects))};
    if (placed.mesh.triangles.empty()) throw std::invalid_argument("voxelise: the mesh has no triangles");
    placed.grid = makeGrid(placed.mesh, request);
    placed.positions = toCellUnits(placed.mesh, placed.grid);
    checkPlacement(placed.grid, placed.positions);
    return placed;
}

} // namespace sinew::mesh
