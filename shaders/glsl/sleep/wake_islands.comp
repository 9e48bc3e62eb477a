#version 460
// Wakes the particles of marked islands: restores their inverse masses, and makes their groups run, also for driven
// particles. Their resting time starts again at the end of the step. Within a substep, after links were solved: loose
// particles then also get the gravity of this substep, as gather_split would have given it. Linked ones do not, since
// the links that bear them have not been solved either.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"
#include "common/remainder.glsl"
#include "sleep/sleep.glsl"

layout(std430, binding = 0) readonly buffer Weights { float weights[]; }; // inverse mass of awake particles [1/kg]
layout(std430, binding = 1) buffer Velocities { vec4 velocities[]; };
layout(std430, binding = 2) readonly buffer Islands { uint islands[]; };
layout(std430, binding = 3) readonly buffer Marks { uint marks[]; };
layout(std430, binding = 4) buffer Groups { uint groups[]; }; // one per work group of particles: bit 0 = any awake
layout(constant_id = 15) const bool fall = false; // loose particles that wake get the gravity of the substep
layout(constant_id = 16) const bool isFirst = false; // substep of the step
layout(std430, binding = 5) buffer Predicted { vec4 predicted[]; }; // remainder.glsl
layout(std430, binding = 6) readonly buffer Loose { uint loose[]; }; // 1 = a particle without links
layout(std140, binding = 7) uniform Step { StepParams step; };
layout(push_constant) uniform Push { SleepPush push; };
#include "common/link_impulse.glsl"

void fallBy(uint i, vec3 way) {
    const Sum moved = exactSum(predicted[i].xyz, way);
    predicted[i].xyz = moved.rounded;
    if (hasRemainders) predicted[remainderOf(predicted.length(), i)].xyz += moved.remainder;
}

void main() {
    const uint i = itemIndex(push.count);
    const bool isDriven = weights[i] == SLEEP_DRIVEN;
    if (!isDriven && !isAsleep(weights[i], velocities[i]) || marks[islands[i]] == 0u) return;
    if (!isDriven) velocities[i].w = weights[i];
    if (fall && !isDriven && loose[i] != 0u) {
        const vec3 v = step.velocityFactor * (substepOf(isFirst).kick * step.gravity.xyz);
        velocities[i].xyz = v;
        fallBy(i, step.h * v);
    }
    atomicOr(groups[i / GROUP_SIZE], 1u);
}
