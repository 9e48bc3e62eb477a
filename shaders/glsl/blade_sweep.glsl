// Part of the kernels that find what the blade of a step meets: the sweep as a link sees it. Within a stroke it has two strips:
//
//   from where the last sweep has ended, seen by the link alone (its ends have gone where they are), to where the material all along
//     the edge has taken that (carry_edge): nothing that the link crosses is between two sweeps
//   from there to where the edge is now: the same for all links, so that they agree about the side that a particle is on
//
// Whoever includes this has the buffers of cut_links, and PLACE(i), where a slot's particle is.
#include "turn_around.glsl"

// Takes the link itself exactly to where it is.
Motion motionOf(uint i, uint j, mat3 turn) {
    const bool isMoved = blade.isCarried != 0u && min(before[i].w, before[j].w) > 0.0;
    const vec3 link = before[j].xyz - before[i].xyz;
    const vec3 off = PLACE(j) - PLACE(i) - turn * link;
    return Motion(0.5 * (before[i].xyz + before[j].xyz), 0.5 * (PLACE(i) + PLACE(j)),
                  turn + outerProduct(off, link / max(dot(link, link), 1e-30)), isMoved ? overlap * push.spacing : 0.0);
}

// Where the strips from point `first` of the edge to `end` meet the way from a to b.
float stripHit(vec3 a, vec3 b, uint first, uint end, Motion motion, float eps) {
    float nearest = never;
    vec3 mid = points[EDGE_CARRIED + first].xyz, to = points[EDGE_AFTER + first].xyz;
    vec3 from = carried(points[EDGE_BEFORE + first].xyz, to, motion);
    for (uint s = first + 1u; s <= end; ++s) {
        const vec3 nextMid = points[EDGE_CARRIED + s].xyz, nextTo = points[EDGE_AFTER + s].xyz;
        const vec3 nextFrom = carried(points[EDGE_BEFORE + s].xyz, nextTo, motion);
        if (motion.back > 0.0) nearest = min(nearest, quadHit(a, b, from, nextFrom, mid, nextMid, eps));
        nearest = min(nearest, quadHit(a, b, mid, nextMid, to, nextTo, eps));
        from = nextFrom;
        mid = nextMid;
        to = nextTo;
    }
    return nearest;
}

// How far along the way from a to b, which go with the slots i and j.
float hitOf(uint i, uint j, vec3 a, vec3 b, mat3 turn, float eps) {
    const Motion motion = motionOf(i, j, turn);
    const vec3 middle = 0.5 * (a + b);
    // of what the way may cross, from where the edge is now
    const float reach = 0.5 * distance(a, b) + blade.way + push.spacing + 2.0 * points[EDGE_AFTER].w;
    float nearest = never;
    for (uint q = 0u; q < blade.quads; ++q) {
        const uint first = q * blade.parts;
        const vec3 to = points[EDGE_AFTER + first].xyz, edge = points[EDGE_AFTER + first + blade.parts].xyz - to;
        const float size = max(dot(edge, edge), 1e-30), at = dot(middle - to, edge) / size;
        const vec3 away = middle - to - clamp(at, 0.0, 1.0) * edge;
        if (dot(away, away) > reach * reach) continue;
        const float most = float(blade.parts), wide = reach * inversesqrt(size);
        const uint low = uint(clamp(floor((at - wide) * most), 0.0, most - 1.0)),
                   high = uint(clamp(ceil((at + wide) * most), 1.0, most));
        nearest = min(nearest, stripHit(a, b, first + low, first + max(high, low + 1u), motion, eps));
    }
    if (blade.rayFrom.w > 0.0) nearest = min(nearest, rayHit(a, b, blade.rayFrom.xyz, blade.rayTo.xyz, blade.rayFrom.w));
    return nearest;
}
