#version 460
// Lists the vertices of a skin that the passes over what is near the blade ask for: those of listed prisms, and those that may move.
#extension GL_GOOGLE_include_directive : require
#include "cut.glsl"

layout(std430, binding = 0) readonly buffer PulledPlaces { vec4 pulledPlaces[]; };
layout(std430, binding = 1) readonly buffer PlacesBefore { vec4 before[]; };
layout(std430, binding = 2) readonly buffer Blade { BladeHead blade; };
layout(std430, binding = 3) readonly buffer Status { StatusWords status; };
layout(std430, binding = 4) readonly buffer Hung { HungVertex hung[]; };
layout(std430, binding = 5) readonly buffer Moved { vec4 moved[]; };
layout(std430, binding = 6) buffer Marks { uint marks[]; }; // none when this is done
layout(std430, binding = 7) buffer Counts { uint counts[]; };
layout(std430, binding = 8) writeonly buffer Listed { uint listed[]; }; // of a body from its first vertex on
layout(std430, binding = 9) writeonly buffer Placed { PlacedVertex placed[]; };

#define PLACE(i) pulledPlaces[i].xyz
#include "near_blade.glsl"

bool mayMove(uint v) {
    return blade.quads > 0u && isFinished(status) && moved[v].w != VERTEX_MOVED && (moved[v].w != 0.0 || isNearBlade(hung[v].anchor));
}

void main() {
    const uint item = itemIndex(push.count);
    if (item >= push.count) return;
    const uint v = push.first + item;
    const bool isMarked = marks[v] != 0u;
    marks[v] = 0u;
    if (isMarked || mayMove(v)) listed[push.first + atomicAdd(counts[SKIN_LISTS * push.run + SKIN_VERTICES], 1u)] = v;
    else if (blade.quads > 0u && isFinished(status)) placed[v].now = vec4(0.0);
}
