#version 460
// Skin vertices that are particles (cloth, bare lattices).
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"

layout(std430, binding = 0) readonly buffer Positions { vec4 positions[]; };
layout(std430, binding = 1) readonly buffer Particles { uint particles[]; };
layout(std430, binding = 2) buffer Vertices { SkinVertex vertices[]; };
layout(push_constant) uniform Push { SkinPush push; };

void main() {
    const uint i = itemIndex(push.count);
    if (i >= push.count) return;
    const vec4 particle = positions[particles[i]];
    vertices[push.firstVertex + i].position = vec4(particle.xyz, particle.w > 0.0 ? 1.0 : 0.0);
}
