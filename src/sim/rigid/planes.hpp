// Boundary planes: temporary constraints without a search. They are fused into the gather of `split` and into
// the pass between two substeps of `gauss_seidel`; `jacobi` has passes for them. A scene without planes has
// none of these.
#pragma once

#include "common/layout.h"
#include "sim/model/state.hpp"

namespace sinew::sim::rigid::planes {

/// Constant data of all planes, for any solver. `count` 0 = the scene has none and no buffer exists.
struct Planes {
    std::uint32_t count = 0;
    BufferId planes = unbound, contactOffsets = unbound;
    ProgramBuilder::Constants constants() const; ///< specialises planeCount
};
Planes add(ProgramBuilder& program, const Scene& scene, const StateLayout& layout);

/// The pass of `gauss_seidel` between two sweeps of a substep.
void addTouch(ProgramBuilder& program, const ParticleBuffers& particles, BufferId corrections,
              const Planes& planes);

/// Buffers of planes that `jacobi` needs within a substep.
struct Contacts {
    Planes planes;
    BufferId contacts = unbound;
};
Contacts addContacts(ProgramBuilder& program, const Scene& scene);
void addOpen(ProgramBuilder& program, const ParticleBuffers& particles, const Contacts& contacts);
void addSolve(ProgramBuilder& program, const ParticleBuffers& particles, const Contacts& contacts);
/// Appends the velocity update of `jacobi`: damping, and restitution if there are planes.
void addVelocityUpdate(ProgramBuilder& program, const ParticleBuffers& particles, const Contacts& contacts);

} // namespace sinew::sim::rigid::planes
