// The grids of a scene as `split` dispatches them: which are computed, where their particles are kept, and
// one dispatch for all grids of one shape and material.
#pragma once

#include "sim/compile.hpp"
#include "sim/lattice/placement.hpp"

namespace sinew::sim::lattice {

/// Indices of the grids whose neighbours are computed: those whose particles no other constraint touches, if
/// the settings want them so.
std::vector<std::uint32_t> computedGrids(const Scene& scene, const Settings& settings);

/// Particles outside those grids; they stand at the head of the state, in the order of the scene.
std::uint32_t listedParticles(const Scene& scene, std::span<const std::uint32_t> grids);

StateLayout layoutOf(const Scene& scene, std::span<const std::uint32_t> grids);

/// One dispatch of a substep.
struct Batch {
    bool isSheet = false, hasBodyDiagonals = false;
    layout::LatticePush push{};               ///< count = chunks
    std::vector<layout::LatticeChunk> chunks; ///< padded to whole work groups with empty ones
};

struct Batches {
    std::vector<Batch> batches;
    std::vector<std::uint32_t> cells; ///< fill around the node in each slot
};

/// `shares`: k~ of every distance constraint (solvers/shares.hpp).
Batches batchesOf(const Scene& scene, const Settings& settings, std::span<const std::uint32_t> grids,
                  std::span<const float> shares);

} // namespace sinew::sim::lattice
