#version 460
// Resolves motions: the centre of mass of the particles that each acts on, and of an impulse the velocities that it
// gives; and a table of poses by body. One group.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"

layout(std430, binding = 0) readonly buffer Requests { MotionRequest requests[]; };
layout(std430, binding = 1) readonly buffer Positions { vec4 positions[]; };
layout(std430, binding = 2) readonly buffer Velocities { vec4 velocities[]; };
layout(std140, binding = 3) uniform Step { StepParams step; };
layout(std430, binding = 4) readonly buffer Sums { MotionSums sums[]; };
layout(std430, binding = 5) writeonly buffer Frames { MotionFrame frames[]; };
layout(std430, binding = 6) writeonly buffer Placed { uint placed[]; }; // by body: its pose + 1, or 0
layout(push_constant) uniform Push { MotionPush push; };
#define MEMBERS_BINDING 7
#include "motions/motions.glsl"

MotionSums sumsOf(uint k) {
    MotionSums all = sums[k * MOTION_CHUNKS];
    for (uint c = 1u; c < MOTION_CHUNKS; ++c) {
        const MotionSums one = sums[k * MOTION_CHUNKS + c];
        all = MotionSums(all.first + one.first, all.diagonal + one.diagonal, all.mixed + one.mixed);
    }
    return all;
}

// Moments of inertia about the centre of mass c.
mat3 inertiaOf(MotionSums s, vec3 c) {
    const vec3 squares = s.diagonal.xyz - s.first.xyz * c, mixed = s.mixed.xyz - s.first.yzx * c.zxy;
    return mat3(squares.y + squares.z, -mixed.z, -mixed.y, -mixed.z, squares.z + squares.x, -mixed.x, -mixed.y, -mixed.x,
                squares.x + squares.y);
}

// The spin with this angular momentum. About the line of particles in one line, which has no inertia, there is next to
// none: the inverse is regularised, and refined, which leaves a relative error of (1e-5 / (i + 1e-5))^8 about an axis with
// a share i of the trace.
vec3 spinOf(mat3 inertia, vec3 momentum) {
    const float size = inertia[0].x + inertia[1].y + inertia[2].z;
    if (!(size > 0.0)) return vec3(0.0);
    const mat3 unit = inertia / size, rough = inverse(unit + 1e-5 * mat3(1.0));
    const vec3 wanted = momentum / size;
    vec3 spin = rough * wanted;
    for (uint round = 0u; round < 7u; ++round) spin += rough * (wanted - unit * spin);
    return spin;
}

void resolve(uint k) {
    const MotionRequest request = requests[k];
    const MotionSums s = sumsOf(k);
    const float mass = s.first.w;
    const vec3 c = mass > 0.0 ? s.first.xyz / mass : vec3(0.0);
    vec3 linear = request.linear.xyz, angular = request.angular.xyz;
    if (request.kind == MOTION_IMPULSE) {
        linear = mass > 0.0 ? linear / mass : vec3(0.0);
        angular = spinOf(inertiaOf(s, c), angular);
    }
    frames[k] = MotionFrame(vec4(placeOf(request.origin), 0.0), vec4(c, mass), vec4(linear, 0.0), vec4(angular, 0.0));
}

void main() {
    const uint k = gl_LocalInvocationID.x;
    if (k < push.motions && isOfRound(requests[k], push.isPose)) resolve(k);
    if (push.isPose == 0u) return;
    for (uint b = k; b < push.bodies; b += GROUP_SIZE) {
        uint pose = 0u;
        for (uint m = 0u; m < push.motions; ++m)
            if (requests[m].kind >= MOTION_POSE && requests[m].body == b) pose = m + 1u;
        placed[b] = pose;
    }
}
