// Converts a closed (or nearly closed) surface to filled cells of a cubic grid, in two stages: the hull
// (every cell that a triangle touches), then the core (every other cell whose centre lies inside).
#pragma once

#include "mesh/triangle_mesh.hpp"

#include <functional>

namespace sinew::mesh {

enum class Voxel : std::uint8_t { empty, hull, core };

struct VoxelGrid {
    Vec3 origin;                          ///< low corner of cell (0, 0, 0) [m]
    float spacing = 0;                    ///< edge of a cell [m]
    std::array<std::uint32_t, 3> cells{}; ///< grid size; every cell on the rim is empty or hull
    std::vector<Voxel> voxels;            ///< x fastest
    std::vector<float> fill;              ///< share of a cell inside the surface, [0, 1]; x fastest
    std::size_t hullCount = 0, coreCount = 0;
    std::size_t doubtful =
        0; ///< cells where the votes along x, y and z disagreed, so that the winding number decided
    double filledVolume = 0;   ///< sum of fill x cell volume [m^3]
    std::size_t workBytes = 0; ///< memory used for filling, besides the two arrays above
};

struct VoxelRequest {
    float spacing = 0;                 ///< [m]; 0 = chosen so that the longest side has `resolution` cells
    std::uint32_t resolution = 24;     ///< cells along the longest side if spacing is 0
    std::size_t maxCells = 16'777'216; ///< in the whole grid; more throws std::length_error with both figures
};

/// Hull by the separating-axis test in Schwarz-Seidel form (2010), conservative. Core by parity along three
/// axes at cell centres; where the votes differ, by the generalised winding number (Jacobson 2013), |w| >
/// 0.5. The fill of a hull cell is sampled at 4 x 4 x 4 points in the same way. Works on open meshes;
/// `doubtful` measures its reliability.
VoxelGrid voxelise(const TriangleMesh& mesh, const VoxelRequest& request);

/// Edge of the cells of the grid that a request gives for a mesh [m].
float cellEdge(const TriangleMesh& mesh, const VoxelRequest& request);

/// Number of particles of a body with this grid: the corners of its hull and core cells.
std::size_t particleCount(const VoxelGrid& grid);

/// A voxeliser: voxelise(), or that of a device (mesh/gpu/voxelise.hpp).
using Voxelise = std::function<VoxelGrid(const TriangleMesh&, const VoxelRequest&)>;

/// The finest grid with at most `most` particles, by cells along the longest side: one cell more would give
/// too many, or there are 512. Fills several grids on the way; ignores spacing and resolution of the request.
/// Throws std::length_error if a single cell has too many.
VoxelGrid voxeliseWithin(std::size_t most, const TriangleMesh& mesh, VoxelRequest request,
                         const Voxelise& voxelise);

/// Signed distance [m] from each given point to the surface: negative inside (by the winding number).
std::vector<float> signedDistance(const TriangleMesh& mesh, const std::vector<Vec3>& points);

} // namespace sinew::mesh
