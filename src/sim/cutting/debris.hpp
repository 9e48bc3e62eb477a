// Fragments (Scene::debris): pieces with so few particles that they are removed. They stay in the solver's
// state, with mass and momentum, but no particle, face or edge touches them, no grab holds them and no count
// includes them: their particles have the piece REMOVED_PIECE, from the step on that cut them off. The
// buffers that mark them belong to the topology, so that an undo restores them.
//
//   publish   remove_debris, clear_debris_sizes   after pieces were found again
//             remove_debris_contacts                 for every grid of contacts
//             release_debris, put_debris_to_sleep       if there may be grabs; if bodies may sleep
//             hide_debris_triangles           of skins that are not clipped
//   skin      hide_debris, hide_debris_surface, hide_debris_sheet   other vertices collapse to a point
#pragma once

#include "sim/cutting/cut_plan.hpp"
#include "sim/model/state.hpp"

namespace sinew::sim::cutting {

/// Adds the buffers of fragments, after those of cuts. Nothing if the scene keeps all pieces.
void addDebris(ProgramBuilder& program, const Scene& scene, Cut& cut, const ParticleBuffers& particles);

/// Appends the removal of fragments, after everything that follows from new pieces. Nothing if the scene
/// keeps all pieces.
void addDebrisRemoval(ProgramBuilder& program, const Cut& cut, const ParticleBuffers& particles);

} // namespace sinew::sim::cutting
