// Cutting: the passes of a step with a blade, for cuttable bodies on a grid (Grid::isCuttable). The topology
// is a word of link bits for each node (lattice/link_masks.hpp); the blade clears bits in the same step,
// before its substeps, and gathers read them. A step without a blade records none of these passes.
//
//   cut      save links and positions; clear the bits of links that the blade meets (cut_links), and of links
//            that nothing holds any more (remove_loose_links); find the cells that lost an edge
//   publish  undo all that if the step is undone; find the pieces again if links were cut
#pragma once

#include "sim/model/scene_model.hpp"

namespace sinew::sim::cutting {

/// Adds the buffers of StepProgram::cutting, a phase "cut", and passes at the end of the step, if the scene
/// has cuttable bodies; otherwise nothing. Call it before the phase that solves.
void add(ProgramBuilder& program, const SceneModel& model, const ParticleBuffers& particles);

} // namespace sinew::sim::cutting
