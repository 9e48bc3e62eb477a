// Cutting: the passes of a step with a blade, for bodies on a grid that may be cut (Grid::isCuttable).
// Topology is a word of link bits a node (lattice/link_masks.hpp); the blade clears bits in the step it
// moves, before its substeps, and gathers read them. A step without a blade records none of these passes.
//
//   cut      save links and places; clear the bits of links that the blade meets (cut_links); of those that
//            nothing holds any more (settle_links); find the cells that lost an edge
//   publish  undo all that with a step that is undone; find the pieces anew where links were cut
#pragma once

#include "sim/compile.hpp"

namespace sinew::sim::cutting {

/// Adds what a scene with bodies that may be cut needs: the buffers of StepProgram::cutting, a phase "cut",
/// and passes at the end of the step. Nothing otherwise. Call it before the phase that solves.
void add(ProgramBuilder& program, const Scene& scene, const Settings& settings,
         const ParticleBuffers& particles);

} // namespace sinew::sim::cutting
