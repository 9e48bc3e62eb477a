// Gaps between particles and the surface of cut or whole voxel bodies, computed on the host from live links
// and positions.
#pragma once

#include "sim/cutting/cut_body.hpp"

#include <functional>

namespace sinew::test {

using Triangle = std::array<std::uint32_t, 3>; // of particles

double distanceTo(const Eigen::Vector3d& p, const std::array<Eigen::Vector3d, 3>& triangle);

/// Deepest overlap between particles and triangles that are each half a voxel thick [voxels]; below 0 without
/// contact. `areApart` selects the pairs.
double deepest(double voxel, const std::vector<Eigen::Vector3d>& x, const std::vector<Triangle>& surface,
               const std::function<bool(std::uint32_t, const Triangle&)>& areApart);

/// Triangles of all squares with an intact cell on one side only, counter-clockwise seen from the other side.
/// A cell is intact with all of its links.
std::vector<Triangle> surfaceOf(const CutBody& body);

} // namespace sinew::test
