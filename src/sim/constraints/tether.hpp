// Tethers (long-range attachments) on the device: one pass after the links of a substep, the same for every
// solver.
#pragma once

#include "layout.h"
#include "sim/compile.hpp"

namespace sinew::sim::constraints::tether {

struct Tethers {
    std::uint32_t count = 0; ///< tethered particles that move
    BufferId particles, tethers;
};

/// Those of particles that move, sorted by particle: the order that the device has them in.
std::vector<Tether> inOrder(const Scene& scene);

Tethers add(ProgramBuilder& program, const Scene& scene, const StateLayout& layout);
void addPass(ProgramBuilder& program, const ParticleBuffers& particles, const Tethers& tethers);
/// The same in a substep of `gauss_seidel`, which is still open: what moves are the `corrections`.
void addOpenPass(ProgramBuilder& program, const ParticleBuffers& particles, BufferId corrections,
                 const Tethers& tethers);

} // namespace sinew::sim::constraints::tether
