#version 460
// Mixed skins, first pass: whole triangles that their parts stand for, since pieces stand for one of these or it may not be where the
// whole triangle has it, beside a cut.
#extension GL_GOOGLE_include_directive : require
#include "kernel.glsl"

layout(std430, binding = 0) readonly buffer Counts { SurfaceCounts counts[]; };
layout(std430, binding = 1) readonly buffer State { SurfaceState state; };
layout(std430, binding = 2) readonly buffer Faces { SkinFace faces[]; };
layout(std430, binding = 3) readonly buffer Prisms { SkinPrism prisms[]; };
layout(std430, binding = 4) readonly buffer Hung { HungVertex hung[]; };
layout(std430, binding = 5) readonly buffer Moved { vec4 moved[]; };
layout(std430, binding = 6) readonly buffer Partitions { uint partitions[]; };
layout(std430, binding = 7) writeonly buffer States { uint states[]; }; // of whole triangles
layout(push_constant) uniform Push { PrismPush push; };

void main() {
    const uint i = itemIndex(push.count);
    if (i >= push.count || faces[i].whole == NO_WHOLE) return;
    const uint cell = faces[i].cell; // an item of the surface: a prism
    bool isParted = state.missing == 0u && counts[cell].pieces != 0u;
    for (uint n = 0u; n < 3u; ++n) {
        const uint v = prisms[cell - push.first].vertices[n];
        isParted = isParted || partitions[hung[v].cell] != 0u || moved[v].w == VERTEX_MOVED;
    }
    if (isParted) states[faces[i].whole] = WHOLE_PARTED;
}
