#version 460
// The particle pass of `gauss_seidel` between the sweeps of two substeps: `closes` the swept substep and `opens` the
// next. It follows the order of PBD with a half-kick of gravity, which is exact in free fall at any h.
//
//   open   p = x + h v + h^2 g / 2,  v* = v + h g,  c = -w sum l n, the warm start
//   close  x = p + c,  v = v* + c / h,  boundary planes, damping, restitution
//
// While a substep is open a particle is at p + c. Corrections c add up apart from p, whose rounding is far coarser: v
// taken from the difference of positions would wander by 1e-7 |x| / h a sweep, and momentum with it. The corrections
// join x in one sum with the motion of the next substep: alone, c = h^2 f w is less than half of the last bit of x
// where substeps are short, and a position that never receives c moves as in explicit Euler, which gains energy.
// If x has a remainder (remainder.glsl), c begins with it: sweeps then see the remainder, and it is no part of the
// change of v.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "common/kernel.glsl"
#include "common/remainder.glsl"

layout(std430, binding = 0) buffer Positions { vec4 positions[]; };   // x, while open p; w = inverse mass [1/kg]
layout(std430, binding = 1) buffer Velocities { vec4 velocities[]; }; // v, while open v* [m/s]; w = inverse mass
layout(std430, binding = 2) buffer Corrections { uvec4 corrections[]; }; // ParticleCorrection, in one load
layout(std140, binding = 3) uniform Step { StepParams step; };
#include "common/fetched.glsl"
FETCHED_UINT(4, Links, linkAt) // see WARM_LINK_SIGN; blocks as in `split`
FETCHED_VEC4(5, Multipliers, multiplierAt) // l n, l
#define LINK(i) linkAt(i)
#define MULTIPLIER(i) multiplierAt(i)
layout(constant_id = 1) const uint degree = 0; // of a warm start: slots per particle, padded
layout(constant_id = 3) const bool opens = true;
layout(constant_id = 4) const bool closes = true;
#include "rigid/planes.glsl"
layout(std140, binding = 6) uniform Planes { PlaneCollider planes[MOST_PLANES]; };
layout(std430, binding = 7) readonly buffer ContactOffsets { float contactOffsets[]; };
layout(push_constant) uniform Push { SubstepPush push; };

#include "forces/forces.glsl"
#include "solvers/close_substep.glsl"
#include "solvers/warm_start.glsl"

void main() {
    // No early out: buffers are padded to whole groups with particles that never move.
    const uint i = itemIndex(push.count);
    const vec3 x = positions[i].xyz;
    vec3 v = velocities[i].xyz;
    const uint r = hasRemainders ? remainderOf(positions.length(), i) : i;
    vec3 way = hasRemainders ? positions[r].xyz : vec3(0.0); // displacement from x [m]
    const float w = velocities[i].w;
    const vec3 halfKick = 0.5 * step.h * step.gravity.xyz;
    if (closes && w > 0.0) way = close(i, halfKick, x, way, v);
    if (opens && w > 0.0) {
        way += step.h * (v + halfKick);
        v += 2.0 * halfKick;
    }
    if (opens) {
        vec3 correction = vec3(0.0);
        if (degree > 0u) correction = w * warmImpulses(i);
        if (hasRemainders) correction += exactSum(x, way).remainder;
        corrections[i] = uvec4(floatBitsToUint(correction), 0u);
    }
    positions[i].xyz = x + way;
    if (hasRemainders) positions[r].xyz = exactSum(x, way).remainder;
    velocities[i].xyz = v;
}
