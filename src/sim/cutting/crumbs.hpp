// Crumbs (Scene::crumbs): pieces of bodies of voxels that have so few particles that they are removed. They
// stay in the solver's state, with mass and momentum, but no particle, face or edge touches them and nothing
// counts them: the piece of their particles is NO_PARTICLE, from the step on whose cut has made them. What
// says so belongs to the topology, so that an undo brings them back.
//
//   publish   remove_crumbs, forget_crumbs   after pieces were found anew
//             leave_contacts                 for every grid of contacts
//   skin      hide_crumbs, hide_crumb_surface   their vertices shrink to a point
#pragma once

#include "sim/cutting/cut_plan.hpp"

namespace sinew::sim::collision::hash_grid {
struct Grid;
}

namespace sinew::sim::cutting {

/// After the buffers of cuts. Nothing where the scene keeps all pieces or has no body of voxels to cut.
void addCrumbs(ProgramBuilder& program, const Scene& scene, const Cut& cut, const StateLayout& layout);

/// When pieces were found anew, after all that is made of them. Likewise.
void addCrumbRemoval(ProgramBuilder& program, const Cut& cut);

/// Where contacts are made: `radii` by state slot say who is in the grid, or touches what is in it. Likewise.
void letCrumbsLeave(ProgramBuilder& program, BufferId radii, const collision::hash_grid::Grid& grid);

} // namespace sinew::sim::cutting
