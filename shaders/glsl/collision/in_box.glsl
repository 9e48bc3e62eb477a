// True if x is within `reach` of a box. Requires common/math.glsl.
bool isInBox(vec3 low, vec3 high, vec3 x, float reach) {
    const vec3 d = max(max(low - x, x - high), vec3(0.0));
    return dot3(d, d) < reach * reach;
}
