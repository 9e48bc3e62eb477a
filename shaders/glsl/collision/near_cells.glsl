// Part of find_contacts: searches the hash grid around a particle. Requires the names of that kernel.
#include "common/share_band.h"

// Distance up to which a pair with this sum of radii is listed [m]: it counts in shares a little beyond touching.
float listedUpTo(float touching) { return (1.0 + SHARE_BAND) * touching + push.margin; }

// onWay: or nearer than touching on its path.
bool isNear(uint i, uint j, float radius, vec3 d, bool onWay) {
    const float touching = radius + (hasOneRadius ? radius : RADIUS(j)), listed = listedUpTo(touching);
    return i != j && (dot(d, d) < listed * listed || onWay && wasNear(i, j, touching, d)) && !isExcluded(min(i, j), max(i, j));
}

void list(uint i, uint j) {
    const uint pair = newPair();
    if (pair == noPair) return;
    const uint next = atomicExchange(chains[i], 2u * pair + 1u), nextOfOther = atomicExchange(chains[j], 2u * pair + 2u);
    pairs[pair] = uvec4(i, j, next, nextOfOther);
}

// Three rows of cells: of the own layer in z those behind the own cell, and that; or all of the next layer.
ivec3 firstCellOf(ivec3 home, int layer, int row) {
    return home + ivec3(layer == 1 || row == 1 ? -1 : 0, row - layer, layer);
}
uint cellsOf(int layer, int row) { return layer == 1 || row == 1 ? 3u : row == 0 ? 2u : 0u; }

// Lists the near particles of particle i in three rows of cells. The rows are visited in one loop, because lanes wait
// for the longest list among them, and the length of three rows together exceeds the mean by less than that of one. A
// batch is measured first and only the few that may be near are processed then: branches are what costs.
void searchRows(uint i, vec3 x, float radius, ivec3 home, int layer, Frame frame, uint total) {
    uint start[3], count[3];
    [[unroll]] for (int row = 0; row < 3; ++row) {
        const uint slot = slotOf(firstCellOf(home, layer, row), frame);
        start[row] = START(slot);
        count[row] = START(slot + cellsOf(layer, row)) - start[row];
    }
    const uint second = count[0], third = second + count[1], all = third + count[2];
    start[1] -= second;
    start[2] -= third;
    const float reach = listedUpTo(wideOf(i, radius) + mostInCells);
    for (uint first = 0u; first < all && !isFull(); first += 32u) {
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
            const ivec3 rowStart = firstCellOf(home, layer, visit < second ? 0 : visit < third ? 1 : 2);
            if (cell.yz != rowStart.yz || cell == home && other.w <= i) continue; // in one cell the smaller index lists the pair
            if (isFast(other.w) || !isNear(i, other.w, radius, x - xj, isSwept)) continue;
            list(i, other.w);
        }
    }
}

// Searches half of the 27 cells around a particle: those after its own in z, y, x, and its own. A pair is found once. One copy of the
// search code serves both layers, which halves the kernel.
void searchCells(uint i, vec3 x, float radius, Frame frame) {
    const ivec3 home = cellOf(x, frame);
    const uint total = START(push.cells);
    [[dont_unroll]] for (int layer = 0; layer < 2; ++layer) searchRows(i, x, radius, home, layer, frame, total);
}
