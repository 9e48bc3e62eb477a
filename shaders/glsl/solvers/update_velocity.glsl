// Closes a substep of `jacobi`: damping, and restitution at the planes touched in this substep.
#include "common/kernel.glsl"

layout(std430, binding = 0) buffer Velocities { vec4 velocities[]; };
layout(std140, binding = 1) uniform Step { StepParams step; };
#ifdef HAS_PLANES
#include "rigid/planes.glsl"
layout(std430, binding = 2) readonly buffer Contacts { PlaneContact contacts[]; };
layout(std140, binding = 3) uniform Planes { PlaneCollider planes[MOST_PLANES]; };
#ifdef FORCES
layout(std430, binding = 4) readonly buffer Positions { vec4 positions[]; };
#endif
#endif
layout(push_constant) uniform Push { CountPush push; };
#include "forces/forces.glsl"

void main() {
    const uint i = itemIndex(push.count);
    if (i >= push.count) return;
    const vec4 velocity = velocities[i];
    if (velocity.w == 0.0) return;
    // Even at rest v holds the half-kick h g / 2. Damping it like motion would reduce the weight of the body.
    vec3 v = mix(0.5 * step.h * step.gravity.xyz, velocity.xyz, step.velocityFactor);
#ifdef HAS_PLANES
    const PlaneContact contact = contacts[i];
    const vec3 before = vec3(contact.vx, contact.vy, contact.vz);
    for (uint p = 0u; p < planeCount; ++p) {
        if ((contact.touched & 1u << p) == 0u) continue;
        const vec3 change = rebound(planes[p], step.restSpeed, before, v);
        v += change;
#ifdef FORCES
        addPlaneForce(planes[p], p, i, change / velocity.w, positions[i].xyz);
#endif
    }
#endif
    velocities[i].xyz = v;
}
