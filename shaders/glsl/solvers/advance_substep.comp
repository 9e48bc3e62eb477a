#version 460
// The particle pass of `gauss_seidel` between the sweeps of two substeps: CLOSES the swept substep and OPENS the
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
#ifdef CLOSES
layout(std430, binding = 2) buffer Corrections { uvec4 corrections[]; }; // ParticleCorrection, in one load
#else
layout(std430, binding = 2) writeonly buffer Corrections { uvec4 corrections[]; };
#endif
layout(std140, binding = 3) uniform Step { StepParams step; };
#define PLANE_BINDING 4
#ifdef HAS_WARM_START
#ifdef TEXELS
layout(binding = 4) uniform usamplerBuffer links; // see WARM_LINK_SIGN; blocks as in `split`
layout(binding = 5) uniform samplerBuffer multipliers; // l n, l
#define LINK(i) texelFetch(links, int(i)).x
#define MULTIPLIER(i) texelFetch(multipliers, int(i))
#else
layout(std430, binding = 4) readonly buffer Links { uint links[]; };
layout(std430, binding = 5) readonly buffer Multipliers { vec4 multipliers[]; };
#define LINK(i) links[i]
#define MULTIPLIER(i) multipliers[i]
#endif
layout(constant_id = 1) const uint degree = 1; // slots per particle, padded
#undef PLANE_BINDING
#define PLANE_BINDING 6
#endif
#ifdef HAS_PLANES
#include "rigid/planes.glsl"
layout(std140, binding = PLANE_BINDING) uniform Planes { PlaneCollider planes[MOST_PLANES]; };
layout(std430, binding = PLANE_BINDING + 1) readonly buffer ContactOffsets { float contactOffsets[]; };
#endif
layout(push_constant) uniform Push { SubstepPush push; };

#include "forces/forces.glsl"
#ifdef CLOSES
#include "solvers/close_substep.glsl"
#endif
#ifdef HAS_WARM_START
#include "solvers/warm_start.glsl"
#endif

void main() {
    // No early out: buffers are padded to whole groups with particles that never move.
    const uint i = itemIndex(push.count);
    const vec3 x = positions[i].xyz;
    vec3 v = velocities[i].xyz;
    const uint r = hasRemainders ? remainderOf(positions.length(), i) : i;
    vec3 way = hasRemainders ? positions[r].xyz : vec3(0.0); // displacement from x [m]
    const float w = velocities[i].w;
    const vec3 halfKick = 0.5 * step.h * step.gravity.xyz;
#ifdef CLOSES
    if (w > 0.0) way = close(i, halfKick, x, way, v);
#endif
#ifdef OPENS
    if (w > 0.0) {
        way += step.h * (v + halfKick);
        v += 2.0 * halfKick;
    }
#ifdef HAS_WARM_START
    vec3 correction = w * warmImpulses(i);
#else
    vec3 correction = vec3(0.0);
#endif
    if (hasRemainders) correction += exactSum(x, way).remainder;
    corrections[i] = uvec4(floatBitsToUint(correction), 0u);
#endif
    positions[i].xyz = x + way;
    if (hasRemainders) positions[r].xyz = exactSum(x, way).remainder;
    velocities[i].xyz = v;
}
