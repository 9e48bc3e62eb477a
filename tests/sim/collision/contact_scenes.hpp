// Balls that touch, for tests of contacts.
#pragma once

#include "sim/scene.hpp"

#include <Eigen/Core>
#include <vector>

namespace sinew::test {

inline constexpr float ballRadius = 0.05f; ///< [m]

/// A ball of `mass` [kg] that planes hold at its radius.
sim::Particle ballAt(const sim::Vec3& position, const sim::Vec3& velocity = {}, float mass = 1);
/// One that never moves.
sim::Particle fixedBallAt(const sim::Vec3& position);
/// Without gravity.
sim::Scene weightless();
/// side^3 balls, `pitch` apart, each up to `off` [m] off its place along each axis, around `center`.
void addBalls(sim::Scene& scene, std::uint32_t side, float pitch, float off, const sim::Vec3& center = {});

/// How much of two radii the deepest pair of balls overlaps by [radii].
double deepestOf(const std::vector<Eigen::Vector3d>& x);
Eigen::Vector3d momentumOf(const sim::Scene& scene, const std::vector<Eigen::Vector3d>& v); ///< [kg m/s]

} // namespace sinew::test
