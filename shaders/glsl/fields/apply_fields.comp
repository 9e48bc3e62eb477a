#version 460
// Kicks particles by the force fields of the host. For `split` and `jacobi` at the start of a substep: the kick joins
// that of gravity. OPEN: the substep of `gauss_seidel` is still open (solve_attachments.comp). Each particle reads itself
// alone. Particles that are fixed or asleep have an inverse mass of 0.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"
#include "common/remainder.glsl"
#include "fields/noise.glsl"

layout(std430, binding = 0) readonly buffer Requests { FieldRequest requests[]; };
layout(std430, binding = 1) readonly buffer Bodies { uint bodies[]; }; // by slot: index into Scene::bodies
layout(std430, binding = 2) readonly buffer CornersOf { FieldCorners cornersOf[]; }; // by slot
layout(std430, binding = 3) readonly buffer Areas { vec4 areas[]; };   // measure_areas.comp
layout(std140, binding = 4) uniform Step { StepParams step; };
#ifdef OPEN
layout(std430, binding = 5) readonly buffer Positions { vec4 positions[]; };   // predicted [m]
layout(std430, binding = 6) readonly buffer Velocities { vec4 velocities[]; }; // of the prediction; w = inverse mass [1/kg]
layout(std430, binding = 7) buffer Corrections { vec4 corrections[]; };        // ParticleCorrection
#else
layout(std430, binding = 5) buffer Positions { vec4 positions[]; };   // x + thetaH v [m]
layout(std430, binding = 6) buffer Velocities { vec4 velocities[]; }; // w = inverse mass [1/kg]
#endif
layout(push_constant) uniform Push { FieldPush push; };

// Share of a field at x: 1 everywhere, or falling smoothly from the centre to the edge of its region.
float shareAt(FieldRequest field, vec3 x) {
    if (field.center.w == 0.0) return 1.0;
    const vec3 far = (x - field.center.xyz) / field.center.w;
    const float fall = max(1.0 - dot(far, far), 0.0);
    return fall * fall;
}

// Change of velocity by the pressure of the air on the surface that the particle stands for, in the time `kick`:
// quadratic in the relative speed u along the normal of each triangle, one after another, and implicit in it, so that
// u keeps its sign for any strength.
vec3 windKick(uint i, FieldRequest field, vec3 v, float w, float kick) {
    const FieldCorners own = cornersOf[i];
    const bool isClosed = (own.count & FIELD_CLOSED) != 0u;
    vec3 sum = vec3(0.0);
    for (uint k = own.first; k < own.first + (own.count & ~FIELD_CLOSED); ++k) {
        const vec3 area = areas[k].xyz;
        const float size = length(area);
        const vec3 n = area / max(size, 1e-30);
        const float u = dot(field.vector.xyz - v - sum, n);
        if (isClosed && u > 0.0) continue; // the lee side
        const float lost = min(kick * w * (field.vector.w * size) * abs(u), 1e30);
        sum += u * lost / (1.0 + lost) * n;
    }
    return sum;
}

vec3 kickOf(uint i, FieldRequest field, vec3 x, vec3 v, float w, float kick) {
    const float share = shareAt(field, x);
    if (share == 0.0) return vec3(0.0);
    const vec3 way = x - field.center.xyz;
    switch (field.kind) {
    case FIELD_UNIFORM: return kick * share * field.vector.xyz;
    case FIELD_RADIAL: return kick * share * field.vector.w * inversesqrt(max(dot(way, way), 1e-30)) * way;
    case FIELD_WIND: return windKick(i, field, v, w, kick * share);
    case FIELD_TURBULENCE: return kick * share * field.vector.w * smoothNoise((x - field.vector.xyz) / field.scale);
    }
    return vec3(0.0);
}

// The kick of all fields, one after another.
vec3 kickOfAll(uint i, vec3 x, vec3 v, float w, float kick) {
    const uint body = bodies[i];
    vec3 sum = vec3(0.0);
    for (uint f = 0u; f < push.fields; ++f) {
        const FieldRequest field = requests[f];
        if (field.kind == FIELD_NONE || (field.body != FIELD_ALL_BODIES && field.body != body)) continue;
        sum += kickOf(i, field, x, v + sum, w, kick);
    }
    return sum;
}

void main() {
    const uint i = itemIndex(push.count);
    if (i >= push.count) return;
    const float w = velocities[i].w;
    if (w == 0.0) return;
#ifdef OPEN
    const vec3 correction = corrections[i].xyz, v = velocities[i].xyz + correction / step.h;
    corrections[i].xyz = correction + step.h * kickOfAll(i, positions[i].xyz + correction, v, w, step.h);
#else
    const vec3 y = positions[i].xyz, v = velocities[i].xyz;
    const float thetaH = push.isFirst != 0u ? step.thetaHPrevious : step.thetaH;
    const float kick = push.isFirst != 0u ? 0.5 * (step.hPrevious + step.h) : step.h;
    const vec3 dv = kickOfAll(i, y - thetaH * v, v, w, kick);
    velocities[i].xyz = v + dv;
    const float early = thetaH - push.lateKick * step.h;
    if (early == 0.0) return;
    if (hasRemainders) {
        const uint r = remainderOf(positions.length(), i);
        const Sum sum = exactSum(y, positions[r].xyz + early * dv);
        positions[i].xyz = sum.rounded;
        positions[r].xyz = sum.remainder;
    } else {
        positions[i].xyz = y + early * dv;
    }
#endif
}
