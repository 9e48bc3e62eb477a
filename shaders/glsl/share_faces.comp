#version 460
// Contacts with faces, second pass: how a particle is shared among its contacts. It gives each the part |beta| / S of
// itself, S = the sum of |beta| over all that it takes part in, as a point or as a corner: parts sum to 1. Written here: S w.
#extension GL_GOOGLE_include_directive : require
#include "kernel.glsl"
#include "face_shares.glsl"
layout(std430, binding = 6) readonly buffer Velocities { vec4 velocities[]; }; // w = inverse mass [1/kg]
layout(std430, binding = 7) writeonly buffer Shares { float shares[]; };       // S w [1/kg]

void main() {
    const uint i = itemIndex(push.count), n = counts[i];
    float sum = 0.0;
    for (uint s = 0u; s < n; ++s) sum += directions[s * push.row + i].w > 0.0 ? 1.0 : 0.0;
    for (uint k = corners[i]; k < corners[i + 1u]; ++k) {
        const uint face = corners[k] / 4u, corner = corners[k] % 4u, points = linkCounts[face];
        for (uint s = 0u; s < points; ++s) {
            const uint element = links[s * push.faceRow + face];
            if (directions[element].w > 0.0) sum += weights[element][corner];
        }
    }
    shares[i] = sum * velocities[i].w;
}
