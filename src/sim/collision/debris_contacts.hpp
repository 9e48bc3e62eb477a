// Contacts of debris (Scene::debris): pieces that were removed touch nothing.
#pragma once

#include "sim/collision/hash_grid.hpp"

namespace sinew::sim::collision {

/// Registers a grid of contacts, which debris leaves when they are removed. `radii` by state slot: of the
/// particles in the grid, or of those that touch them. Nothing where the scene keeps all pieces.
void letDebrisLeave(ProgramBuilder& program, BufferId radii, const hash_grid::Grid& grid);

} // namespace sinew::sim::collision
