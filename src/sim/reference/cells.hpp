// Volume energies of a lattice's cells in double: energy, pressure, gradient and second derivative. A cell's
// volume is the determinant of its mean edges (scene.hpp). Used by all three references.
#pragma once

#include "sinew/scene.hpp"

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace sinew::sim::reference {

using Corners = std::array<Eigen::Vector3d, 8>;

struct Cell {
    std::array<std::uint32_t, 8> corners{}; ///< corner k has the offset (k & 1, k >> 1 & 1, k >> 2)
    std::size_t grid = 0;                   ///< index into Scene::grids
    double spacing = 0;                     ///< [m]
    double fill = 0;
    double stiffness = 0, recovery = 0; ///< of a full cell: lambda_v, full recovery pressure [Pa]

    double restVolume() const { return spacing * spacing * spacing; } ///< [m^3]
};

/// Every filled cell of the grids that have volumes.
std::vector<Cell> cellsOf(const Scene& scene);

Corners cornersOf(const Cell& cell, const std::vector<Eigen::Vector3d>& x);

/// The mean edges as columns [m].
Eigen::Matrix3d meanEdges(const Corners& x);

/// V / V0, negative if the cell is mirrored.
double volumeRatio(const Cell& cell, const Corners& x);

/// dV / dx of every corner [m^2].
Corners volumeGradient(const Corners& x);

/// d2V / dx_i dx_j [m].
Eigen::Matrix3d volumeHessian(const Eigen::Matrix3d& edges, std::size_t i, std::size_t j);

double energyOf(const Cell& cell, double ratio); ///< [J]
/// -dE / dV: positive if the cell tends to grow [Pa].
double pressureOf(const Cell& cell, double ratio);
/// -dp / dV [Pa / m^3]
double bulkStiffness(const Cell& cell, double ratio);

} // namespace sinew::sim::reference
