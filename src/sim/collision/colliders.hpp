// Spheres, capsules and boxes on the device: one pass that ends a substep, after contacts, attachments and
// tethers, the same for every solver. Where they move, a pass at the head of a step places them for all of
// its substeps. Pokes are the first of them; the host says which are there, and what only they need runs for
// no group while none is. A scene without colliders, and settings without pokes, have nothing of it.
#pragma once

#include "layout.h"
#include "sim/compile.hpp"

namespace sinew::sim::collision::colliders {

struct Colliders {
    std::uint32_t count = 0;     ///< pokes among them
    std::uint32_t pokes = 0;     ///< so many, the first
    std::uint32_t particles = 0; ///< slots of the state
    std::uint32_t placed = 0;    ///< poses of a substep: of colliders, then of driven bodies
    bool areMoving = false;      ///< any of those
    bool hasRebound = false;
    BufferId shapes;        ///< of colliders; after them balls around driven bodies
    BufferId pokeArguments; ///< of passes that only pokes need; invalid without
    BufferId poses, contactOffsets, before;
    BufferId ways; ///< of this step, from and to; invalid unless areMoving
};

/// Adds the pass that places them and driven bodies: call it once, before the substeps.
Colliders add(ProgramBuilder& program, const Scene& scene, const Settings& settings,
              const StateLayout& layout);

/// `split` and `jacobi`: room for what addOpening() keeps; only where something rebounds there is anything.
void addMemory(ProgramBuilder& program, Colliders& colliders);
/// Before the links of a substep.
void addOpening(ProgramBuilder& program, const ParticleBuffers& particles, const Colliders& colliders,
                bool isFirst);
/// The end of that substep, which counts from 0. `predicted`: particles before contacts with each other; none
/// where they touch nothing else.
void addPass(ProgramBuilder& program, const ParticleBuffers& particles, const Colliders& colliders,
             std::uint32_t substep, Kick kick, const ParticleBuffers* predicted = nullptr);
/// The same in a substep of `gauss_seidel`, which is still open: what moves are the `corrections`.
void addOpenPass(ProgramBuilder& program, const ParticleBuffers& particles, BufferId corrections,
                 const Colliders& colliders, std::uint32_t substep);

} // namespace sinew::sim::collision::colliders
