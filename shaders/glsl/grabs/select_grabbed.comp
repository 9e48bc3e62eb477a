#version 460
// Finds the particles held by each grab from this step on, their offsets from its point and their shares of the pull:
// all particles linked to the grabbed one and within its radius, weighted by (1 - (d / radius)^2)^2 and mass. Runs
// only in a step in which a grab begins or ends. Shares are integers, so their sum does not depend on order; the list
// of held particles is in any order, which is harmless, for each is pulled by itself.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"
#include "common/absent.glsl"

layout(constant_id = 1) const bool comeAndGo = false; // bodies do in this step: places are those of the solver's state
layout(std430, binding = 0) readonly buffer Requests { GrabRequest requests[]; };
layout(std430, binding = 1) buffer States { GrabState states[]; };
layout(std430, binding = 2) readonly buffer Bodies { GrabBody bodies[]; };
layout(std430, binding = 3) readonly buffer Positions { vec4 positions[]; }; // public [m]
layout(std430, binding = 4) buffer Grips { Grip grips[]; };
layout(std430, binding = 5) writeonly buffer Held { uint held[]; }; // particle indices
layout(std430, binding = 6) buffer Pulling { DispatchArguments pulling; };
layout(std430, binding = 7) readonly buffer Stored { vec4 stored[]; }; // by slot: x + thetaHPrevious v [m]
layout(std430, binding = 8) readonly buffer Velocities { vec4 velocities[]; };
layout(std140, binding = 9) uniform Step { StepParams step; };
layout(push_constant) uniform Push { GrabPush push; };

const uint mostShare = 1u << (GRAB_SHARE_BITS - 1);

vec3 placeOf(uint p) {
    if (!comeAndGo) return positions[p].xyz;
    const uint slot = bodies[p].slot;
    return stored[slot].xyz - step.thetaHPrevious * velocities[slot].xyz;
}

// Share of particle p in 1 / mostShare of the mass of its component; 0 = not held.
uint shareOf(uint p, GrabRequest request) {
    const uint chosen = request.particle;
    if (bodies[p].component != bodies[chosen].component || bodies[p].part == 0.0) return 0u;
    const vec3 x = placeOf(p);
    if (comeAndGo && isAbsent(x)) return 0u;
    const float far = distance(x, placeOf(chosen)) / max(request.radius, 1e-30);
    const float fall = p == chosen ? 1.0 : max(1.0 - far * far, 0.0);
    return fall == 0.0 ? 0u : max(uint(fall * fall * bodies[p].part * float(mostShare)), 1u);
}

void main() {
    const uint p = itemIndex(push.count);
    if (p >= push.count) return;
    const uint before = grips[p].held >> GRAB_SHARE_BITS;
    uint share = 0u;
    if (before > 0u && states[before - 1u].isNew == 0u) share = grips[p].held & (1u << GRAB_SHARE_BITS) - 1u;
    uint number = share > 0u ? before : 0u;
    for (uint k = 0u; k < push.grabs; ++k) {
        if (number > 0u || states[k].isNew == 0u || requests[k].serial == 0u) continue;
        share = shareOf(p, requests[k]);
        if (share == 0u) continue;
        number = k + 1u;
        grips[p].offset = vec4(placeOf(p) - requests[k].from.xyz, 0.0);
    }
    grips[p].held = number << GRAB_SHARE_BITS | share;
    if (number == 0u) return;
    atomicAdd(states[number - 1u].total, share);
    const uint place = atomicAdd(pulling.unused0, 1u);
    atomicMax(pulling.groupsX, place / GROUP_SIZE + 1u);
    held[place] = p;
}
