// The skin of a sheet along cuts: triangles between corners that no longer hang together fall into pieces,
// each of which goes with its own corner, so none is stretched over a cut and none hangs on both sides. The
// rule is that of the surface of a solid's cuts (cut_surface.hpp) on triangles instead of tetrahedra: dead
// links say what is apart, the blade where. Particles stay whole, so mass and momentum are what they were.
//
// In a step with a cut: count_sheet (pieces of every triangle), scan_sheet (where they begin, by counts in
// the order of triangles; what is drawn), write_sheet (indices, what vertices hang on; the skin's own
// triangles that pieces stand for shrink to a point). When somebody draws: skin_sheet (vertices, normals).
#pragma once

#include "layout.h"
#include "sim/compile.hpp"

#include <memory>
#include <optional>

namespace sinew::sim::surface {

/// Triangles of `skin` as halves of cells of the sheet `grid`, split along (1, 0, 1); none where one is
/// something else. `slot` is that of the node (0, 0, 0), `sliceStride` leads from a node to the next in z.
std::optional<std::vector<layout::SheetTriangle>>
sheetTriangles(const Skin& skin, const Grid& grid, std::uint32_t slot, std::uint32_t sliceStride);

/// A skin that falls into pieces.
struct SheetSkin {
    layout::SheetPush push{};
    layout::SheetSkinPush skinPush{};
    BufferId triangles, counts, state, vertices;
};

struct SheetPieces {
    std::vector<SheetSkin> skins;
    BufferId particles; ///< by slot
    BufferId allIndices, arguments;
    std::uint32_t leastRoom = 0; ///< of each skin that can have as many, in triangles
};

/// Buffers, and the skins' indices, which cuts change; none where no sheet that may be cut has such a skin.
/// After those of StepProgram::cutting, to whose topology they are added, and before addCutSurface().
/// `particles` is by slot, NO_PARTICLE where there is none; `leastRoom` is Settings::cutSurfaceRoom.
std::shared_ptr<SheetPieces> addSheetPieces(ProgramBuilder& program, const Scene& scene,
                                            const StateLayout& layout, BufferId particles,
                                            std::uint32_t leastRoom);

/// After the links of a step are settled. `isFirst`: no surface of cuts before it says what is missing.
void addSheetPasses(ProgramBuilder& program, const SheetPieces& pieces, bool isFirst);

} // namespace sinew::sim::surface
