#version 460
// How long every particle has been at rest: slow, and not far from where it was when it came to rest. Begins the search for
// islands with what is linked.
#extension GL_GOOGLE_include_directive : require
#include "kernel.glsl"

layout(std430, binding = 0) readonly buffer Weights { float weights[]; };      // inverse mass of what is awake [1/kg]
layout(std430, binding = 1) readonly buffer Limits { float limits[]; };        // how far what rests may drift [m]; below 0 = it was removed and rests
layout(std430, binding = 2) readonly buffer Positions { vec4 positions[]; };   // x + thetaH v
layout(std430, binding = 3) readonly buffer Velocities { vec4 velocities[]; };
layout(std140, binding = 4) uniform Step { StepParams step; };
layout(std430, binding = 5) buffer Rests { vec4 rests[]; };                    // where [m], how long [s]; below 0 = asleep
layout(std430, binding = 6) readonly buffer Components { uint components[]; }; // first slot of what is linked
layout(std430, binding = 7) writeonly buffer Islands { uint islands[]; };
layout(std430, binding = 8) writeonly buffer Least { uint least[]; };          // of an island, at its first slot
layout(push_constant) uniform Push { SleepPush push; };

void main() {
    const uint i = itemIndex(push.count);
    least[i] = 0x7f800000u;
    const vec4 velocity = velocities[i];
    if (weights[i] > 0.0 && velocity.w == 0.0) return; // asleep: its island stays
    islands[i] = components[i]; // of what never moves too: a piece may be named after that (part_islands)
    if (weights[i] == 0.0) return;
    const vec3 x = positions[i].xyz - step.thetaH * velocity.xyz;
    if (limits[i] < 0.0) {
        rests[i] = vec4(x, SLEEP_TIME);
        return;
    }
    const vec4 rest = rests[i];
    // Contacts move a particle that lies on others up and down by its fall in some substeps, and it does not leave its place. A vibration
    // by more than the limit that steps see at one phase only is faster than that.
    const float dt = float(push.substeps) * step.h, most = clamp(6.2832 * limits[i] / dt, SLEEP_SPEED, SLEEP_MOST_SPEED);
    const bool isSlow = dot(velocity.xyz, velocity.xyz) <= most * most;
    const bool rests_ = rest.w >= 0.0 && isSlow && distance(x, rest.xyz) <= limits[i]; // below 0: it woke in this step
    rests[i] = rests_ ? vec4(rest.xyz, rest.w + dt) : vec4(x, 0.0);
}
