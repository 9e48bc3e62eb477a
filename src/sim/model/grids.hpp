// The grids whose neighbours `split` computes, and their places in the state.
#pragma once

#include "sim/lattice/placement.hpp"
#include "sim/model/state.hpp"

#include <span>
#include <vector>

namespace sinew::sim {

/// Indices of the grids whose neighbours are computed, if the settings ask for it: those whose particles no
/// other constraint touches. Ascending.
std::vector<std::uint32_t> computedGrids(const Scene& scene, const Settings& settings);

/// Number of particles outside those grids; these come first in the state, in the order of the scene.
std::uint32_t listedParticles(const Scene& scene, std::span<const std::uint32_t> grids);

/// The box in the state of each of `grids`.
std::vector<lattice::Box> boxesOf(const Scene& scene, std::span<const std::uint32_t> grids);

/// The order of the particles, with the boxes of `grids`.
StateLayout layoutOf(const Scene& scene, std::span<const std::uint32_t> grids,
                     std::span<const lattice::Box> boxes);

} // namespace sinew::sim
