#version 460
// Lists every pair of particles nearer than 1 + SHARE_BAND times its reach, and a margin, in any order: sort_lists
// sorts. SWEPT: in a substep with possible impacts between particles; fast ones are then searched one by one, like
// large ones.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "common/kernel.glsl"
#include "collision/hash_grid.glsl"

#include "common/fetched.glsl"
FETCHED_UVEC4(0, Sorted, sortedAt)
FETCHED_UINT(1, Starts, startAt)
FETCHED_VEC4(2, Positions, positionAt)
FETCHED_FLOAT(3, Radii, radiusOf)
#define SORTED(i) sortedAt(i)
#define START(i) startAt(i)
#define POSITION(i) positionAt(i)
#define RADIUS(i) radiusOf(i)
layout(std430, binding = 4) coherent volatile buffer Bounds { GridBounds bounds; };
layout(std430, binding = 5) buffer Chains { uint chains[]; };
#define PAIRS_BINDING 6
layout(std430, binding = 7) readonly buffer Large { uint large[]; };
layout(std430, binding = 8) readonly buffer Excluded { uint excluded[]; }; // first of each particle, then the lists, sorted
#ifdef SWEPT
#include "common/contacts.glsl"
layout(std430, binding = 9) readonly buffer Velocities { vec4 velocities[]; }; // that led to these positions
layout(std430, binding = 10) readonly buffer Fast { uint fast[]; };
layout(std140, binding = 11) uniform Step { StepParams step; };
#endif
layout(push_constant) uniform Push { FindPush push; };
#define FINDS_PAIRS
#define ENTRIES_OF_PAIR 2u
#include "collision/listed_pairs.glsl"
layout(constant_id = 1) const bool hasOneRadius = false;

layout(constant_id = 2) const bool hasExclusions = false;
#define EXCLUDED(k) excluded[k]
#define ANY_EXCLUDED hasExclusions
#include "collision/excluded.glsl"
#include "collision/sweep.glsl"
#include "collision/near_cells.glsl"

// A pair with a particle that is searched one by one: listed by the small particle, or, of two that are not small, by
// the first.
void searchOne(uint i, vec3 x, float radius, bool isSmall, uint j) {
    if ((isSmall || i < j) && isNear(i, j, radius, x - POSITION(j).xyz)) list(i, j);
}

void main() {
    const uint i = itemIndex(push.count);
    const vec3 x = POSITION(i).xyz;
    const float radius = RADIUS(i);
    const bool isSmall = isInGrid(radius, push.most) && !isFast(i);
    if (isSmall) searchCells(i, x, radius, frameOf(bounds, push.cells));
    if (radius < 0.0) return;
    for (uint l = 0u; l < push.large; ++l)
        if (RADIUS(large[l]) >= 0.0) searchOne(i, x, radius, isSmall, large[l]);
#ifdef SWEPT
    for (uint f = 0u; f < bounds.fast; ++f) searchOne(i, x, radius, isSmall, fast[f]);
#endif
}
