// Cutting: the passes of a step with a blade, for cuttable bodies on a grid (Grid::isCuttable). The topology
// is a word of link bits for each node (lattice/link_masks.hpp); the blade clears bits in the same step,
// before its substeps, and gathers read them. A step without a blade records none of these passes.
//
//   cut      save links and positions; clear the bits of links that the blade meets (cut_links), and of links
//            that nothing holds any more (remove_loose_links); find the cells that lost an edge
//   publish  undo all that if the step is undone; find the pieces again if links were cut
#pragma once

#include "sim/model/feature.hpp"

namespace sinew::sim::cutting {

/// Adds the buffers of StepProgram::cutting and a phase "cut", if the scene has cuttable bodies; otherwise
/// this and the functions below add nothing.
void addBuffersOfCuts(Build& build);
void addOpening(Build& build);
/// Appends the passes at the end of a step with a blade.
void addClosing(Build& build);
/// Appends the list that derives pieces, surfaces and what else a cut changes from the links.
void addRewriting(Build& build);
/// Appends what normals of skins depend on.
void addSkinNormals(Build& build);
/// Appends the pieces of sheets, the surface of cuts, and the hiding of fragments.
void addSkinEnd(Build& build);

} // namespace sinew::sim::cutting
