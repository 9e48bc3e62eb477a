// Stages: hull, then core, then fill. All geometry is in double and in cell units; each stage is a loop over
// cells that queries CellOverlap (hull) or Inside (core, fill).
#include "mesh/voxelise.hpp"

#include "mesh/hull.hpp"
#include "mesh/inside.hpp"
#include "mesh/place_grid.hpp"

#include <cmath>

namespace sinew::mesh {
namespace {

constexpr std::uint32_t fillSamples = 4; ///< per cell edge

std::size_t indexOf(const VoxelGrid& grid, std::size_t i, std::size_t j, std::size_t k) {
    return i + grid.cells[0] * (j + std::size_t{grid.cells[1]} * k);
}

void markHull(VoxelGrid& grid, const std::vector<Vector3>& positions, const TriangleMesh& mesh) {
    const Eigen::Array3i last(static_cast<int>(grid.cells[0]) - 1, static_cast<int>(grid.cells[1]) - 1,
                              static_cast<int>(grid.cells[2]) - 1);
    for (const auto& [a, b, c] : mesh.triangles) {
        const CellOverlap overlap(positions[a], positions[b], positions[c]);
        const auto range = overlap.range();
        const Eigen::Array3i low = range[0].max(0), high = range[1].min(last);
        for (int k = low.z(); k <= high.z(); ++k)
            for (int j = low.y(); j <= high.y(); ++j)
                for (int i = low.x(); i <= high.x(); ++i)
                    if (Voxel& voxel = grid.voxels[indexOf(grid, i, j, k)];
                        voxel == Voxel::empty && overlap.touches(Vector3(i, j, k)))
                        voxel = Voxel::hull;
    }
}

Inside::Answer fillCell(VoxelGrid& grid, std::size_t index, const std::array<std::uint32_t, 3>& cell,
                        const Inside& samples) {
    std::uint32_t count = 0;
    bool isDoubtful = false;
    for (std::uint32_t z = 0; z < fillSamples; ++z)
        for (std::uint32_t y = 0; y < fillSamples; ++y)
            for (std::uint32_t x = 0; x < fillSamples; ++x) {
                const Inside::Answer answer = samples(
                    {fillSamples * cell[0] + x, fillSamples * cell[1] + y, fillSamples * cell[2] + z});
                count += answer.isInside ? 1 : 0;
                isDoubtful = isDoubtful || answer.isDoubtful;
            }
    grid.fill[index] = static_cast<float>(count) / (fillSamples * fillSamples * fillSamples);
    return {count > 0, isDoubtful};
}

void markCoreAndFill(VoxelGrid& grid, const Inside& centers, const Inside& samples) {
    double cells = 0; // filled cells, as a sum of shares
    for (std::uint32_t k = 0; k < grid.cells[2]; ++k)
        for (std::uint32_t j = 0; j < grid.cells[1]; ++j)
            for (std::uint32_t i = 0; i < grid.cells[0]; ++i) {
                const std::size_t index = indexOf(grid, i, j, k);
                const bool isHull = grid.voxels[index] == Voxel::hull;
                const Inside::Answer answer =
                    isHull ? fillCell(grid, index, {i, j, k}, samples) : centers({i, j, k});
                grid.doubtful += answer.isDoubtful ? 1 : 0;
                grid.hullCount += isHull ? 1 : 0;
                if (!isHull && answer.isInside) {
                    grid.voxels[index] = Voxel::core;
                    grid.fill[index] = 1;
                    ++grid.coreCount;
                }
                cells += double{grid.fill[index]};
            }
    grid.filledVolume = cells * std::pow(double{grid.spacing}, 3);
}

} // namespace

VoxelGrid voxelise(const TriangleMesh& mesh, const VoxelRequest& request) {
    auto [clean, grid, positions] = placeGrid(mesh, request);
    markHull(grid, positions, clean);
    const TriangleTree tree(positions, clean.triangles);
    const Inside centers(positions, clean.triangles, tree, grid.cells, 1);
    const Inside samples(positions, clean.triangles, tree, grid.cells, fillSamples);
    markCoreAndFill(grid, centers, samples);
    grid.workBytes = positions.size() * sizeof(Vector3) + tree.bytes() + centers.bytes() + samples.bytes();
    return grid;
}

std::vector<float> signedDistance(const TriangleMesh& mesh, const std::vector<Vec3>& points) {
    MeshDefects defects;
    const TriangleMesh clean = orient(weld(mesh, defects));
    std::vector<Vector3> positions;
    positions.reserve(clean.positions.size());
    for (const Vec3& position : clean.positions) positions.push_back(toVector(position));
    const TriangleTree tree(positions, clean.triangles);
    std::vector<float> distances;
    distances.reserve(points.size());
    for (const Vec3& point : points) {
        const double distance = tree.distance(toVector(point));
        const bool isInside = std::abs(tree.windingNumber(toVector(point))) > 0.5;
        distances.push_back(static_cast<float>(isInside ? -distance : distance));
    }
    return distances;
}

} // namespace sinew::mesh
