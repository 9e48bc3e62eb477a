// Scenes of balls for tests of contacts.
#pragma once

#include "sinew/scene.hpp"

#include <Eigen/Core>
#include <vector>

namespace sinew::test {

inline constexpr float ballRadius = 0.05f; ///< [m]

/// A ball of `mass` [kg]; planes stop it at its radius.
sim::Particle ballAt(const sim::Vec3& position, const sim::Vec3& velocity = {}, float mass = 1);
/// A ball that never moves.
sim::Particle fixedBallAt(const sim::Vec3& position);
/// A scene without gravity.
sim::Scene weightless();
/// Adds side^3 balls around `center`, `pitch` apart, each displaced by up to `off` [m] along each axis.
void addBalls(sim::Scene& scene, std::uint32_t side, float pitch, float off, const sim::Vec3& center = {});

/// Deepest overlap of a pair of balls [radii].
double deepestOf(const std::vector<Eigen::Vector3d>& x);
Eigen::Vector3d momentumOf(const sim::Scene& scene, const std::vector<Eigen::Vector3d>& v); ///< [kg m/s]

} // namespace sinew::test
