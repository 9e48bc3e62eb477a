// What the passes of a contact between two particles share: when they touch, and along which direction. Both ends of a pair
// compute equal bits, or exactly opposite ones.

#include "math.glsl"
#include "rest_slack.h"

// d = x_i - x_j. Of a pair in a list; the sign of |d| - reach, without a root.
// Exact: passes that disagreed about it would divide a particle among fewer contacts than it has.
bool touches(vec3 d, float reach) {
    return reach * reach - dot3(d, d) > 0.0;
}

// What is left after a substep of the overlap that a pair had when the scene was loaded (contacts: 3). As much as remains
// is taken for touching, so that the pair parts at the speed with which it recovers, `way` a substep, whatever it carries.
float recovering(float offset, float way, float overlap) { return max(0.0, min(offset - way, overlap)); }

// How much nearer than others a pair comes before it touches, from what it remembers of an overlap. Below 0 it keeps that as its rest
// distance, until it is farther apart than others that touch.
float nearerBy(float remembered) { return abs(remembered); }
bool isKept(float remembered) { return remembered < 0.0; }

// A pair with a small rest distance can pass itself in a substep in which others cannot. `d` after it, `way` in it. The pair then stands
// on the line of the start of the substep, at a distance below 0.
bool passes(vec3 d, vec3 way) {
    const vec3 start = d - way;
    return dot3(d, start) < 0.0;
}

// Unit vector for two particles in one place: any, but the same every time, and opposite for the other of the two.
vec3 axisFor(uint i, uint j) {
    uint bits = (min(i, j) * 2654435761u) ^ (max(i, j) * 2246822519u);
    bits ^= bits >> 15;
    bits *= 2654435761u;
    bits ^= bits >> 13;
    const vec3 any = vec3(bits & 1023u, bits >> 10 & 1023u, bits >> 20 & 1023u) - 511.5; // never 0
    return (i < j ? 1.0 : -1.0) * inversesqrt(dot3(any, any)) * any;
}

struct Direction {
    vec3 n;         // unit, from j to i
    float distance; // [m]
};

// The direction of a pair that passes itself.
Direction passedDirection(vec3 d, vec3 way) {
    const vec3 start = d - way, n = start / length3(start);
    return Direction(n, dot3(d, n));
}

Direction directionOf(vec3 d, uint i, uint j) {
    const float squared = dot3(d, d);
    if (squared < 1e-30) return Direction(axisFor(i, j), 0.0);
    const float distance = sqrt(squared);
    return Direction(d / distance, distance);
}

// When two that are at difference d after a substep, in which that changed by `way`, met on the way: the first root t of
// |d - way + t way| = reach, and their difference then. Only where they move far enough for what a contact leaves of their
// approach to carry them past each other, |way| > reach / 4: in a pit several contacts share the load, and each substep takes a
// part of the approach. Two that touched before and that no link moves meet at t = 0 where they come nearer by more than reach / 8. All
// others touch as where nobody is fast: stopped where they were, they stored energy in the links that pulled on, substep after
// substep.
struct Meeting {
    float time; // of the substep, 0 to 1; more = they did not meet
    vec3 at;
};
const float never = 2.0;

// Whether no link moves either of two, by what positions hold beside places (split.glsl): of who is fixed or has no links it is 1e30.
bool areFreeOf(float tauI, float tauJ) { return min(tauI, tauJ) > 0.5e30; }

Meeting meetingOf(vec3 d, vec3 way, float reach, bool areFree) {
    const vec3 start = d - way;
    const float a = dot3(way, way), b = dot3(start, way), c = dot3(start, start) - reach * reach;
    const float root = b * b - a * c, least = 0.0625 * reach * reach;
    if (!(a > least) || b >= 0.0 || root < 0.0) return Meeting(never, d);
    if (c <= 0.0 && !(areFree && b * b > 0.25 * least * dot3(start, start))) return Meeting(never, d);
    float t = max(0.0, c / (sqrt(root) - b));
    if (t > 1.0) return Meeting(never, d);
    const vec3 at = start + t * way;
    return Meeting(t, at);
}

// A contact in a substep with fast particles. Of several that a particle meets on its way only the first are real, those
// by `first` of the substep and as good as then: it goes no farther.
struct Contact {
    bool exists, isMet;
    vec3 at; // difference when they met, or after the substep
};

Contact contactOf(vec3 d, vec3 way, float reach, float first, bool areFree) {
    const Meeting meeting = meetingOf(d, way, reach, areFree);
    const bool isMet = meeting.time < never;
    return Contact(isMet ? meeting.time <= first + 1e-3 : touches(d, reach), isMet, meeting.at);
}

// The nearest that the two came to each other, squared [m^2].
float nearestSquared(vec3 d, vec3 way) {
    const float t = clamp(dot(d, way) / max(dot(way, way), 1e-30), 0.0, 1.0);
    const vec3 nearest = d - t * way;
    return dot(nearest, nearest);
}
