// The additions of mesh skins to the surface of cuts (cut_surface.hpp): their prisms are items of the surface
// after all slots, for which the same passes count and scan points and triangles. Nothing if no mesh skin is
// clipped.
//
//   cut    move_places_below_skin  moves particles outside of a skin below it for the blade
//   end    intersect_skin_edges     finds where edges of the skin met the blade
//          snap_rims_to_blade    moves vertices on the wrong side of the blade onto it
//          partition_prisms; write_rims (points), write_prisms (inside), write_pieces (remaining skin)
//   skin   list_split_vertices, place_split_vertices: vertices in divided cells, before normals;
//   rotate_rim_normals: normals beside cuts
#pragma once

#include "sim/surface/cut_surface.hpp"

namespace sinew::sim::surface {

/// Adds the buffers; buffers of cuts are added to the topology.
void addHungBuffers(ProgramBuilder& program, CutSurface& surface, const CutBodies& bodies);

/// Appends a dispatch of a kernel with a layout::PrismPush over the items that have a part of the surface.
void addListedPrisms(ProgramBuilder& program, const CutSurface& surface, const vk::ShaderCode& code,
                     std::initializer_list<BufferId> buffers);

void addPrismParting(ProgramBuilder& program, const CutSurface& surface);
void addRimPoints(ProgramBuilder& program, const CutSurface& surface);
void addPrismTriangles(ProgramBuilder& program, const CutSurface& surface);

/// Appends passes before normals and after find_gradients.
void addSplitVertices(ProgramBuilder& program, const CutSurface& surface);
void addRimNormals(ProgramBuilder& program, const CutSurface& surface);

} // namespace sinew::sim::surface
