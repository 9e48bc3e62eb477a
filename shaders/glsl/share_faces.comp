#version 460
// Contacts with faces, second pass: how a particle is shared among its contacts. It gives each the part |beta| / S of
// itself, S = the sum of |beta| over all that it takes part in, as a point or as a corner: parts sum to 1. Written here: S w.
#extension GL_GOOGLE_include_directive : require
#include "kernel.glsl"
#include "face_shares.glsl"
layout(std430, binding = 7) readonly buffer Velocities { vec4 velocities[]; }; // w = inverse mass [1/kg]
layout(std430, binding = 8) writeonly buffer Shares { float shares[]; };       // S w [1/kg]

void main() {
    const uint i = itemIndex(push.count);
    const uvec2 list = lists[i];
    float sum = 0.0;
    for (uint element = list.x; element < list.x + list.y; ++element) sum += directions[element].w > 0.0 ? 1.0 : 0.0;
    for (uint k = corners[i]; k < cornerEnds[i]; ++k) {
        const uint corner = corners[k] % 4u;
        const uvec2 points = linkLists[corners[k] / 4u];
        for (uint link = points.x; link < points.x + points.y; ++link) {
            const uint element = links[link];
            if (directions[element].w > 0.0) sum += weights[element][corner];
        }
    }
    shares[i] = sum * velocities[i].w;
}
