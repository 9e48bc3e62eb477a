// Structs of the kernels of texture coordinates, shared by C++ and GLSL; rules as in layout.h.
#ifndef SINEW_TEXTURE_LAYOUT_H
#define SINEW_TEXTURE_LAYOUT_H
#include "common/layout.h"

#ifdef __cplusplus
namespace sinew::sim::layout {
#endif

#define NO_TEXTURE 0xffffffffu

// A triangle of a skin that is bound by a prism.
struct TexturedPrism {
    uint triangle; // its index in all skins; NO_TEXTURE if its skin has no texture coordinates
    uint homes[3]; // for each corner a TexturedWhole beside it, on its side of a seam
    float at[6];   // u and v of each corner while it is where it was at load
};

// A triangle of such a skin before it was split.
struct TexturedWhole {
    uint vertices[3]; // indices of HungVertex
    uint beyond[3];   // the one across edge n, from corner n to the next; NO_TEXTURE across a seam
    float at[6];
};

// A triangle of a skin on an outer face of a cell.
struct TexturedFace {
    uint item;   // as in SkinFace
    float at[6]; // of its corners in ascending order
};

// The faces of a body.
struct TexturedFacePush {
    uint first, count;
    uint rowStride, sliceStride; // slots from a node to the next in y, in z
};

// Half of a cell of a sheet.
struct TexturedHalf {
    float at[6]; // of its corners in the order of sheet_edges.glsl
};

#ifdef __cplusplus
} // namespace sinew::sim::layout
#endif
#endif
