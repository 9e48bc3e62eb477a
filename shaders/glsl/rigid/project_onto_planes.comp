#version 460
// Projects the particles of `gauss_seidel` onto the boundary planes they are behind, between two sweeps of a substep.
// After the last sweep the pass that closes the substep does so, or, if colliders come last, this one before them.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"
#include "rigid/planes.glsl"

layout(std430, binding = 0) readonly buffer Positions { vec4 positions[]; };   // predicted; w = inverse mass [1/kg]
layout(std430, binding = 1) readonly buffer Velocities { vec4 velocities[]; }; // v + h g
layout(std430, binding = 2) buffer Corrections { uvec4 corrections[]; };       // ParticleCorrection, in one load
layout(std140, binding = 3) uniform Planes { PlaneCollider planes[MOST_PLANES]; };
layout(std430, binding = 4) readonly buffer ContactOffsets { float contactOffsets[]; };
layout(std140, binding = 5) uniform Step { StepParams step; };
layout(push_constant) uniform Push { CountPush push; };
#include "forces/forces.glsl"

void main() {
    const uint i = itemIndex(push.count);
    if (i >= push.count || positions[i].w == 0.0) return;
    const vec3 v = velocities[i].xyz, correction = uintBitsToFloat(corrections[i].xyz);
    const vec3 predicted = step.h * (v - 0.5 * step.h * step.gravity.xyz); // the displacement without corrections
    Motion motion = Motion(positions[i].xyz + correction, v, predicted + correction);
    uint touched = 0u;
    for (uint p = 0u; p < planeCount; ++p) {
        const vec3 free = motion.v;
        if (!projectOntoPlane(planes[p], contactOffsets[i], step.h, motion)) continue;
        touched |= 1u << p;
        addPlaneForce(planes[p], p, i, (motion.v - free) / positions[i].w, motion.x);
    }
    if (touched == 0u) return;
    corrections[i] = uvec4(floatBitsToUint(motion.displacement - predicted), corrections[i].w | touched);
}
