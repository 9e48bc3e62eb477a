// Gaps between particles and the surface of voxel bodies, cut or not, found on the host from live links and
// positions alone.
#pragma once

#include "sim/cutting/cut_body.hpp"

#include <functional>

namespace sinew::test {

using Triangle = std::array<std::uint32_t, 3>; // particles

double distanceTo(const Eigen::Vector3d& p, const std::array<Eigen::Vector3d, 3>& triangle);

/// How much nearer than touching a particle comes to a triangle, both as thick as half a voxel, in voxels;
/// below 0 = not as near. `areApart` says which pairs count.
double deepest(double voxel, const std::vector<Eigen::Vector3d>& x, const std::vector<Triangle>& surface,
               const std::function<bool(std::uint32_t, const Triangle&)>& areApart);

/// Halves of squares that have a cell with all of its links on one side alone, counter-clockwise seen from
/// the other.
std::vector<Triangle> surfaceOf(const CutBody& body);

} // namespace sinew::test
