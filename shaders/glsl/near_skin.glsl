// Part of the kernels that find which slots of a skin the blade of a step may meet. Whoever includes this has blade_places.glsl and
// blade_points.glsl.

const float skinReach = 2.5; // of what goes with a particle, along an axis [cells]

// A quad of the strip is nowhere beyond its four points, along whatever direction: along that across it says most, as its box, which lies along
// the axes, is nearly all of the body where a blade does not. What goes with a particle is in a box around it, too: so far that reaches.
bool isNearBlade(uint i) {
    const vec3 now = PLACE(i), then = placeBefore(i);
    const float reach = skinReach * push.spacing;
    if (any(greaterThan(min(now, then) - reach, blade.high.xyz)) || any(lessThan(max(now, then) + reach, blade.low.xyz))) return false;
    if (blade.rayFrom.w > 0.0) return true;
    vec3 e0 = POINT(0u), e1 = POINT(1u);
    for (uint q = 1u; q <= blade.quads; ++q) {
        const vec3 g0 = POINT(2u * q), g1 = POINT(2u * q + 1u), across = cross(g1 - e0, e1 - g0);
        const float size = length(across);
        if (!(size > 0.0)) return true;
        const vec3 normal = across / size;
        const vec3 heights = vec3(dot(normal, e1 - e0), dot(normal, g0 - e0), dot(normal, g1 - e0));
        const float a = dot(normal, now - e0), b = dot(normal, then - e0), far = reach * dot(abs(normal), vec3(1.0));
        if (min(a, b) - far <= max(max(heights.x, heights.y), max(heights.z, 0.0)) &&
            max(a, b) + far >= min(min(heights.x, heights.y), min(heights.z, 0.0)))
            return true;
        e0 = g0;
        e1 = g1;
    }
    return false;
}
