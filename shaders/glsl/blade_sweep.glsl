// Part of the kernels that find what the blade of a step meets: the sweep as a link sees it, its start carried with the material around
// (blade_hit.glsl). Whoever includes this has the buffers of cut_links, and PLACE(i), where a slot's particle is.

// The best affine motion of what i is linked with [Mueller 2005]; none where that lies in a plane.
mat3 turnAround(uint i) {
    mat3 moved = mat3(0.0), spread = mat3(0.0);
    for (int bit = 0; bit < FIRST_OWNED + OWNED_LINKS; ++bit) {
        if ((savedLinks[i] >> bit & 1u) == 0u) continue;
        const uint j = uint(int(i) + offsetOf(directionOf(bit)));
        const vec3 d = before[j].xyz - before[i].xyz;
        moved += outerProduct(PLACE(j) - PLACE(i), d);
        spread += outerProduct(d, d);
    }
    const float size = spread[0].x + spread[1].y + spread[2].z;
    return determinant(spread) > 1e-3 * size * size * size ? moved * inverse(spread) : mat3(1.0);
}

// How far along the way from a to b, which go with the slots i and j.
float hitOf(uint i, uint j, vec3 a, vec3 b, mat3 turn, float eps) {
    const bool isMoved = blade.isCarried != 0u && min(before[i].w, before[j].w) > 0.0;
    const Motion motion = Motion(0.5 * (before[i].xyz + before[j].xyz), 0.5 * (PLACE(i) + PLACE(j)), turn,
                                 isMoved ? overlap * push.spacing : 0.0);
    float nearest = never;
    vec3 from = carried(points[0].xyz, points[1].xyz, motion), to = points[1].xyz;
    for (uint q = 1u; q <= blade.quads; ++q) {
        const vec3 nextTo = points[2u * q + 1u].xyz, nextFrom = carried(points[2u * q].xyz, nextTo, motion);
        nearest = min(nearest, quadHit(a, b, from, nextFrom, to, nextTo, eps));
        from = nextFrom;
        to = nextTo;
    }
    if (blade.rayFrom.w > 0.0) nearest = min(nearest, rayHit(a, b, blade.rayFrom.xyz, blade.rayTo.xyz, blade.rayFrom.w));
    return nearest;
}

