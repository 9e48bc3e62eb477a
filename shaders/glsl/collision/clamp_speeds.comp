#version 460
// Slows all particles that are too fast for the hash grid, if they are too many to be searched one by one: this
// bounds the time of a step. Driven ones are not slowed. Slowed particles are counted, because capping removes momentum;
// shorter substeps make it needless.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"
#include "collision/hash_grid.glsl"

layout(std430, binding = 0) buffer Positions { vec4 positions[]; };   // predicted
layout(std430, binding = 1) buffer Velocities { vec4 velocities[]; }; // that led to those positions [m/s]; w = inverse mass [1/kg]
layout(std430, binding = 2) readonly buffer Radii { float radii[]; };
layout(std430, binding = 3) buffer Status { StatusWords status; };
layout(std140, binding = 4) uniform Step { StepParams step; };
layout(constant_id = 14) const bool hasWays = false;
layout(std430, binding = 5) writeonly buffer Ways { float ways[]; }; // as in list_check.glsl
layout(std430, binding = 6) buffer Bounds { GridBounds bounds; };
layout(push_constant) uniform Push { GridPush push; };

// Speeds count as they are: nothing at rest moves on with others. So do the ways of all particles then. Driven
// particles stay on their paths: cells become so wide that they are found.
void main() {
    const uint i = itemIndex(push.count);
    const vec3 v = velocities[i].xyz;
    const float way = wayOf(step.h, v);
    if (hasWays) ways[i] = way;
    if (!isHurrying(radii[i], way, push.quiet, push.most)) return;
    if (velocities[i].w == 0.0) {
        atomicMax(bounds.drivenWay, floatBitsToUint(radii[i] + way));
        return;
    }
    const float share = 0.999 * max(push.most - radii[i], push.quiet) / way;
    const vec3 change = (share - 1.0) * v;
    velocities[i].xyz = v + change;
    positions[i].xyz += step.h * change;
    if (hasWays) ways[i] = share * way;
    atomicAdd(status.slowed, 1u);
}
