// The place of a block: the weighted mean of its children, relative to the first one, since weights sum to 1 but for
// rounding. The kernel declares childAt(i) and CHILD_POSITION(index).
vec3 placeOf(uint b) {
    const uint first = b * LEVEL_CHILDREN;
    const vec3 x = CHILD_POSITION(childAt(first).x);
    vec3 sum = vec3(0.0);
    [[unroll]] for (uint c = 1u; c < LEVEL_CHILDREN; ++c) {
        const uvec2 child = childAt(first + c);
        sum += uintBitsToFloat(child.y) * (CHILD_POSITION(child.x) - x);
    }
    return x + sum;
}
