// What skins of meshes add to the surface of cuts (cut_surface.hpp): their prisms are items of the surface
// behind all slots, of which the same passes count and scan points and triangles. Nothing where no skin of a
// mesh is clipped.
//
//   cut    pull_places  particles outside of a skin are below it for the blade
//   end    cut_skin     where edges of the skin have met the blade
//          move_rims    vertices on the wrong side of it move to it
//          part_prisms; write_rims (points), write_prisms (inside), write_pieces (what is left of the skin)
//   skin   list_split, skin_split: vertices in parted cells, before normals; turn_rims: normals beside cuts
#pragma once

#include "sim/surface/cut_surface.hpp"

namespace sinew::sim::surface {

/// Buffers; those of the cuts are added to the topology.
void addHungBuffers(ProgramBuilder& program, CutSurface& surface, const CutBodies& bodies);

void addPrismParting(ProgramBuilder& program, const CutSurface& surface);
void addRimPoints(ProgramBuilder& program, const CutSurface& surface);
void addPrismTriangles(ProgramBuilder& program, const CutSurface& surface);

/// Before normals are made; after find_gradients.
void addSplitVertices(ProgramBuilder& program, const CutSurface& surface);
void addRimNormals(ProgramBuilder& program, const CutSurface& surface);

} // namespace sinew::sim::surface
