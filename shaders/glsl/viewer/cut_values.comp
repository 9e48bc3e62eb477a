#version 460
// Interpolates values of particles to the vertices of the surface of cuts; vertices that coincide with a skin vertex
// take its value.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"
#include "viewer/values.h"

layout(std430, binding = 0) readonly buffer Values { float values[]; }; // one per particle
layout(std430, binding = 1) readonly buffer SkinValues { float skinValues[]; };
layout(std430, binding = 2) readonly buffer Vertices { CutVertex vertices[]; };
layout(std430, binding = 3) readonly buffer Particles { uint particles[]; }; // by slot, or NO_PARTICLE
layout(std430, binding = 4) writeonly buffer CutValues { float cutValues[]; };
layout(push_constant) uniform Push { ValuesPush push; };

void main() {
    const uint i = itemIndex(push.count);
    if (i >= push.count) return;
    const uint point = vertices[i].point;
    const bool isOfSkin = (point & (SURFACE_PARTICLE | SURFACE_SKIN)) == SURFACE_SKIN;
    float sum = 0.0, known = 0.0;
    for (uint k = 0u; k < 4u; ++k) {
        const uint particle = particles[min(vertices[i].corners[k], uint(particles.length()) - 1u)];
        const float value = particle == NO_PARTICLE ? NO_VALUE : values[particle];
        const float counted = value < 0.0 ? 0.0 : vertices[i].shares[k];
        sum += counted * value;
        known += counted;
    }
    cutValues[i] = isOfSkin ? skinValues[min(point & ~SURFACE_SKIN, uint(skinValues.length()) - 1u)]
                            : known > 0.0 ? sum / known
                                          : NO_VALUE;
}
