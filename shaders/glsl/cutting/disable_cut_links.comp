#version 460
// Disables the listed links of a sheet that may be cut, BENDS: its bends, when a link that they span is dead, by
// setting their stiffness to 0, and enables them again when links are restored.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"

layout(std430, binding = 0) readonly buffer Links { uint links[]; };
layout(std430, binding = 1) readonly buffer Ties { CutTie ties[]; };
#ifdef BENDS
layout(std430, binding = 2) buffer List { SplitBend list[]; };
#else
layout(std430, binding = 2) buffer List { SplitLink list[]; };
#endif
layout(push_constant) uniform Push { CountPush push; };

void main() {
    const uint item = itemIndex(push.count);
    if (item >= push.count) return;
    const CutTie tie = ties[item];
    const uint both = (links[tie.first] >> (tie.bits & 31u)) & (links[tie.second] >> (tie.bits >> 8));
    list[tie.element].stiffness = (both & 1u) != 0u ? tie.stiffness : 0.0;
}
