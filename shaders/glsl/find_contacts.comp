#version 460
// Lists every pair of particles that is nearer than touching and a margin with both of the two, in any order:
// sort_contacts sorts. A list that is too short loses what does not fit and says how long it should be. SWEPT: in a substep
// in which particles may have met on their way; fast ones are then searched one by one, like large ones.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "kernel.glsl"
#include "hash_grid.glsl"

#ifdef TEXELS
layout(binding = 0) uniform usamplerBuffer sorted;
layout(binding = 1) uniform usamplerBuffer starts;
layout(binding = 2) uniform samplerBuffer positions;
layout(binding = 3) uniform samplerBuffer radii;
#define SORTED(i) texelFetch(sorted, int(i))
#define START(i) texelFetch(starts, int(i)).x
#define POSITION(i) texelFetch(positions, int(i))
#define RADIUS(i) texelFetch(radii, int(i)).x
#else
layout(std430, binding = 0) readonly buffer Sorted { uvec4 sorted[]; };
layout(std430, binding = 1) readonly buffer Starts { uint starts[]; };
layout(std430, binding = 2) readonly buffer Positions { vec4 positions[]; };
layout(std430, binding = 3) readonly buffer Radii { float radii[]; };
#define SORTED(i) sorted[i]
#define START(i) starts[i]
#define POSITION(i) positions[i]
#define RADIUS(i) radii[i]
#endif
layout(std140, binding = 4) uniform Bounds { GridBounds bounds; };
layout(std430, binding = 5) buffer Found { uint found[]; }; // candidates of each particle, listed or not; 0 at first
layout(std430, binding = 6) writeonly buffer Candidates { uint candidates[]; };
layout(std430, binding = 7) readonly buffer Large { uint large[]; };
#ifdef HAS_EXCLUSIONS
layout(std430, binding = 8) readonly buffer Excluded { uint excluded[]; }; // first of each particle, then the lists, sorted
#endif
#ifdef SWEPT
#ifdef HAS_EXCLUSIONS
#define SWEPT_BINDING 9
#else
#define SWEPT_BINDING 8
#endif
#include "contacts.glsl"
layout(std430, binding = SWEPT_BINDING) readonly buffer Velocities { vec4 velocities[]; }; // with which they came here
layout(std430, binding = SWEPT_BINDING + 1) readonly buffer Fast { uint fast[]; };
layout(std140, binding = SWEPT_BINDING + 2) uniform Step { StepParams step; };
#endif
layout(push_constant) uniform Push { FindPush push; };
layout(constant_id = 1) const bool hasOneRadius = false;

bool isExcluded(uint i, uint j) {
#ifdef HAS_EXCLUSIONS
    uint low = excluded[i], high = excluded[i + 1u];
    const uint end = high;
    while (low < high) {
        const uint middle = (low + high) / 2u;
        if (excluded[middle] < j) low = middle + 1u;
        else high = middle;
    }
    return low < end && excluded[low] == j;
#else
    return false;
#endif
}

#include "sweep.glsl"

bool isNear(uint i, uint j, float radius, vec3 d) {
    const float touching = radius + (hasOneRadius ? radius : RADIUS(j)), reach = touching + push.margin;
    return i != j && (dot(d, d) < reach * reach || wasNear(i, j, touching, d)) && !isExcluded(i, j);
}

// Appends each of the two to the other's list.
void list(uint i, uint j) {
    const uint s = atomicAdd(found[i], 1u), t = atomicAdd(found[j], 1u);
    if (s < push.capacity) candidates[s * push.row + i] = j;
    if (t < push.capacity) candidates[t * push.row + j] = i;
}

// Lists those near particle i among three rows of cells; n counts them. The rows are visited in one loop, because lanes
// wait for the longest list among them: of three rows together it is less above the mean than of one. A batch is measured
// first and the few that may be near are looked at then: what stands under a condition is what costs.
void searchRows(uint i, vec3 x, float radius, ivec3 home, ivec3 firstCells[3], uint cells[3], Frame frame, uint total,
                inout uint n) {
    uint start[3], count[3];
    [[unroll]] for (int row = 0; row < 3; ++row) {
        const uint slot = slotOf(firstCells[row], frame);
        start[row] = START(slot);
        count[row] = START(slot + cells[row]) - start[row];
    }
    const uint second = count[0], third = second + count[1], all = third + count[2];
    start[1] -= second;
    start[2] -= third;
    const float reach = wideOf(i, radius) + push.most + push.margin;
    for (uint first = 0u; first < all && n <= push.limit; first += 32u) {
        const uint last = min(first + 32u, all);
        uint near = 0u;
        for (uint visit = first; visit < last; ++visit) {
            const uint k = visit + (visit < second ? start[0] : visit < third ? start[1] : start[2]);
            const vec3 d = x - uintBitsToFloat(SORTED(k < total ? k : k - total).xyz);
            near |= uint(dot(d, d) < reach * reach) << visit - first;
        }
        for (; near != 0u; near &= near - 1u) {
            const uint visit = first + uint(findLSB(near));
            const uint k = visit + (visit < second ? start[0] : visit < third ? start[1] : start[2]);
            const uvec4 other = SORTED(k < total ? k : k - total);
            const vec3 xj = uintBitsToFloat(other.xyz);
            const ivec3 cell = cellOf(xj, frame);
            const ivec2 row = firstCells[visit < second ? 0 : visit < third ? 1 : 2].yz;
            if (cell.yz != row || cell == home && other.w <= i) continue; // of two in one cell the first lists both
            if (isFast(other.w) || !isNear(i, other.w, radius, x - xj)) continue;
            list(i, other.w);
            ++n;
        }
    }
}

// Half of the 27 cells around a particle: those behind its own in z, y, x, and its own. A pair is found once.
void searchCells(uint i, vec3 x, float radius, Frame frame) {
    const ivec3 home = cellOf(x, frame);
    const uint total = START(push.cells);
    uint n = 0u;
    searchRows(i, x, radius, home, ivec3[3](home, home + ivec3(-1, 1, 0), home), uint[3](2u, 3u, 0u), frame, total, n);
    searchRows(i, x, radius, home,
               ivec3[3](home + ivec3(-1, -1, 1), home + ivec3(-1, 0, 1), home + ivec3(-1, 1, 1)), uint[3](3u, 3u, 3u),
               frame, total, n);
}

// A pair with a particle that is searched one by one: small ones enter both copies, of two such the first does.
void searchOne(uint i, vec3 x, float radius, bool isSmall, uint j) {
    if ((isSmall || i < j) && isNear(i, j, radius, x - POSITION(j).xyz)) list(i, j);
}

void main() {
    const uint i = itemIndex(push.count);
    const vec3 x = POSITION(i).xyz;
    const float radius = RADIUS(i);
    const bool isSmall = isInGrid(radius, push.most) && !isFast(i);
    if (isSmall) searchCells(i, x, radius, frameOf(bounds, push.cells, push.edge));
    if (radius < 0.0) return;
    for (uint l = 0u; l < push.large; ++l) searchOne(i, x, radius, isSmall, large[l]);
#ifdef SWEPT
    for (uint f = 0u; f < bounds.fast; ++f) searchOne(i, x, radius, isSmall, fast[f]);
#endif
}
