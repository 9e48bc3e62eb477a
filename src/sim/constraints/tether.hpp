// Tethers (long-range attachments) on the device: one pass after the links of a substep, the same for every
// solver.
#pragma once

#include "common/layout.h"
#include "sim/model/scene_model.hpp"

namespace sinew::sim::constraints::tether {

struct Tethers {
    std::uint32_t count = 0; ///< tethered particles that move
    BufferId particles, tethers;
};

Tethers add(ProgramBuilder& program, const SceneModel& model);
void addPass(ProgramBuilder& program, const ParticleBuffers& particles, const Tethers& tethers);
/// The same inside a substep of `gauss_seidel`: the pass changes `corrections`, not velocities.
void addOpenPass(ProgramBuilder& program, const ParticleBuffers& particles, BufferId corrections,
                 const Tethers& tethers);

} // namespace sinew::sim::constraints::tether
