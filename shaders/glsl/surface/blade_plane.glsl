// Part of the kernels that place the rims of a cut. Requires blade_sweep.glsl.

// The meeting of a link's line with the plane of the strip beside its middle: as if the blade went on straight, ahead
// of its strip and beyond its ends. `drift` is the motion of the material in this step. `at` is outside of 0 to 1, or not
// a number, if the plane does not pass between the ends. `way` is not set.
Meeting planeMeeting(vec3 from, vec3 to, vec3 drift) {
    const vec3 shift = push.spacing * bladeShift, middle = 0.5 * (from + to) - shift;
    vec3 e0 = POINT(0u), e1 = POINT(1u), g0 = POINT(2u), g1 = POINT(3u);
    for (uint q = 2u; q <= blade.quads && dot3(middle - g1, g1 - e1) > 0.0; ++q) {
        e0 = g0;
        e1 = g1;
        g0 = POINT(2u * q);
        g1 = POINT(2u * q + 1u);
    }
    const vec3 normal = cross3(g1 - e1, 0.5 * ((e1 - e0) + (g1 - g0)) - drift);
    const float a = dot3(normal, from - e1 - shift), b = dot3(normal, to - e1 - shift);
    return Meeting(a / (a - b), vec3(0.0), normal);
}
