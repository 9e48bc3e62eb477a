#version 460
// Closes a substep of `jacobi`: damping, and restitution at the planes touched in this substep.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"

layout(std430, binding = 0) buffer Velocities { vec4 velocities[]; };
layout(std140, binding = 1) uniform Step { StepParams step; };
#include "rigid/planes.glsl"
layout(std430, binding = 2) readonly buffer Contacts { PlaneContact contacts[]; };
layout(std140, binding = 3) uniform Planes { PlaneCollider planes[MOST_PLANES]; };
layout(std430, binding = 4) readonly buffer Positions { vec4 positions[]; }; // read where forces are kept
layout(push_constant) uniform Push { CountPush push; };
#include "forces/forces.glsl"

void main() {
    const uint i = itemIndex(push.count);
    if (i >= push.count) return;
    const vec4 velocity = velocities[i];
    if (velocity.w == 0.0) return;
    // Even at rest v holds the half-kick h g / 2. Damping it like motion would reduce the weight of the body.
    vec3 v = mix(0.5 * step.h * step.gravity.xyz, velocity.xyz, step.velocityFactor);
    if (planeCount > 0u) {
        const PlaneContact contact = contacts[i];
        const vec3 before = vec3(contact.vx, contact.vy, contact.vz);
        for (uint p = 0u; p < planeCount; ++p) {
            if ((contact.touched & 1u << p) == 0u) continue;
            const vec3 change = rebound(planes[p], step.restSpeed, before, v);
            v += change;
            if (keepsForces) addPlaneForce(planes[p], p, i, change / velocity.w, positions[i].xyz);
        }
    }
    velocities[i].xyz = v;
}
