// What find_edges knows of an edge, and which pairs it lists. In the names of that kernel.
struct Searched {
    uint index;
    ContactEdge edge;
    vec3 middle;
    vec3 a, ab;
    float way; // of the faster end in this substep [m]
};

float wayOf(uint e) { return step.h * length(speeds[e].xyz); }

Searched searchedOf(uint e) {
    const ContactEdge edge = edges[e];
    const vec3 a = positions[edge.a].xyz;
    return Searched(e, edge, middles[e].xyz, a, positions[edge.b].xyz - a, wayOf(e));
}

bool isApart(uint e) { return !(edges[e].radius + wayOf(e) <= push.most); } // as part_points has it

#include "excluded.glsl"

bool shareAnEnd(ContactEdge e, ContactEdge f) { return e.a == f.a || e.a == f.b || e.b == f.a || e.b == f.b; }

bool isNear(Searched one, uint f) {
    const ContactEdge edge = edges[f];
    if (f == one.index || edge.radius < 0.0) return false; // that, cut
    const vec3 d = one.middle - middles[f].xyz;
    const float more = push.margin + (one.way + wayOf(f)), outer = one.edge.radius + edge.radius + more;
    if (dot(d, d) >= outer * outer || (one.edge.isMoving | edge.isMoving) == 0u || shareAnEnd(one.edge, edge)) return false;
    const vec3 c = positions[edge.a].xyz;
    const float reach = thickness[one.index] + thickness[f] + more;
    return squaredBetween(one.a - c, one.ab, positions[edge.b].xyz - c) < reach * reach && !isExcluded(one.index, f);
}

void list(uint e, uint f) {
    const uint slot = atomicAdd(found[e], 1u);
    if (slot < push.capacity) candidates[slot * push.row + e] = f;
}
