// Part of find_edges: the data of an edge, and the test for pairs to list. Requires the names of that kernel.
struct Searched {
    uint index;
    ContactEdge edge;
    vec3 middle;
    vec3 a, ab;
    float way, thickness; // motion of the faster end; thickness with stretch (compute_edge_bounds) [m]
    vec3 va, vb, wa, wb;  // velocities and headings of the ends [m/s]
};

float wayOf(uint e) { return sizeOf(0.0, step.h, SPEED(e).xyz); }

Searched searchedOf(uint e) {
    const ContactEdge edge = edgeAt(e);
    const vec3 a = POSITION(edge.a).xyz;
    return Searched(e, edge, middles[e].xyz, a, POSITION(edge.b).xyz - a, wayOf(e), THICKNESS(e), VELOCITY(edge.a),
                    VELOCITY(edge.b), HEADING(edge.a), HEADING(edge.b));
}

bool isApart(ContactEdge edge, float way) { // see list_large_points
    return !(edge.radius + way <= push.most && way <= most);
}

#include "collision/excluded.glsl"

bool shareAnEnd(ContactEdge e, ContactEdge f) { return e.a == f.a || e.a == f.b || e.b == f.a || e.b == f.b; }

// Distance by which two edges, which are d apart, may approach in this substep or along their headings. The normal of a
// plane between them, square to d, separates them at both ends of both ways, and so in between.
float approachOf(Searched one, ContactEdge edge, vec3 d) {
    const vec3 n = d / max(length(d), 1e-30);
    const float back = max(dot(n, one.va), dot(n, one.vb)) - min(dot(n, VELOCITY(edge.a)), dot(n, VELOCITY(edge.b)));
    const float on = max(dot(n, HEADING(edge.a)), dot(n, HEADING(edge.b))) - min(dot(n, one.wa), dot(n, one.wb));
    return 1.001 * max(0.0, max(step.h * back, bounds.horizon * on));
}

// True if a pair must be listed; the caller tests for excluded pairs.
bool isNear(Searched one, uint f, ContactEdge edge, float way, vec3 middle) {
    if (f == one.index || edge.radius < 0.0) return false; // removed by a cut
    const vec3 d = one.middle - middle;
    const float more = push.margin + (one.way + way), outer = one.edge.radius + edge.radius + more;
    if (dot(d, d) >= outer * outer || (one.edge.isMoving | edge.isMoving) == 0u || shareAnEnd(one.edge, edge)) return false;
    const vec3 c = POSITION(edge.a).xyz;
    const vec3 between = shortestBetween(one.a - c, one.ab, POSITION(edge.b).xyz - c);
    const float reach = one.thickness + THICKNESS(f) + push.margin + approachOf(one, edge, between);
    return dot(between, between) < reach * reach;
}

// True if, of two edges in the grid, e searches for f: each edge searches for half of all others, at every distance.
bool looksFor(uint e, uint f) { return ((e ^ f) & 1u) == 0u ? e < f : f < e; }

// True if the first edge owns a pair, which is in the list of its owner: an edge that moves, if the other never does.
bool owns(Searched one, uint f, bool isMoving) {
    const bool moves = one.edge.isMoving != 0u;
    return moves == isMoving ? looksFor(one.index, f) : moves;
}

void list(Searched one, uint f) {
    const uint pair = newPair();
    if (pair == noPair) return;
    const bool isFirst = owns(one, f, edgeAt(f).isMoving != 0u);
    const uint owner = isFirst ? one.index : f, other = isFirst ? f : one.index;
    const uint next = atomicExchange(chains[owner], 2u * pair + 1u), nextOfOther = atomicExchange(linkChains[other], 2u * pair + 2u);
    listOwners(owner, next, other, nextOfOther);
    pairs[pair] = uvec4(owner, other, next, nextOfOther);
}
