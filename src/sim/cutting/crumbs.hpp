// Crumbs (Scene::crumbs): pieces that have so few particles that they are removed. They stay in the solver's
// state, with mass and momentum, but no particle, face or edge touches them, no hand holds them and nothing
// counts them: the piece of their particles is REMOVED_PIECE, from the step on whose cut has made them. What
// says so belongs to the topology, so that an undo brings them back.
//
//   publish   remove_crumbs, forget_crumbs   after pieces were found anew
//             leave_contacts                 for every grid of contacts
//             drop_crumbs, rest_crumbs       where there may be hands; where bodies may sleep
//             hide_crumb_triangles           of skins that are not clipped
//   skin      hide_crumbs, hide_crumb_surface, hide_crumb_sheet   other vertices shrink to a point
#pragma once

#include "sim/cutting/cut_plan.hpp"

namespace sinew::sim::collision::hash_grid {
struct Grid;
}

namespace sinew::sim::cutting {

/// After the buffers of cuts. Nothing where the scene keeps all pieces.
void addCrumbs(ProgramBuilder& program, const Scene& scene, Cut& cut, const ParticleBuffers& particles);

/// When pieces were found anew, after all that is made of them. Likewise.
void addCrumbRemoval(ProgramBuilder& program, const Cut& cut, const ParticleBuffers& particles);

/// Where contacts are made: `radii` by state slot say who is in the grid, or touches what is in it. Likewise.
void letCrumbsLeave(ProgramBuilder& program, BufferId radii, const collision::hash_grid::Grid& grid);

} // namespace sinew::sim::cutting
