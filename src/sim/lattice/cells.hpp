// The filled cells of a grid with their corner particles: the elements of volume energies.
#pragma once

#include "common/layout.h"
#include "sinew/scene.hpp"

#include <span>
#include <vector>

namespace sinew::sim::lattice {

struct Cell {
    std::array<std::uint32_t, 8>
        corners{};   ///< particles; corner k has the offset (k & 1, k >> 1 & 1, k >> 2)
    double fill = 0; ///< above 0, at most 1
};

/// Calls visit(cell) for every filled cell of a lattice (not of a sheet), x fastest. All corners of a filled
/// cell must be particles, which check_grid ensures.
template <typename Visit> void forEachCell(const Grid& grid, const Visit& visit) {
    const auto [nx, ny, nz] = grid.nodes;
    std::vector<std::uint32_t> particle(std::size_t{nx} * ny * nz);
    for (std::uint32_t i = 0; i < grid.node.size(); ++i) particle[grid.node[i]] = grid.firstParticle + i;
    std::size_t index = 0;
    for (std::uint32_t z = 0; z + 1 < nz; ++z)
        for (std::uint32_t y = 0; y + 1 < ny; ++y)
            for (std::uint32_t x = 0; x + 1 < nx; ++x, ++index) {
                if (grid.fill[index] == 0) continue;
                Cell cell{.fill = grid.fill[index] / double{LATTICE_FULL}};
                for (std::uint32_t k = 0; k < 8; ++k)
                    cell.corners[k] =
                        particle[x + (k & 1) + nx * (y + (k >> 1 & 1) + std::size_t{ny} * (z + (k >> 2)))];
                visit(cell);
            }
}

/// Initial positions of particles [m]: those of the scene, except for corners of cells collapsed to a line or
/// a point. In these, neither links nor volumes define a direction, so movable corners are displaced by up to
/// a thousandth of a cell along each axis, by a hash of their index. `inverseMass` is taken after fixed
/// constraints.
std::vector<Vec3> startingPositions(const Scene& scene, std::span<const float> inverseMass);

} // namespace sinew::sim::lattice
