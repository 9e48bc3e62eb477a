// Finds the slots of a skin that the blade of a step may meet. Requires blade_places.glsl and blade_points.glsl.
#include "common/math.glsl"

const float skinReach = 2.5; // largest distance of a skin vertex from its anchor, along an axis [cells]

// True if the blade may meet vertices with anchor i: projects the strip's quads and the box around the vertices onto
// the normal of each quad. A quad never extends beyond its four points in any direction; its normal separates best,
// as the axis-aligned box of a slanted quad covers nearly all of the body. Exact: several kernels test the same slot.
bool isNearBlade(uint i) {
    const vec3 now = PLACE(i), then = placeBefore(i);
    const float reach = skinReach * push.spacing;
    const vec3 least = min(now, then) - reach, most = max(now, then) + reach;
    if (any(greaterThan(least, blade.high.xyz)) || any(lessThan(most, blade.low.xyz))) return false;
    if (blade.rayFrom.w > 0.0) return true;
    vec3 e0 = POINT(0u), e1 = POINT(1u);
    for (uint q = 1u; q <= blade.quads; ++q) {
        const vec3 g0 = POINT(2u * q), g1 = POINT(2u * q + 1u);
        const vec3 ahead = g1 - e0, aside = e1 - g0, end0 = e1 - e0, end1 = g0 - e0, fromNow = now - e0, fromThen = then - e0;
        const vec3 across = cross3(ahead, aside);
        const float size = length3(across);
        if (!(size > 0.0)) return true;
        const vec3 normal = across / size;
        const vec3 heights = vec3(dot3(normal, end0), dot3(normal, end1), dot3(normal, ahead));
        const float a = dot3(normal, fromNow), b = dot3(normal, fromThen);
        const float far = reach * (abs(normal.x) + abs(normal.y) + abs(normal.z)), low = min(a, b) - far, high = max(a, b) + far;
        if (low <= max(max(heights.x, heights.y), max(heights.z, 0.0)) && high >= min(min(heights.x, heights.y), min(heights.z, 0.0)))
            return true;
        e0 = g0;
        e1 = g1;
    }
    return false;
}
