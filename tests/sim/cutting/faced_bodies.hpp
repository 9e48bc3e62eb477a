// Voxel bodies as tests of their faces have them, and which of their particles move.
#pragma once

#include "sim/bodies.hpp"

#include <functional>
#include <vector>

namespace sinew::test {

inline constexpr float facedSpacing = 0.05f; ///< [m]

/// Particles that touch at the distance of neighbours; `youngModulus` [Pa].
sim::Lattice facedLattice(std::array<std::uint32_t, 3> cells, float youngModulus, bool isCuttable);

/// Those whose places in the scene `isIn` takes.
std::vector<std::uint32_t> particlesWhere(const sim::Scene& scene,
                                          const std::function<bool(const sim::Vec3&)>& isIn);

/// Turned by `turn` [rad] about x.
sim::Pose poseAt(const sim::Vec3& position, double turn = 0);

} // namespace sinew::test
