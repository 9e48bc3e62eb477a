#version 460
// Deformation gradients at the particles near a cut, for drawing the vertices that are bound to them.
#extension GL_GOOGLE_include_directive : require
#include "common/cut.glsl"
#include "lattice/link_masks.glsl"

layout(std430, binding = 0) readonly buffer Near { uint near[]; };
layout(std430, binding = 1) readonly buffer Links { uint links[]; };
layout(std430, binding = 2) readonly buffer Rest { vec4 rest[]; };
layout(std430, binding = 3) readonly buffer Particles { uint particles[]; }; // one per slot
layout(std430, binding = 4) readonly buffer Positions { vec4 positions[]; }; // one per particle
layout(std430, binding = 5) writeonly buffer Gradients { Gradient gradients[]; };

#define ALIVE(i) links[i]
#define AT(i) positions[particles[i]].xyz
#define REST(i) rest[i].xyz
#include "surface/gradient.glsl"

void main() {
    const uint item = itemIndex(push.count);
    if (item >= push.count) return;
    const uint i = push.first + item;
    if (near[i] == 0u || particles[i] == NO_PARTICLE) return;
    const mat3 f = gradientAt(i);
    gradients[i] = Gradient(vec4(f[0], 0.0), vec4(f[1], 0.0), vec4(f[2], 0.0));
}
