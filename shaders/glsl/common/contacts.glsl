// Shared by the passes of contacts between two particles: the contact test, and the contact direction. Both ends of a
// pair compute equal bits, or exactly opposite ones.

#include "common/math.glsl"
#include "common/rest_slack.h"

// Contact test of a listed pair with d = x_i - x_j: the sign of |d| - reach, without a root. Exact: passes that
// disagreed about it would divide a particle among fewer contacts than it has.
bool touches(vec3 d, float reach) {
    return reach * reach - dot3(d, d) > 0.0;
}

// Remaining overlap after a substep, of the overlap that a pair had when the scene was loaded. The pair touches at
// reach minus this, so it separates at the speed of recovery, `way` a substep, whatever load it carries.
float recovering(float offset, float way, float overlap) { return max(0.0, min(offset - way, overlap)); }

// Amount by which remembered overlap shortens the reach of a pair. Below 0, the pair keeps the shorter distance as
// its rest distance, until it is farther apart than the full reach.
float nearerBy(float remembered) { return abs(remembered); }
bool isKept(float remembered) { return remembered < 0.0; }

// True if a pair has passed itself in a substep. Only pairs with a small rest distance can. `d` is the difference
// after the substep, `way` its change. The pair then gets the direction at the start of the substep, and a distance
// below 0.
bool passes(vec3 d, vec3 way) {
    const vec3 start = d - way;
    return dot3(d, start) < 0.0;
}

// Unit vector for two particles in one place: arbitrary, but the same every time, and opposite for the other
// particle.
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

// The direction of a pair that has passed itself.
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

// Time of impact of two particles at difference d after a substep, in which the difference changed by `way`: the
// first root t of |d - way + t way| = reach, and the difference at that time. An impact counts only if the particles
// move far enough for the rest of their approach after a contact to carry them past each other, |way| > reach / 4: in
// a pile several contacts share the load, and each substep removes a part of the approach. Two that touched before
// and that no link moves meet at t = 0 if they approach by more than reach / 8. All other pairs use the contact test
// without sweep: stopped at their start, they stored energy in the links that pulled on, substep after substep.
struct Meeting {
    float time; // in the substep, 0 to 1; more = no impact
    vec3 at;
};
const float never = 2.0;

// True if no link moves either particle. Reads tau beside positions (split.glsl): it is 1e30 for particles that are
// fixed or have no links.
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

// A contact in a substep with fast particles. Among the impacts of a particle only those at the time `first` of its
// first one, and those as early, are real: the particle goes no farther.
struct Contact {
    bool exists, isMet;
    vec3 at; // difference at the impact, or after the substep
};

Contact contactOf(vec3 d, vec3 way, float reach, float first, bool areFree) {
    const Meeting meeting = meetingOf(d, way, reach, areFree);
    const bool isMet = meeting.time < never;
    return Contact(isMet ? meeting.time <= first + 1e-3 : touches(d, reach), isMet, meeting.at);
}

// Squared smallest distance of the two during the substep [m^2].
float nearestSquared(vec3 d, vec3 way) {
    const float t = clamp(dot(d, way) / max(dot(way, way), 1e-30), 0.0, 1.0);
    const vec3 nearest = d - t * way;
    return dot(nearest, nearest);
}
