// Buffers of gather_contacts for pairs with contact memory, and what they remember; PLANE_BINDING is the first binding
// after them.
layout(constant_id = 3) const bool hasFriction = false;
layout(constant_id = 4) const bool hasRecovery = false;
layout(constant_id = 5) const bool keepsRest = false;
layout(constant_id = 6) const bool hasMemory = false;
layout(constant_id = 7) const bool hasSurfaces = false; // pairs differ
layout(constant_id = 13) const bool hasRebound = false; // of planes
FETCHED_VEC4(10, Before, beforeAt)                           // velocities before the substep
layout(std430, binding = 11) buffer Slips { vec4 slips[]; }; // slip; w = remaining overlap, below 0 = keeps its rest distance [m]
layout(std430, binding = 12) readonly buffer Surfaces { uint surfaces[]; }; // by particle
layout(std430, binding = 13) readonly buffer Pairs { SurfacePair pairs[]; };
#define BEFORE(i) beforeAt(i).xyz
#define PLANE_BINDING 14
#define HAS_REBOUND hasRebound

// Coefficients of friction of a pair: kinetic, static.
vec2 frictionOf(uint i, uint j) {
    if (!hasSurfaces) return vec2(push.friction, push.staticFriction);
    const SurfacePair pair = pairs[surfaces[i] * push.surfaces + surfaces[j]];
    return vec2(pair.friction, pair.staticFriction);
}
