#version 460
// Interlocked bodies, second pass: each contact with a partner body separates the two particles, with a share 1 /
// (number of such contacts) of the mass of each, like gather_contacts; momentum is exact to rounding. Ordinary
// contacts come after.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"
#include "collision/interlocks.glsl"

layout(std430, binding = 5) readonly buffer Pairs { InterlockPair pairs[]; };
layout(std430, binding = 6) readonly buffer Touching { vec4 touching[]; }; // x, contacts x inverse mass
layout(std430, binding = 8) readonly buffer Moving { vec4 moving[]; };
layout(std430, binding = 9) buffer Predicted { vec4 predicted[]; };   // w: not changed
layout(std430, binding = 10) buffer Velocities { vec4 velocities[]; }; // w = inverse mass [1/kg]
#include "forces/forces.glsl"

vec3 impulseFrom(uint i, uvec2 candidate, vec4 self, vec3 velocity) {
    const uint j = candidate.x;
    const vec4 other = touching[j];
    const vec3 d = self.xyz - other.xyz;
    const float reach = uintBitsToFloat(candidate.y);
    if (!touches(d, reach)) return vec3(0.0);
    const vec3 n = normalOf(i, j, d), way = step.h * (velocity - moving[j].xyz);
    if (keepsForces && self.w + other.w == 0.0) return vec3(0.0); // two static particles exchange nothing
    return partingOf(n, d, way, reach, step.h * push.recoverySpeed) / max(self.w + other.w, 1e-30) * n;
}

void main() {
    const uint i = itemIndex(push.count), body = nodes[i].body;
    const uvec2 list = body > 0u ? lists[i] : uvec2(0u);
    const vec4 self = touching[i], velocity = moving[i];
    vec3 sum = vec3(0.0);
    for (uint slot = list.x; slot < list.x + list.y; ++slot) {
        const uvec2 candidate = contacts[slot];
        const uint other = nodes[candidate.x].body, pair = other > 0u ? pairOf(body, other) : noPair;
        if (pair == noPair || pairs[pair].state != INTERLOCK_PARTING) continue;
        sum += impulseFrom(i, candidate, self, velocity.xyz);
    }
    addContactForce(i, sum / step.h);
    const vec3 correction = velocity.w * sum;
    predicted[i].xyz = self.xyz + correction;
    velocities[i].xyz = velocity.xyz + correction / step.h;
}
