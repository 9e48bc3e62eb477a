#version 460
// Lists every pair of particles that is nearer than touching and a margin, once for each of the two, in any order:
// sort_contacts sorts. A list that is too short loses what does not fit and says how long it should be.
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

bool isNear(uint i, uint j, float radius, vec3 d) {
    const float reach = radius + (hasOneRadius ? radius : RADIUS(j)) + push.margin;
    return i != j && dot(d, d) < reach * reach && !isExcluded(i, j);
}

void list(uint i, uint s, uint j) {
    if (s < push.capacity) candidates[s * push.row + i] = j;
}

// Appends those of a row of three cells to particle i's list of n. A batch of a range is measured first and the few that
// may be near are looked at then: what stands under a condition is what costs.
void searchRow(uint i, vec3 x, float radius, ivec3 home, ivec2 row, Frame frame, uint total, inout uint n) {
    const uint slot = slotOf(ivec3(home.x - 1, row), frame), end = START(slot + 3u);
    const float reach = radius + push.most + push.margin;
    for (uint first = START(slot); first < end && n <= push.limit; first += 32u) {
        const uint last = min(first + 32u, end);
        uint near = 0u;
        for (uint k = first; k < last; ++k) {
            const vec3 d = x - uintBitsToFloat(SORTED(k < total ? k : k - total).xyz);
            near |= uint(dot(d, d) < reach * reach) << k - first;
        }
        for (; near != 0u; near &= near - 1u) {
            const uint k = first + uint(findLSB(near));
            const uvec4 other = SORTED(k < total ? k : k - total);
            const vec3 xj = uintBitsToFloat(other.xyz);
            if (cellOf(xj, frame).yz == row && isNear(i, other.w, radius, x - xj)) list(i, n++, other.w);
        }
    }
}

// Pairs with a large particle: small ones enter both copies, of two large ones each enters its own.
void searchLarge(uint i, vec3 x, float radius, bool isLarge, inout uint n) {
    for (uint l = 0u; l < push.large; ++l) {
        const uint j = large[l];
        if (!isNear(i, j, radius, x - POSITION(j).xyz)) continue;
        if (isLarge) list(i, atomicAdd(found[i], 1u), j);
        else {
            list(i, n++, j);
            list(j, atomicAdd(found[j], 1u), i);
        }
    }
}

void main() {
    const uint i = itemIndex(push.count);
    const vec3 x = POSITION(i).xyz;
    const float radius = RADIUS(i);
    const bool isSmall = isInGrid(radius, push.most);
    uint n = 0u;
    if (isSmall) {
        const Frame frame = frameOf(bounds, push.cells, push.edge);
        const ivec3 home = cellOf(x, frame);
        const uint total = START(push.cells);
        for (int dz = -1; dz <= 1; ++dz)
            for (int dy = -1; dy <= 1; ++dy)
                searchRow(i, x, radius, home, home.yz + ivec2(dy, dz), frame, total, n);
    }
    if (radius >= 0.0) searchLarge(i, x, radius, !isSmall, n);
    if (isSmall) found[i] = n;
}
