// Whether two edges pass each other in a substep, in which all four ends go straight. Requires the names and buffers of
// find_passing_edges.
#define areOneAt areEdgesOneAt // another decision than that of a point and a face
#include "collision/zone_paths.glsl"

// From an end of the second edge to one of the first, and both edges.
Passage passageOf(ContactEdge first, ContactEdge second) {
    const Path a = pathOf(first.a), b = pathOf(first.b), c = pathOf(second.a), d = pathOf(second.b);
    return Passage(a.x - c.x, b.x - a.x, d.x - c.x, a.way - c.way, b.way - a.way, d.way - c.way);
}

float distanceAt(Passage p, float side, float t) {
    return length(shortestBetween(p.p + t * p.wp, p.b + t * p.wb, p.c + t * p.wc));
}

// In one plane they meet, or are as near as rounding tells. So parallel edges are no exception.
bool areOneAt(Passage p, float t) {
    return distanceAt(p, 1.0, t) <= 1e-4 * (length(p.b + t * p.wb) + length(p.c + t * p.wc));
}

// The longest way of an end of one edge relative to one of the other.
float wayOf(Passage p) {
    const vec3 bc = p.wp + p.wb, ad = p.wp - p.wc, bd = bc - p.wc;
    return sqrt(max(max(dot(p.wp, p.wp), dot(bc, bc)), max(dot(ad, ad), dot(bd, bd))));
}

// The part of the substep after which two edges must move together; 2 = they do not pass.
float timeOfPassing(Passage p, float reach) {
    const float most = wayOf(p), far = length(p.b) + length(p.c) + most;
    if (dot(p.p, p.p) > far * far) return 2.0;
    const float before = distanceAt(p, 1.0, 0.0), least = leastOf(before, reach);
    if (most <= before - least || before == 0.0) return 2.0;
    if (most < 0.25 * reach && before > 0.75 * reach) return 2.0; // neither fast nor deep: contacts hold them
    const float through = timeThrough(p);
    if (through <= 1.0) return timeApart(p, 1.0, least, through);
    return distanceAt(p, 1.0, 1.0) < least ? timeApart(p, 1.0, least, 1.0) : 2.0;
}
