// The part of layout.h for patches of sheets (sim/collision/sheet_patches.hpp); only layout.h includes it.

// Squares of a sheet whose faces search for points together, and the region around them (patch_shape.glsl).
struct SheetPatch {
    uint first;  // slot of the first node of the region, which has PATCH_REGION x PATCH_REGION nodes
    uint stride; // distance in slots between its rows
    uint nodes;  // its own nodes in the region, a byte each: the first x and y, then their number in x and in y
    uint pairs, pairCount; // its faces: pairs among the searched ones, from FaceFindPush::loose on
    float spacing;         // distance of neighbours at rest [m]
    float reach;           // distance at which a point and a face of the sheet touch [m]
    float nearest;         // shortest distance at rest of a point and a face of the sheet that may touch [m]
};
#define PATCH_SQUARES 4u
#define PATCH_REGION (PATCH_SQUARES + 3u) // nodes: one more than squares, and a rim

struct SearchPatchesPush {
    uint points, patches; // particles; patches of sheets
    uint cells;           // cells of the grid
    uint loose;           // as in FaceFindPush
    float thickness;      // largest thickness of a face of a patch [m]
    float margin;         // as in FaceFindPush [m]
};
