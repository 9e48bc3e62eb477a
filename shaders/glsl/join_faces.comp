#version 460
// Joins the islands of particles and of the corners of faces that they have touched in the last substep.
#extension GL_GOOGLE_include_directive : require
#include "kernel.glsl"
#include "islands.glsl"

layout(std430, binding = 3) readonly buffer Contacts { ContactCandidate contacts[]; };
layout(std430, binding = 4) readonly buffer Counts { uint counts[]; };
layout(std430, binding = 5) readonly buffer Directions { vec4 directions[]; }; // w: depth [m]
layout(std430, binding = 6) readonly buffer Faces { ContactFace faces[]; };
layout(push_constant) uniform Push { SleepPush push; };

void main() {
    const uint i = itemIndex(push.count);
    for (uint s = 0u; s < counts[i]; ++s) {
        const uint element = s * push.faceRow + i;
        if (!(directions[element].w > 0.0)) continue;
        const ContactFace face = faces[contacts[element].other];
        const uint all[4] = uint[](i, face.a, face.b, face.c);
        for (uint k = 1u; k < 4u; ++k)
            for (uint l = 0u; l < k; ++l)
                if (isAwake(all[k]) && isAwake(all[l])) join(all[k], all[l]);
    }
}
