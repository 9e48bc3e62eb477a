#version 460
// Contacts between edges, second pass: how a particle is shared among those of all edges that it ends, as in share_faces.
#extension GL_GOOGLE_include_directive : require
#include "kernel.glsl"

layout(std430, binding = 0) readonly buffer Corners { uint corners[]; }; // first of each particle; then 2 x edge + end
layout(std430, binding = 1) readonly buffer Sums { float sums[]; };
layout(std430, binding = 2) readonly buffer Velocities { vec4 velocities[]; }; // w = inverse mass [1/kg]
layout(std430, binding = 3) writeonly buffer Shares { float shares[]; };       // S w [1/kg]
layout(push_constant) uniform Push { FacePush push; };

void main() {
    const uint i = itemIndex(push.count);
    float sum = 0.0;
    for (uint k = corners[i]; k < corners[i + 1u]; ++k) sum += sums[corners[k]];
    shares[i] = sum * velocities[i].w;
}
