// Spheres, capsules and boxes on the device: one pass at the end of a substep, after contacts, attachments
// and tethers, the same for every solver. If any of them moves, a pass at the start of a step computes their
// poses for all its substeps. Host colliders come first among them; the host says which are present, and
// passes that only host colliders need run for no group while none is. A scene without colliders, with
// settings without host colliders, has none of these passes.
#pragma once

#include "common/layout.h"
#include "sim/model/feature.hpp"

namespace sinew::sim::rigid::colliders {

struct Colliders {
    std::uint32_t count = 0;         ///< host colliders included
    std::uint32_t hostColliders = 0; ///< the first of them
    std::uint32_t particles = 0;     ///< slots of the state
    std::uint32_t placed = 0;        ///< poses of a substep: colliders, then driven bodies
    bool areMoving = false;          ///< whether any of these poses can change
    bool hasRebound = false;
    BufferId shapes; ///< of colliders, then spheres around driven bodies
    BufferId
        hostColliderArguments; ///< of passes that only host colliders need; invalid without host colliders
    BufferId poses, contactOffsets, before;
    BufferId near = unbound; ///< by work group: near_colliders.glsl; only of many colliders
    BufferId ways;           ///< start and end poses in this step; invalid unless areMoving
};

/// Keeps Colliders, and appends the pass that computes the poses of colliders and driven bodies.
void add(Build& build);
/// Appends the pass before the links of a substep; only if something has restitution, and not in
/// `gauss_seidel`.
void addSaving(Build& build, const Substep& substep);
/// Appends the end of that substep.
void addPass(Build& build, const Substep& substep);

} // namespace sinew::sim::rigid::colliders
