// Voxel bodies for tests of their faces, and selections of their particles.
#pragma once

#include "sinew/bodies.hpp"

#include <functional>
#include <vector>

namespace sinew::test {

inline constexpr float facedSpacing = 0.05f; ///< [m]

/// A lattice whose particles' contact distance is that of neighbours; `youngModulus` [Pa].
sim::Lattice facedLattice(std::array<std::uint32_t, 3> cells, float youngModulus, bool isCuttable);

/// Particles whose scene positions satisfy `isIn`.
std::vector<std::uint32_t> particlesWhere(const sim::Scene& scene,
                                          const std::function<bool(const sim::Vec3&)>& isIn);

/// A pose with a rotation by `turn` [rad] about x.
sim::Pose poseAt(const sim::Vec3& position, double turn = 0);

} // namespace sinew::test
