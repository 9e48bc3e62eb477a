#version 460
// Pulls attached particles to their moving points at the end of a substep, each by itself: XPBD [Macklin 2016], eq.
// 18, for one particle, solved exactly, so that any stiffness is stable; the spring's force is limited. One item an
// attachment, at most one attachment a particle. Serves every solver: thetaH is 0 except for `split`; the substep of
// `gauss_seidel` is still open (OPEN), so that a particle is at its predicted position plus its correction.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"
#include "constraints/compliance.glsl"

layout(std430, binding = 0) readonly buffer Attachments { AttachedParticle attachments[]; };
layout(std430, binding = 1) readonly buffer Anchors { vec4 anchors[]; }; // one per attachment: start and end of the step [m]
#ifdef OPEN
layout(std430, binding = 2) readonly buffer Positions { vec4 positions[]; }; // predicted; w = inverse mass [1/kg]
layout(std430, binding = 3) buffer Corrections { vec4 corrections[]; };      // ParticleCorrection
#else
layout(std430, binding = 2) buffer Positions { vec4 positions[]; };   // x + thetaH v
layout(std430, binding = 3) buffer Velocities { vec4 velocities[]; }; // w = inverse mass [1/kg]
#endif
layout(std140, binding = 4) uniform Step { StepParams step; };
layout(push_constant) uniform Push { AttachmentPush push; };
#include "forces/forces.glsl"

void main() {
    const uint a = itemIndex(push.count);
    if (a >= push.count) return;
    const AttachedParticle attachment = attachments[a];
    const uint i = attachment.particle;
#ifdef OPEN
    const vec3 correction = corrections[i].xyz, x = positions[i].xyz + correction;
    const float w = positions[i].w, h = step.h;
#else
    const vec4 velocity = velocities[i];
    const vec3 x = positions[i].xyz - step.thetaH * velocity.xyz;
    const float w = velocity.w, h = step.h;
#endif
    if (w == 0.0) return;
    const vec3 way = mix(anchors[2u * a].xyz, anchors[2u * a + 1u].xyz, push.fraction) - x;
    vec3 impulse = way / (w + scaledCompliance(attachment.compliance, h)); // [kg m] = force x h^2
    const float most = min(attachment.maxForce, 1e30) * h * h, size = length(impulse);
    if (size > most) impulse *= most / size;
    addHoldForce(i, impulse / h);
    addListedForce(a, impulse / h);
    const vec3 dx = w * impulse;
#ifdef OPEN
    corrections[i].xyz = correction + dx;
#else
    const vec3 v = velocity.xyz + dx / h;
    velocities[i].xyz = v;
    positions[i].xyz = x + dx + step.thetaH * v;
#endif
}
