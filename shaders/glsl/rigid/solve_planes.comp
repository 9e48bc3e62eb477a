#version 460
// Projects the particles of `jacobi` onto the boundary planes they are behind, once per iteration.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"
#include "rigid/planes.glsl"

layout(std430, binding = 0) buffer Positions { vec4 positions[]; }; // w = inverse mass [1/kg]
layout(std430, binding = 1) buffer Velocities { vec4 velocities[]; };
layout(std430, binding = 2) buffer Contacts { PlaneContact contacts[]; };
layout(std140, binding = 3) uniform Planes { PlaneCollider planes[MOST_PLANES]; };
layout(std430, binding = 4) readonly buffer ContactOffsets { float contactOffsets[]; };
layout(std140, binding = 5) uniform Step { StepParams step; };
layout(push_constant) uniform Push { CountPush push; };
#include "forces/forces.glsl"

void main() {
    const uint i = itemIndex(push.count);
    if (i >= push.count || positions[i].w == 0.0) return;
    const vec3 v = velocities[i].xyz;
    // v includes the whole of h g, the displacement half of it (predict)
    Motion motion = Motion(positions[i].xyz, v, step.h * (v - 0.5 * step.h * step.gravity.xyz));
    uint touched = 0u;
    for (uint p = 0u; p < planeCount; ++p) {
        const vec3 free = motion.v;
        if (!projectOntoPlane(planes[p], contactOffsets[i], step.h, motion)) continue;
        touched |= 1u << p;
        addPlaneForce(planes[p], p, i, (motion.v - free) / positions[i].w, motion.x);
    }
    if (touched == 0u) return;
    positions[i].xyz = motion.x;
    velocities[i].xyz = motion.v;
    contacts[i].touched |= touched;
}
