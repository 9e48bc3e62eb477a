// Driven bodies: particles that go along a path, set after the links of a substep and before its contacts,
// which they push and carry as something that never gives way. A scene in which none moves has no such pass.
#pragma once

#include "sim/collision/colliders.hpp"
#include "sim/compile.hpp"

namespace sinew::sim::constraints::driven {

struct Driven {
    std::uint32_t count = 0; ///< particles
    std::uint32_t row = 0;   ///< poses of a substep
    BufferId particles, poses;
};

/// `placed` has the poses of colliders and, after them, driven bodies.
Driven add(ProgramBuilder& program, const Scene& scene, const StateLayout& layout,
           const collision::colliders::Colliders& placed);

/// Where a substep, counted from 0, ends for them.
void addPass(ProgramBuilder& program, const ParticleBuffers& particles, const Driven& driven,
             std::uint32_t substep);

/// All particles of bodies that move.
std::vector<bool> areDriven(const Scene& scene);

} // namespace sinew::sim::constraints::driven
