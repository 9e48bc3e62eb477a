// The largest resolution for a number of particles: their number grows with a power of it between 2 (a shell)
// and 3, estimated from the last two grids.
#include "mesh/voxelise.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace sinew::mesh {
namespace {

constexpr std::uint32_t finest = 512; ///< cells along the longest side, as in scene files
constexpr std::uint32_t firstGuess = 12;
constexpr int mostGuesses = 6; ///< after that, bisection

/// A voxelised grid: cells along the longest side, and number of particles.
struct Trial {
    std::uint32_t resolution = 0;
    double particles = 0;
};

/// Resolution at which the power law through two trials reaches `most`.
double guess(const Trial& last, const Trial& before, double most) {
    double power = 3;
    if (before.particles > 0 && before.resolution != last.resolution)
        power = std::clamp(std::log(last.particles / before.particles) /
                               std::log(static_cast<double>(last.resolution) / before.resolution),
                           1.0, 3.0);
    return last.resolution * std::pow(most / last.particles, 1 / power);
}

} // namespace

std::size_t particleCount(const VoxelGrid& grid) {
    const auto [x, y, z] = grid.cells;
    std::vector<bool> isCorner(std::size_t{x + 1} * (y + 1) * (z + 1));
    std::size_t cell = 0, count = 0;
    for (std::size_t k = 0; k < z; ++k)
        for (std::size_t j = 0; j < y; ++j)
            for (std::size_t i = 0; i < x; ++i) {
                if (grid.voxels[cell++] == Voxel::empty) continue;
                for (std::size_t corner = 0; corner < 8; ++corner) {
                    const std::size_t index =
                        i + (corner & 1) + (x + 1) * (j + (corner >> 1 & 1) + (y + 1) * (k + (corner >> 2)));
                    count += isCorner[index] ? 0 : 1;
                    isCorner[index] = true;
                }
            }
    return count;
}

VoxelGrid voxeliseWithin(std::size_t most, const TriangleMesh& mesh, VoxelRequest request,
                         const Voxelise& voxelise) {
    VoxelGrid best;
    Trial last, before;
    std::uint32_t low = 0, high = finest + 1; // `low` fits, `high` does not
    double next = firstGuess;
    request.spacing = 0;
    for (int trial = 0; high - low > 1; ++trial) {
        if (!(next >= 0 && next < finest) || trial >= mostGuesses) next = (low + high) / 2;
        request.resolution = std::clamp(static_cast<std::uint32_t>(next), low + 1, high - 1);
        try {
            VoxelGrid grid = voxelise(mesh, request);
            before = last;
            last = {request.resolution, static_cast<double>(particleCount(grid))};
            if (last.particles <= static_cast<double>(most)) {
                low = request.resolution;
                best = std::move(grid);
            } else {
                high = request.resolution;
            }
            next = guess(last, before, static_cast<double>(most));
        } catch (const std::length_error&) { // more cells than request.maxCells
            high = request.resolution;
            next = (low + high) / 2;
        }
    }
    if (low == 0)
        throw std::length_error("voxelise: even one cell along the longest side makes more than " +
                                std::to_string(most) + " particles");
    return best;
}

} // namespace sinew::mesh
