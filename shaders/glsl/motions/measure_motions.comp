#version 460
// Sums masses and moments of the particles that each motion acts on: MOTION_CHUNKS work groups a motion. Sums have one
// order.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"

layout(std430, binding = 0) readonly buffer Requests { MotionRequest requests[]; };
layout(std430, binding = 1) readonly buffer Positions { vec4 positions[]; };   // x + thetaHPrevious v [m]
layout(std430, binding = 2) readonly buffer Velocities { vec4 velocities[]; }; // w = inverse mass [1/kg]
layout(std140, binding = 3) uniform Step { StepParams step; };
layout(std430, binding = 4) writeonly buffer Sums { MotionSums sums[]; };
layout(push_constant) uniform Push { MotionPush push; };
#define MEMBERS_BINDING 5
#include "motions/motions.glsl"

shared MotionSums parts[GROUP_SIZE];

MotionSums sum(MotionSums a, MotionSums b) {
    return MotionSums(a.first + b.first, a.diagonal + b.diagonal, a.mixed + b.mixed);
}

void main() {
    const uint k = gl_WorkGroupID.x / MOTION_CHUNKS, chunk = gl_WorkGroupID.x % MOTION_CHUNKS, lane = gl_LocalInvocationID.x;
    const MotionRequest request = requests[k];
    if (!isOfRound(request, push.isPose)) return;
    const vec3 origin = placeOf(request.origin);
    MotionSums own = MotionSums(vec4(0.0), vec4(0.0), vec4(0.0));
    for (uint i = request.first + chunk * GROUP_SIZE + lane; i < request.end; i += MOTION_CHUNKS * GROUP_SIZE) {
        const float w = inverseMassOf(i);
        if (w == 0.0) continue;
        const vec3 x = placeOf(i), d = x - origin;
        if (!actsOn(request, bodies[i], x)) continue;
        const float m = 1.0 / w;
        own = sum(own, MotionSums(vec4(m * d, m), vec4(m * d * d, 0.0), vec4(m * d.yzx * d.zxy, 0.0)));
    }
    parts[lane] = own;
    barrier();
    for (uint reach = GROUP_SIZE / 2u; reach > 0u; reach /= 2u) {
        if (lane < reach) parts[lane] = sum(parts[lane], parts[lane + reach]);
        barrier();
    }
    if (lane == 0u) sums[k * MOTION_CHUNKS + chunk] = parts[0];
}
