// Dispatches of the grids of a scene: `split` takes all grids of one shape and material in one.
#pragma once

#include "sim/model/scene_model.hpp"
#include "sim/stiffness/shares.hpp"
#include "sinew/scene.hpp"

namespace sinew::sim::solvers {

/// Whether an invocation computes one node: the form with one column and chunks of one slice.
constexpr bool isOneNode(const Forms& forms) {
    return forms.columns == 1 && forms.chunk == 1;
}

/// A dispatch of one substep, or of all substeps of a step if the bodies are resident.
struct Batch {
    bool isSheet = false, hasBodyDiagonals = false, hasVolumes = false, hasRecovery = false,
         isCuttable = false;
    layout::LatticePush push{}; ///< count = chunks, or nodes in whole runs; for resident bodies the kernel of
                                ///< a whole step sets it
    /// Chunks to march, padded with empty ones to whole work groups (for each body); runs of LATTICE_GROUP
    /// nodes if each invocation computes one node.
    std::vector<layout::LatticeChunk> chunks;
    std::vector<std::uint32_t> bodies; ///< resident: first slot of each
};

struct Batches {
    std::vector<Batch> batches;
    std::vector<std::uint32_t> cells; ///< by slot: fill around the node
};

/// Whether all bodies of the scene fit, one at a time, into the shared memory that the settings allow.
/// Cuttable bodies never do: their kernels have no resident form. The caller checks for contacts in each
/// substep, which exclude it too.
bool isResident(const Scene& scene, const Settings& settings, std::span<const std::uint32_t> grids);

/// The memory that holds bodies between substeps.
enum class Residence { memory, sharedMemory };

Batches batchesOf(const SceneModel& model, const stiffness::Shares& shares, Residence residence);

} // namespace sinew::sim::solvers
