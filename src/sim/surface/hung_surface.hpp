// The additions of mesh skins to the surface of cuts (cut_surface.hpp): their prisms are items of the surface
// after all slots, for which the same passes count and scan points and triangles. Nothing if no mesh skin is
// clipped.
//
//   cut    pull_places  moves particles outside of a skin below it for the blade
//   end    cut_skin     finds where edges of the skin met the blade
//          move_rims    moves vertices on the wrong side of the blade onto it
//          part_prisms; write_rims (points), write_prisms (inside), write_pieces (remaining skin)
//   skin   list_split, skin_split: vertices in divided cells, before normals; turn_rims: normals beside cuts
#pragma once

#include "sim/surface/cut_surface.hpp"

namespace sinew::sim::surface {

/// Adds the buffers; buffers of cuts are added to the topology.
void addHungBuffers(ProgramBuilder& program, CutSurface& surface, const CutBodies& bodies);

void addPrismParting(ProgramBuilder& program, const CutSurface& surface);
void addRimPoints(ProgramBuilder& program, const CutSurface& surface);
void addPrismTriangles(ProgramBuilder& program, const CutSurface& surface);

/// Appends passes before normals and after find_gradients.
void addSplitVertices(ProgramBuilder& program, const CutSurface& surface);
void addRimNormals(ProgramBuilder& program, const CutSurface& surface);

} // namespace sinew::sim::surface
