#version 460
// Long-range attachments (Kim 2012) at the end of a substep: a particle whose distance from a fixed one exceeds the
// length of the body between them is put back onto the sphere of that radius. The tethers of a particle are applied
// one after another; anchors never move. Serves every solver: thetaH is 0 except for `split`; the substep of
// `gauss_seidel` is still open (solve_attachments.comp).
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"

layout(std430, binding = 0) readonly buffer Particles { TetheredParticle particles[]; };
layout(std430, binding = 1) readonly buffer Tethers { TetherReach tethers[]; };
#ifdef OPEN
layout(std430, binding = 2) readonly buffer Positions { vec4 positions[]; }; // predicted; w = inverse mass [1/kg]
layout(std430, binding = 3) buffer Corrections { vec4 corrections[]; };      // ParticleCorrection
#else
layout(std430, binding = 2) buffer Positions { vec4 positions[]; };   // x + thetaH v
layout(std430, binding = 3) buffer Velocities { vec4 velocities[]; }; // w = inverse mass [1/kg]
#endif
layout(std140, binding = 4) uniform Step { StepParams step; };
layout(push_constant) uniform Push { CountPush push; };
#include "forces/forces.glsl"

void main() {
    const uint p = itemIndex(push.count);
    if (p >= push.count) return;
    const TetheredParticle tethered = particles[p];
    const uint i = tethered.particle;
#ifdef OPEN
    const vec3 correction = corrections[i].xyz, before = positions[i].xyz + correction;
    const float w = positions[i].w;
#else
    const vec4 velocity = velocities[i];
    const vec3 before = positions[i].xyz - step.thetaH * velocity.xyz;
    const float w = velocity.w;
#endif
    vec3 x = before;
    for (uint t = tethered.first; t < tethered.first + tethered.count; ++t) {
        const vec3 anchor = positions[tethers[t].anchor].xyz; // does not move: y = x
        const float distance = length(x - anchor);
        if (!(distance > tethers[t].reach)) continue;
        const vec3 loose = x;
        x = anchor + tethers[t].reach / distance * (x - anchor);
        const vec3 impulse = (x - loose) / (step.h * w);
        addHoldForce(i, impulse);
        addListedForce(t, impulse);
    }
    if (x == before) return;
#ifdef OPEN
    corrections[i].xyz = correction + (x - before);
#else
    const vec3 v = velocity.xyz + (x - before) / step.h;
    velocities[i].xyz = v;
    positions[i].xyz = x + step.thetaH * v;
#endif
}
