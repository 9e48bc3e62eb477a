// Part of the kernels that find links hit by the blade of a step: tests the moving edges of its strip against a
// moving link. Requires blade_places.glsl, blade_points.glsl and blade_hit.glsl.

// A hit: the position along the link, and in the frame that moves with the link the way of the blade there, across its edge
// [m], and the normal of its surface [not of unit length].
struct Meeting {
    float at;
    vec3 way, normal;
};

Meeting meetingAt(Ends x, float at, vec3 e0, vec3 g0, vec3 e1, vec3 g1) {
    const vec3 place = mix(x.a1, x.b1, at), edge = g1 - e1;
    const float square = max(dot3(edge, edge), 1e-30), share = clamp(dot3(place - e1, edge) / square, 0.0, 1.0);
    const vec3 way = mix(e1 - e0, g1 - g0, share) - mix(x.a1 - x.a0, x.b1 - x.b0, at);
    return Meeting(at, way - dot3(way, edge) / square * edge, cross3(edge, way));
}

Meeting stripMeeting(Ends x) {
    const vec3 low = min(min(x.a0, x.b0), min(x.a1, x.b1)), high = max(max(x.a0, x.b0), max(x.a1, x.b1));
    const vec3 shift = push.spacing * bladeShift;
    Meeting nearest = Meeting(never, vec3(0.0), vec3(0.0));
    vec3 e0 = POINT(0u) + shift, e1 = POINT(1u) + shift;
    for (uint q = 1u; q <= blade.quads; ++q) {
        const vec3 g0 = POINT(2u * q) + shift, g1 = POINT(2u * q + 1u) + shift;
        if (all(lessThanEqual(min(min(e0, g0), min(e1, g1)), high)) && all(greaterThanEqual(max(max(e0, g0), max(e1, g1)), low))) {
            const float at = edgeHit(x, e0, g0, e1, g1);
            if (at < nearest.at) nearest = meetingAt(x, at, e0, g0, e1, g1);
        }
        e0 = g0;
        e1 = g1;
    }
    return nearest;
}

// The position along the link that is hit first, by the strip, which meets it there, or by the ray of the blade.
float firstHit(Ends x, Meeting strip) {
    return blade.rayFrom.w > 0.0 ? min(strip.at, rayHit(x.a1, x.b1, blade.rayFrom.xyz, blade.rayTo.xyz, blade.rayFrom.w)) : strip.at;
}
float hitOf(Ends x) { return firstHit(x, stripMeeting(x)); }
