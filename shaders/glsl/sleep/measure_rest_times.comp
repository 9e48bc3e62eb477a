#version 460
// Updates the resting time of every particle: it rests while it is slow, and near the place where it came to rest.
// Starts the search for islands with linked components.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"

layout(std430, binding = 0) readonly buffer Weights { float weights[]; };      // inverse mass of awake particles [1/kg]
layout(std430, binding = 1) readonly buffer Limits { float limits[]; };        // largest drift at rest [m]; below 0 = removed, rests always
layout(std430, binding = 2) readonly buffer Positions { vec4 positions[]; };   // x + thetaH v
layout(std430, binding = 3) readonly buffer Velocities { vec4 velocities[]; };
layout(std140, binding = 4) uniform Step { StepParams step; };
layout(std430, binding = 5) buffer Rests { vec4 rests[]; };                    // place of rest [m]; w: resting time [s], below 0 = asleep
layout(std430, binding = 6) readonly buffer Components { uint components[]; }; // first slot of its linked component
layout(std430, binding = 7) writeonly buffer Islands { uint islands[]; };
layout(std430, binding = 8) writeonly buffer Least { uint least[]; };          // by island, at its first slot
layout(push_constant) uniform Push { SleepPush push; };

void main() {
    const uint i = itemIndex(push.count);
    least[i] = 0x7f800000u;
    const vec4 velocity = velocities[i];
    if (weights[i] > 0.0 && velocity.w == 0.0) return; // asleep: its island stays
    islands[i] = components[i]; // includes static particles: a piece may be named after one (update_sleep_components)
    if (weights[i] == 0.0) return;
    const vec3 x = positions[i].xyz - step.thetaH * velocity.xyz;
    if (limits[i] < 0.0) {
        rests[i] = vec4(x, SLEEP_TIME);
        return;
    }
    const vec4 rest = rests[i];
    // In some substeps contacts move a particle that lies on others up and down by its fall, while it stays in place.
    // A vibration beyond the limit that all steps sample at one phase is faster than that.
    const float dt = float(push.substeps) * step.h, most = clamp(6.2832 * limits[i] / dt, SLEEP_SPEED, SLEEP_MOST_SPEED);
    const bool isSlow = dot(velocity.xyz, velocity.xyz) <= most * most;
    const bool rests_ = rest.w >= 0.0 && isSlow && distance(x, rest.xyz) <= limits[i]; // below 0: it woke in this step
    rests[i] = rests_ ? vec4(rest.xyz, rest.w + dt) : vec4(x, 0.0);
}
