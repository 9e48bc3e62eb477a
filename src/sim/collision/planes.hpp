// Boundary planes: temporary constraints that need no search. Fused into the gather of `split` and the
// pass between two substeps of `gauss_seidel`; passes of their own in `jacobi`. A scene without planes gets
// neither.
#pragma once

#include "layout.h"
#include "sim/compile.hpp"

namespace sinew::sim::collision::planes {

/// The constant data of all planes, for any solver. `count` 0 = the scene has none and no buffer exists.
struct Colliders {
    std::uint32_t count = 0;
    BufferId planes, contactOffsets;
    ProgramBuilder::Constants constants() const; ///< specialises planeCount
};
Colliders addColliders(ProgramBuilder& program, const Scene& scene, const StateLayout& layout);

/// The pass of `gauss_seidel` between two sweeps of a substep.
void addTouch(ProgramBuilder& program, const ParticleBuffers& particles, BufferId corrections,
              const Colliders& colliders);

/// What `jacobi` keeps of them within a substep.
struct Contacts {
    Colliders colliders;
    BufferId contacts;
};
Contacts addContacts(ProgramBuilder& program, const Scene& scene);
void addOpen(ProgramBuilder& program, const ParticleBuffers& particles, const Contacts& contacts);
void addSolve(ProgramBuilder& program, const ParticleBuffers& particles, const Contacts& contacts);
/// The velocity update of `jacobi`: damping, and restitution where there are planes.
void addVelocityUpdate(ProgramBuilder& program, const ParticleBuffers& particles, const Contacts& contacts);

} // namespace sinew::sim::collision::planes
