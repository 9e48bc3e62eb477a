// Whether a point and a face pass each other in a substep, in which all four particles go straight. Requires the names
// and buffers of find_passing_points.
#include "collision/zone_paths.glsl"

// The point and the other corners, relative to the first corner.
Passage passageOf(Path point, ContactFace face) {
    const Path a = pathOf(face.a), b = pathOf(face.b), c = pathOf(face.c);
    return Passage(point.x - a.x, b.x - a.x, c.x - a.x, point.way - a.way, b.way - a.way, c.way - a.way);
}

float heightAt(Passage p, float t) {
    const vec3 normal = cross(p.b + t * p.wb, p.c + t * p.wc);
    return dot(normal, p.p + t * p.wp) / max(length(normal), 1e-37);
}

bool areOneAt(Passage p, float t) {
    const vec3 b = weightsOf(p.p + t * p.wp, triangleOf(p.b + t * p.wb, p.c + t * p.wc));
    return min(b.x, min(b.y, b.z)) >= -1e-3; // at an edge of two faces at least one detects it
}

float distanceAt(Passage p, float side, float t) { return side * heightAt(p, t); }

// The part of the substep after which a point and a face must move together; 2 = they do not pass. `side`: that of the
// contact, 0 = it has none.
float timeOfPassing(Passage p, float reach, float side) {
    const float before = heightAt(p, 0.0), height = abs(before), from = before < 0.0 ? -1.0 : 1.0;
    const float least = leastOf(height, reach);
    const float most = sqrt(dot(p.wp, p.wp)) + sqrt(max(dot(p.wb, p.wb), dot(p.wc, p.wc)));
    if (most <= height - least || side * from < 0.0 || before == 0.0) return 2.0;
    if (most < 0.25 * reach && height > 0.75 * reach) return 2.0; // neither fast nor deep: contacts hold it
    if (isSliver(triangleOf(p.b, p.c)) && isSliver(triangleOf(p.b + p.wb, p.c + p.wc))) return 2.0;
    const float through = timeThrough(p);
    if (through <= 1.0) return timeApart(p, from, least, through);
    const float after = from * heightAt(p, 1.0); // below 0: it has gone around the face
    if (after >= 0.0 && after < least && areOneAt(p, 1.0)) return timeApart(p, from, least, 1.0);
    return 2.0;
}
