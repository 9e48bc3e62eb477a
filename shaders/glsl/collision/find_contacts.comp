#version 460
// Lists every pair of particles nearer than 1 + SHARE_BAND times its reach, and a margin, in any order: sort_lists
// sorts. SWEPT: in a substep in which contacts may lie on the paths of many particles. Fast ones are searched one by
// one, like large ones.
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
layout(std430, binding = 8) readonly buffer Excluded { uint excluded[]; }; // first of each particle, then partners in later slots, sorted
#include "common/contacts.glsl"
layout(std430, binding = 9) readonly buffer Velocities { vec4 velocities[]; }; // that led to these positions
layout(std430, binding = 10) readonly buffer Fast { uint fast[]; };
layout(std140, binding = 11) uniform Step { StepParams step; };
layout(constant_id = 14) const bool hasWays = false;
layout(std430, binding = 12) readonly buffer Ways { float ways[]; }; // as in list_check.glsl
layout(push_constant) uniform Push { FindPush push; };
#define FINDS_PAIRS
#define ENTRIES_OF_PAIR 2u
#include "collision/listed_pairs.glsl"
layout(constant_id = 1) const bool hasOneRadius = false;

layout(constant_id = 2) const bool hasExclusions = false;
#define EXCLUDED(k) excluded[k]
#define ANY_EXCLUDED hasExclusions
#include "collision/excluded.glsl"
#ifdef SWEPT
const bool isSwept = true;
#else
const bool isSwept = false;
#endif
#include "collision/sweep.glsl"
#include "collision/near_cells.glsl"

// A pair with a particle that is searched one by one: listed by the small particle, or, of two that are not small, by
// the first.
void searchOne(uint i, vec3 x, float radius, bool isSmall, uint j) {
    if ((isSmall || i < j) && isNear(i, j, radius, x - POSITION(j).xyz, true)) list(i, j);
}

// Fast particles in batches: most are near none, so a batch is measured first.
void searchFast(uint i, vec3 x, float radius, bool isSmall) {
    const float own = listedUpTo(radius);
    const vec3 way = wayOf(i);
    for (uint first = 0u; first < fastParticles; first += 32u) {
        uint near = 0u;
        for (uint f = first; f < min(first + 32u, fastParticles); ++f) {
            const uint j = fast[FIRST_FAST + f];
            const vec3 against = way - wayOf(j); // a stray may come near a body that has another frame
            const float reach = own + (1.0 + SHARE_BAND) * RADIUS(j) + 1.001 * length(against);
            const vec3 d = x - POSITION(j).xyz;
            near |= uint(dot(d, d) < reach * reach) << f - first;
        }
        for (; near != 0u; near &= near - 1u) searchOne(i, x, radius, isSmall, fast[FIRST_FAST + first + uint(findLSB(near))]);
    }
}

// The particles of the grid in the order of its cells, so that lanes of a group search the same cells, then large ones.
void main() {
    const uint item = placeOfAll(), inGrid = START(push.cells);
    if (item >= inGrid + push.large) return;
    const uint i = item < inGrid ? SORTED(item).w : large[item - inGrid];
    const vec3 x = POSITION(i).xyz;
    const float radius = RADIUS(i);
    const bool isSmall = item < inGrid && !isFast(i);
    if (isSmall) searchCells(i, x, radius, frameOf(bounds, push.cells));
    if (radius < 0.0) return;
    for (uint l = 0u; l < push.large; ++l)
        if (RADIUS(large[l]) >= 0.0) searchOne(i, x, radius, isSmall, large[l]);
    searchFast(i, x, radius, isSmall);
}
