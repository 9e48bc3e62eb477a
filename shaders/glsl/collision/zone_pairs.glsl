// Two parts that pass each other in a substep join one zone. Requires the buffers words and pairs.
#include "collision/zone_trees.glsl"

void enlist(uint i) {
    if (atomicCompSwap(PARENT(i), 0u, i + 1u) == 0u) MEMBER(atomicAdd(words[ZONE_MEMBER_COUNT], 1u)) = i;
}

// A root is only attached to a lower one, by an exchange that fails if another invocation was faster.
void join(uint i, uint j) {
    uint a = rootOf(i), b = rootOf(j);
    while (a != b) {
        const uint high = max(a, b), low = min(a, b);
        if (atomicCompSwap(PARENT(high), high + 1u, low + 1u) == high + 1u) return;
        a = rootOf(high);
        b = rootOf(low);
    }
}

// The four particles of two parts that pass each other.
void addPair(uvec4 all, float time) {
    enlist(all.x);
    for (uint k = 1u; k < 4u; ++k) {
        enlist(all[k]);
        join(all.x, all[k]);
    }
    const uint place = atomicAdd(words[ZONE_PAIR_COUNT], 1u);
    if (place < ZONE_PAIRS) pairs[place] = ZonePair(all.x, time);
}

// Whether they have been solved as one zone: they have one motion.
bool areSolved(uvec4 all) {
    const uint zone = SOLVED(all.x);
    return zone != 0u && SOLVED(all.y) == zone && SOLVED(all.z) == zone && SOLVED(all.w) == zone;
}
