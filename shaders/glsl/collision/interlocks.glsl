// Shared by the two passes that separate interlocked bodies: their contacts, and the normal and size of each
// correction. Both ends of a contact compute equal bits, or exactly opposite ones.
#include "common/contacts.glsl"

layout(std430, binding = 0) readonly buffer Contacts { uvec2 contacts[]; }; // ContactCandidate, in one load
layout(std430, binding = 1) readonly buffer Lists { uvec2 lists[]; };
layout(std430, binding = 2) readonly buffer Normals { vec4 normals[]; }; // outward from the body, 0 = none; depth at rest [m]
layout(std430, binding = 3) readonly buffer Nodes { InterlockNode nodes[]; };
layout(std430, binding = 4) readonly buffer Partners { uint partners[]; }; // first entry of each body; then partner and pair
layout(std140, binding = 7) uniform Step { StepParams step; };
layout(push_constant) uniform Push { InterlockPush push; };

const uint noPair = ~0u;

uint pairOf(uint body, uint other) {
    for (uint p = partners[body - 1u]; p < partners[body]; p += 2u)
        if (partners[p] == other) return partners[p + 1u];
    return noPair;
}

// Contact normal from j to i: outward from the body of the particle that is less deep, or of the first of two equally
// deep ones. Between two surface particles it is the direction between them: where the bodies have separated they
// touch like any others.
vec3 normalOf(uint i, uint j, vec3 d) {
    const vec4 own = normals[i], other = normals[j];
    const bool isOwn = own.w < other.w || own.w == other.w && i < j;
    const vec3 n = isOwn ? -own.xyz : other.xyz;
    if (max(own.w, other.w) > 0.0 && n != vec3(0.0)) return n;
    return directionOf(d, i, j).n;
}

// Correction of a contact in a substep that changed the difference d by `way`: the approach, and the remaining
// overlap no faster than `most` [m].
float partingOf(vec3 n, vec3 d, vec3 way, float reach, float most) {
    const float depth = reach - dot3(n, d), left = most - dot3(n, way);
    return max(0.0, min(depth, left));
}
