// How much stiffness meets in each particle, by directions: the clamp of Settings::hasSharpClamp
// (docs/clamp.md).
#pragma once

#include "sim/stiffness/shares.hpp"

#include <array>
#include <span>
#include <vector>

namespace sinew::sim::stiffness {

/// A symmetric 3 x 3 matrix: xx, yy, zz, xy, xz, yz.
using Symmetric = std::array<double, 6>;

/// The largest eigenvalue of a matrix without negative ones, or up to 0.5 % more: as kernels compute it
/// (shaders/glsl/solvers/directed_clamp.glsl).
double largestEigenvalue(const Symmetric& matrix);

/// The largest eigenvalue of the sum over a particle's links of k~ (a n n^T + (1 - a) I), a = min(1, rest
/// length / length), and of k~ I over its cells [N/m]; by particle.
/// - atRest: with links of grids in the directions of their grid and all others as they are in the scene, at
///   rest length.
/// - atStart: as the scene places the particles, with the share of recovery of cells.
struct Bearing {
    std::vector<double> atRest, atStart;
};
Bearing bearingOf(const Scene& scene, std::span<const float> shares, std::span<const CellShares> cells);

} // namespace sinew::sim::stiffness
