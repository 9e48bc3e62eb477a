// Most of many colliders are far from all particles of a work group. find_near_colliders.comp looks once a step for
// those near the box in which its particles may move in this step, and a particle whose path lies in the box tests
// those alone. What is left out is a collider that would give no contact, so results keep their bits; a particle that
// has left the box tests all. Included after colliders.glsl; the kernel declares `near` and `step`.

const bool findsNear = colliderCount > FEW_COLLIDERS; // few are tested one by one
const uint nearWords = (colliderCount + 31u) / 32u;

// First word of the record of the work group of particle i: low and high corner of the box, the longest path in a
// substep [m], the stamp of the step, a bit for each collider.
uint nearRecord(uint i) {
#ifdef MAY_RUN_LISTED
    return (runsOver >= RUNS_OVER_ITEMS ? i / GROUP_SIZE : listedGroup()) * (NEAR_HEAD + nearWords);
#else
    const uint place = isReversed ? gl_NumWorkGroups.x - 1u - gl_WorkGroupID.x : gl_WorkGroupID.x;
    return place * (NEAR_HEAD + nearWords);
#endif
}
uint stampOf(uint frame) { return frame ^ 0x80000000u; } // not that of an empty record

#ifndef WRITES_NEAR
vec3 nearCorner(uint word) { return uintBitsToFloat(uvec3(near[word], near[word + 1u], near[word + 2u])); }

// Whether a path is one of those that the record of its group is made for.
bool isRegarded(uint record, vec3 from, vec3 to) {
    return near[record + 7u] == stampOf(step.frame) && all(greaterThanEqual(min(from, to), nearCorner(record))) &&
           all(lessThanEqual(max(from, to), nearCorner(record + 3u))) &&
           length(to - from) <= uintBitsToFloat(near[record + 6u]);
}

// The first collider from c on that is to be tested: one of the record, or any. colliderCount if there is none. Where
// colliders are few a constant decides, as compilers do not see that testsNear stays false in a loop.
uint nextTested(bool testsNear, uint record, uint c) {
    if (!findsNear || !testsNear || c >= colliderCount) return c;
    uint w = c / 32u, bits = near[record + NEAR_HEAD + w] & ~0u << c % 32u;
    while (bits == 0u && ++w < nearWords) bits = near[record + NEAR_HEAD + w];
    return bits == 0u ? colliderCount : 32u * w + uint(findLSB(bits));
}
#endif
