// The skin of a sheet along cuts: a triangle whose corners are no longer connected is divided into pieces,
// each of which follows its own corner, so that none is stretched over a cut. The rule is that of the surface
// of a solid's cuts (cut_surface.hpp), on triangles instead of tetrahedra: dead links say what is separated,
// the blade says where. Particles stay whole, so mass and momentum are unchanged.
//
// A step with a cut runs: count_sheet (pieces of every triangle), scan_sheet (their first elements, from the
// counts in the order of triangles; draw arguments), write_sheet (indices, and the particles that vertices
// depend on; the skin's own triangles that pieces replace collapse to a point). The list of skins runs
// place_sheet_pieces (vertices, normals).
#pragma once

#include "common/layout.h"
#include "sim/model/state.hpp"

#include <memory>
#include <optional>

namespace sinew::sim::surface {

/// Triangles of `skin` as halves of cells of the sheet `grid`, split along (1, 0, 1); none if a triangle is
/// anything else. `slot` is that of the node (0, 0, 0), `sliceStride` the distance in slots between
/// neighbours in z.
std::optional<std::vector<layout::SheetTriangle>>
sheetTriangles(const Skin& skin, const Grid& grid, std::uint32_t slot, std::uint32_t sliceStride);

/// A skin that cuts divide into pieces.
struct SheetSkin {
    layout::SheetPush push{};
    layout::SheetSkinPush skinPush{};
    BufferId triangles, counts, state, vertices;
    BufferId textured; ///< layout::TexturedHalf of each triangle; invalid without texture coordinates
};

struct SheetPieces {
    std::vector<SheetSkin> skins;
    BufferId particles; ///< by slot
    BufferId allIndices, arguments;
    std::uint32_t leastRoom = 0; ///< capacity of each skin in triangles, if it can need so many
};

/// Adds the buffers, and the index buffer of skins, which cuts change; null if no cuttable sheet has such a
/// skin. Call it after the buffers of StepProgram::cutting were added, to whose topology these are added, and
/// before addCutSurface(). `particles` is by slot, NO_PARTICLE in empty ones; `leastRoom` is
/// Settings::cutSurfaceRoom.
std::shared_ptr<SheetPieces> addSheetPieces(ProgramBuilder& program, const Scene& scene,
                                            const StateLayout& layout, BufferId particles,
                                            std::uint32_t leastRoom);

/// Appends the parts of sheets to the list of skins, after all normals.
void addSheetDrawing(ProgramBuilder& program, const SheetPieces& pieces);

/// Appends the passes after the links of a step are settled. `isFirst`: no surface of cuts before it reports
/// missing room.
void addSheetPasses(ProgramBuilder& program, const SheetPieces& pieces, bool isFirst);

} // namespace sinew::sim::surface
