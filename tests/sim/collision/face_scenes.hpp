// Scenes of cloth in contact with meshes, with other cloth and with itself; and a count of its intersections.
#pragma once

#include "sinew/bodies.hpp"
#include "sinew/scene.hpp"

#include <Eigen/Core>
#include <vector>

namespace sinew::test {

/// A sheet that falls onto a ball of triangles.
sim::Scene clothOnBall();
/// An upright sheet that falls onto itself.
sim::Scene fallingFold();
/// Square sheets of side^2 particles above each other, `pitch` apart and 0.01 m thick, above a floor.
sim::Scene stackOfLayers(std::uint32_t count, std::uint32_t side, float pitch);
/// A coarse sheet that falls onto a box of twelve triangles with slanted edges. The edges may be far from all
/// particles of the sheet.
sim::Scene clothOnBox(float spacing);
/// A coarse sheet above another, rotated one that is held at two sides.
sim::Scene crossedSheets(float spacing);
/// A strip without gravity; both of its ends are attached to anchors.
sim::Scene strip(float thickness);
/// Anchors of a strip whose ends have turned by `angle` [rad] in opposite directions and moved inward by
/// `way` [m] each.
std::vector<sim::Vec3> twistedEnds(const sim::Scene& strip, double angle, double way);

/// Number of intersections of face edges with faces that share no corner with them.
int intersections(const sim::Scene& scene, const std::vector<Eigen::Vector3d>& x);
/// Root mean square of the vectors' lengths.
double rms(const std::vector<Eigen::Vector3d>& v);

} // namespace sinew::test
