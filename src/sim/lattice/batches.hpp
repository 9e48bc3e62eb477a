// The grids of a scene as `split` dispatches them: which are computed, where their particles are kept, and
// one dispatch for all grids of one shape and material.
#pragma once

#include "sim/compile.hpp"
#include "sim/lattice/placement.hpp"
#include "sim/solvers/shares.hpp"

namespace sinew::sim::lattice {

/// Indices of the grids whose neighbours are computed: those whose particles no other constraint touches, if
/// the settings want them so.
std::vector<std::uint32_t> computedGrids(const Scene& scene, const Settings& settings);

/// Particles outside those grids; they stand at the head of the state, in the order of the scene.
std::uint32_t listedParticles(const Scene& scene, std::span<const std::uint32_t> grids);

StateLayout layoutOf(const Scene& scene, std::span<const std::uint32_t> grids);

/// Where each of `grids` is in the state.
std::vector<Box> boxesOf(const Scene& scene, std::span<const std::uint32_t> grids);

/// Whether an invocation computes one node: the form with one column and chunks of one slice.
constexpr bool isOneNode(const Forms& forms) {
    return forms.columns == 1 && forms.chunk == 1;
}

/// One dispatch of a substep, or of all substeps of a step where the bodies are resident.
struct Batch {
    bool isSheet = false, hasBodyDiagonals = false, hasVolumes = false, hasRecovery = false,
         isCuttable = false;
    layout::LatticePush push{}; ///< count = chunks, or nodes in whole runs; the kernel of a whole step
                                ///< decides it for resident bodies
    /// Chunks to march, padded with empty ones to whole work groups (for each body); where each
    /// computes one node, runs of LATTICE_GROUP nodes.
    std::vector<layout::LatticeChunk> chunks;
    std::vector<std::uint32_t> bodies; ///< resident: first slot of each
};

struct Batches {
    std::vector<Batch> batches;
    std::vector<std::uint32_t> cells; ///< fill around the node in each slot
};

/// Whether all of the scene fits into the shared memory that the settings grant, body by body. Bodies that
/// may be cut never do: their kernels have no resident form. The caller knows whether contacts follow in each
/// substep, which leave no body there.
bool isResident(const Scene& scene, const Settings& settings, std::span<const std::uint32_t> grids);

/// The memory that holds bodies between substeps.
enum class Residence { memory, sharedMemory };

Batches batchesOf(const Scene& scene, const Settings& settings, std::span<const std::uint32_t> grids,
                  const solvers::Shares& shares, Residence residence);

} // namespace sinew::sim::lattice
