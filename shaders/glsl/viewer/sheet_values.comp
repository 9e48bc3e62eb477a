#version 460
// Interpolates values of particles to the skin vertices of a sheet along cuts.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"
#include "viewer/values.h"

layout(std430, binding = 0) readonly buffer Values { float values[]; }; // one per particle
layout(std430, binding = 1) readonly buffer Vertices { SheetVertex vertices[]; };
layout(std430, binding = 2) readonly buffer Particles { uint particles[]; }; // by slot, or NO_PARTICLE
layout(std430, binding = 3) writeonly buffer SkinValues { float skinValues[]; };
layout(push_constant) uniform Push { ValuesPush push; };

float valueOf(uint slot) {
    const uint particle = particles[slot];
    return particle == NO_PARTICLE ? NO_VALUE : values[particle];
}

void main() {
    const uint i = itemIndex(push.count);
    if (i >= push.count) return;
    const SheetVertex vertex = vertices[i];
    const float a = valueOf(vertex.a), b = vertex.share > 0.0 ? valueOf(vertex.b) : a;
    skinValues[push.first + i] = min(a, b) < 0.0 ? max(a, b) : mix(a, b, vertex.share);
}
