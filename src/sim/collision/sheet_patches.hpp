// Patches of sheets: squares of 4 x 4 cells of a flat cloth on a grid, whose faces search for points
// together. A patch is *alone* while its shape keeps its own points from its faces and no other point is
// near. Faces of a patch that is alone are not searched for, and are in no list: a cloth that hangs or swings
// without touching has next to no work (shaders/glsl/collision/patch_shape.glsl, search_patches.comp).
#pragma once

#include "common/layout.h"
#include "sim/collision/hash_grid.hpp"
#include "sim/model/state.hpp"

#include <array>
#include <span>
#include <vector>

namespace sinew::sim::collision::sheet_patches {

/// A sheet on a grid: node (x, y) is in slot first + x + stride y.
struct Sheet {
    std::uint32_t first = 0, stride = 0, nodesX = 0, nodesY = 0;
    float spacing = 0;   ///< of nodes at rest [m]
    float thickness = 0; ///< of its faces [m]
    float reach = 0;     ///< distance at which a point and a face of it touch [m]
    float nearest = 0;   ///< shortest distance at rest of a point and a face that may touch [m]
};

/// The sheets that have patches: at least PATCH_REGION nodes wide, without holes, flat and square in the
/// scene, with one radius, one thickness and halves of squares as faces, which touch at less than 1.5
/// spacings. `radii` by slot; `faces` with slots.
std::vector<Sheet> sheetsOf(const Scene& scene, const StateLayout& layout, std::span<const float> radii,
                            std::span<const layout::ContactFace> faces);

/// Two faces that search together; the second may be none (~0).
using FacePair = std::array<std::uint32_t, 2>;

/// Sorts `pairs` so that those of each patch follow each other, behind those of none. Returns the patches.
std::vector<layout::SheetPatch> sortIntoPatches(std::vector<FacePair>& pairs, std::span<const Sheet> sheets,
                                                std::span<const layout::ContactFace> faces);

struct Patches {
    std::uint32_t count = 0;
    std::uint32_t parts = 1;                   ///< invocations that check a patch
    float thickness = 0;                       ///< the largest [m]
    BufferId table = unbound, alone = unbound; ///< layout::SheetPatch; 1 = alone
};

/// `isShared`: several invocations check a patch, as suits a GPU.
Patches add(ProgramBuilder& program, std::span<const layout::SheetPatch> patches, float thickness,
            bool isShared);

/// Appends, before the check of members of frames: the check of patches that are alone.
void addCheck(ProgramBuilder& program, const Patches& patches, const hash_grid::Grid& grid,
              const hash_grid::Moved& moved);

/// The buffers and numbers of a search for points (face_lists::Lists).
struct Searching {
    BufferId radii, points;
    const layout::FaceFindPush& push;
};

/// Appends, when lists are made and points that are apart are listed: finds the patches that are alone, and
/// lists the faces of all others.
void addSearch(ProgramBuilder& program, const Patches& patches, const hash_grid::Grid& grid,
               const hash_grid::Moved& moved, const Searching& searching);

} // namespace sinew::sim::collision::sheet_patches
