// The path of a point through a moving triangle, and of two edges through each other, in double precision: an
// independent judge of what has passed.
#pragma once

#include <Eigen/Core>
#include <array>

namespace sinew::test {

using Corners = std::array<Eigen::Vector3d, 3>;

/// Whether a point and a triangle, whose corners and the point each move in a straight line in the same time,
/// pass through each other.
bool passesThrough(const Eigen::Vector3d& from, const Eigen::Vector3d& to, const Corners& before,
                   const Corners& after);

/// The ends of two edges.
using Ends = std::array<Eigen::Vector3d, 4>;

/// Whether two edges, whose ends each move in a straight line in the same time, pass through each other.
bool edgesPass(const Ends& before, const Ends& after);

} // namespace sinew::test
