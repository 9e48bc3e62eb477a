#version 460
// How what is around a particle near a cut has turned and strained since the scene was loaded (cutting design, 6):
// F = (sum d D^T) (sum D D^T)^-1 over its live links, D at rest. Where those lie in a plane the normal is that of the image;
// where they lie in a line, or there is none, nothing is known and F = 1.
#extension GL_GOOGLE_include_directive : require
#include "cut.glsl"
#include "link_masks.glsl"

layout(std430, binding = 0) readonly buffer Near { uint near[]; };
layout(std430, binding = 1) readonly buffer Links { uint links[]; };
layout(std430, binding = 2) readonly buffer Rest { vec4 rest[]; };
layout(std430, binding = 3) readonly buffer Particles { uint particles[]; }; // of each slot
layout(std430, binding = 4) readonly buffer Positions { vec4 positions[]; }; // of each particle
layout(std430, binding = 5) writeonly buffer Gradients { Gradient gradients[]; };

mat3 cofactor(mat3 m) { return mat3(cross(m[1], m[2]), cross(m[2], m[0]), cross(m[0], m[1])); }

// The column that says most about the direction in which a matrix of rank 2 is 0.
vec3 largestColumn(mat3 m) {
    vec3 best = m[0];
    for (int c = 1; c < 3; ++c)
        if (dot(m[c], m[c]) > dot(best, best)) best = m[c];
    return best;
}

mat3 gradientOf(mat3 moved, mat3 spread) {
    const float size = spread[0].x + spread[1].y + spread[2].z;
    if (determinant(spread) > 1e-3 * size * size * size) return moved * inverse(spread);
    const vec3 flat_ = largestColumn(cofactor(spread));
    const float area = length(flat_);
    if (!(area > 1e-3 * size * size)) return mat3(1.0);
    const vec3 normal = flat_ / area, turned = cofactor(moved) * normal;
    const float turnedArea = length(turned);
    if (!(turnedArea > 1e-6 * area)) return mat3(1.0);
    return (moved + 0.5 * size * outerProduct(turned / turnedArea, normal)) * inverse(spread + 0.5 * size * outerProduct(normal, normal));
}

void main() {
    const uint item = itemIndex(push.count);
    if (item >= push.count) return;
    const uint i = push.first + item;
    if (near[i] == 0u || particles[i] == NO_PARTICLE) return;
    const vec3 x = positions[particles[i]].xyz;
    mat3 moved = mat3(0.0), spread = mat3(0.0);
    for (uint alive = links[i]; alive != 0u; alive &= alive - 1u) {
        const uint j = uint(int(i) + offsetOf(directionOf(findLSB(alive))));
        const vec3 d = rest[j].xyz - rest[i].xyz;
        moved += outerProduct(positions[particles[j]].xyz - x, d);
        spread += outerProduct(d, d);
    }
    const mat3 f = gradientOf(moved, spread);
    gradients[i] = Gradient(vec4(f[0], 0.0), vec4(f[1], 0.0), vec4(f[2], 0.0));
}
