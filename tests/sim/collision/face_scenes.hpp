// Cloth that touches meshes, other cloth and itself, for tests of contacts with faces, and what is wrong with
// where it is.
#pragma once

#include "sim/bodies.hpp"
#include "sim/scene.hpp"

#include <Eigen/Core>
#include <vector>

namespace sinew::test {

/// A sheet that falls onto a ball of triangles.
sim::Scene clothOnBall();
/// A sheet that stands upright and falls onto itself.
sim::Scene fallingFold();
/// Square sheets of side^2 particles over each other, `pitch` apart and 0.01 m thick, above a floor.
sim::Scene stackOfLayers(std::uint32_t count, std::uint32_t side, float pitch);
/// A coarse sheet above a box of twelve triangles, whose edges lie aslant below it: it falls onto ridges that
/// none of its particles may be near.
sim::Scene clothOnBox(float spacing);
/// A coarse sheet above another one that is held at two sides, turned against it.
sim::Scene crossedSheets(float spacing);
/// A strip whose two ends are attached to anchors, without gravity.
sim::Scene strip(float thickness);
/// Anchors of a strip of which both ends have turned by `angle` [rad] in opposite ways and come nearer by
/// `way` [m] each.
std::vector<sim::Vec3> twistedEnds(const sim::Scene& strip, double angle, double way);

/// Edges of faces that pass through faces they share no corner with.
int intersections(const sim::Scene& scene, const std::vector<Eigen::Vector3d>& x);
/// Root mean square of the lengths.
double rms(const std::vector<Eigen::Vector3d>& v);

} // namespace sinew::test
