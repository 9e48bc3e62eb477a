// Particles in the inside of voxel bodies with faces. Their surface is closed, so nothing reaches them, and
// they take no part in contacts until a cut lays them open.
#pragma once

#include "sim/collision/hash_grid.hpp"

#include <vector>

namespace sinew::sim::collision::insides {

/// By particle: whether it has filled cells all around it in a body with solid faces.
std::vector<bool> find(const Scene& scene);

/// A copy of `radii` by state slot with -1 for such particles; below 0 = touches nothing.
std::vector<float> closed(std::span<const float> radii, const std::vector<bool>& isInside,
                          const StateLayout& layout);

/// Before the substeps of a step with a cut: who has a cell beside it that is no longer whole gets the radius
/// that it has in `open`, by state slot; who has none any more loses it. `radii` is a buffer of `grid`.
/// Nothing where no body may be cut.
void addOpening(ProgramBuilder& program, BufferId radii, std::span<const float> open,
                const hash_grid::Grid& grid);

} // namespace sinew::sim::collision::insides
