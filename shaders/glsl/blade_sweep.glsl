// Part of the kernels that find what the blade of a step meets: the edges of its strip, from where they were to where they are, against a
// link that has gone from where it was when they were there. Whoever includes this has the buffers of cut_links, and PLACE(i), where a
// slot's particle is.

// Where the particle of a slot was when the edge was where it now begins.
vec3 placeBefore(uint i) { return blade.isCarried != 0u && before[i].w > 0.0 ? before[i].xyz : PLACE(i); }

float stripHit(Ends x) {
    const vec3 low = min(min(x.a0, x.b0), min(x.a1, x.b1)), high = max(max(x.a0, x.b0), max(x.a1, x.b1));
    const vec3 shift = push.spacing * bladeShift;
    float nearest = never;
    vec3 e0 = points[0].xyz + shift, e1 = points[1].xyz + shift;
    for (uint q = 1u; q <= blade.quads; ++q) {
        const vec3 g0 = points[2u * q].xyz + shift, g1 = points[2u * q + 1u].xyz + shift;
        if (all(lessThanEqual(min(min(e0, g0), min(e1, g1)), high)) && all(greaterThanEqual(max(max(e0, g0), max(e1, g1)), low)))
            nearest = min(nearest, edgeHit(x, e0, g0, e1, g1));
        e0 = g0;
        e1 = g1;
    }
    return nearest;
}

float hitOf(Ends x) {
    const float nearest = stripHit(x);
    return blade.rayFrom.w > 0.0 ? min(nearest, rayHit(x.a1, x.b1, blade.rayFrom.xyz, blade.rayTo.xyz, blade.rayFrom.w)) : nearest;
}

// The way between two points of a skin, which have gone as the particles of slots i and j.
float hitOf(uint i, uint j, vec3 a, vec3 b) { return hitOf(Ends(a + placeBefore(i) - PLACE(i), b + placeBefore(j) - PLACE(j), a, b)); }
