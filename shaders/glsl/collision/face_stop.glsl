// Continuous collision of a point with a face that never yields: the position at which the point must end. Requires
// the names and buffers of stop_at_faces.
#include "collision/face_sweep.glsl"
layout(constant_id = 1) const bool onlyPassing = false; // false: also stops a point that ends too near

struct Stop {
    float urgency; // above 1: it crosses the face, 2 - time; else the missing distance as a part of the reach; 0 = no stop
    vec3 n;        // unit, towards the side that the point comes from, at the end
    float rise;    // correction along n of the approach in this substep [m]
    float lift;    // correction along n of an earlier overlap: adds no velocity [m]
    vec3 carried;  // position of the point if it moves with the face
};

const Stop noStop = Stop(0.0, vec3(0.0), 0.0, 0.0, vec3(0.0));

// Height of the point above the plane of the face, `back` before the end [m].
float heightAt(Passage p, float back) {
    const vec3 normal = cross(p.ab - back * p.wb, p.ac - back * p.wc);
    return dot(normal, p.ap - back * p.wp) / max(length(normal), 1e-37);
}

// The time at which the point is `least` above the plane, as a part of the substep: bracketed by bisection and chords
// in turn. The first chord is exact for a face that does not rotate.
float timeAbove(Passage p, float least, float before, float after) {
    float low = 0.0, high = 1.0, atLow = before - least, atHigh = after - least;
    for (uint turn = 0u; turn < 9u; ++turn) {
        const float chord = low + (high - low) * atLow / (atLow - atHigh);
        const float t = (turn & 1u) == 0u && chord > low && chord < high ? chord : 0.5 * (low + high);
        const float at = heightAt(p, 1.0 - t) - least;
        const bool isBefore = at > 0.0 == before > least;
        low = isBefore ? t : low;
        atLow = isBefore ? at : atLow;
        high = isBefore ? high : t;
        atHigh = isBefore ? atHigh : at;
    }
    return low + (high - low) * atLow / (atLow - atHigh);
}

// The position of the point if it moves with the face from its start: `height` above it.
vec3 carriedBy(Passage p, vec3 a, float height, vec3 n) {
    const vec3 b = weightsOf(p.ap - p.wp, triangleOf(p.ab - p.wb, p.ac - p.wc));
    return a + b.y * p.ab + b.z * p.ac + height * n;
}

// The stop of a point that crosses the face.
Stop passing(Passage p, vec3 a, vec3 normal, float reach, float least, float before, float after) {
    const float t = timeAbove(p, least, before, after), back = 1.0 - t, height = abs(before);
    const vec3 b = weightsOf(p.ap - back * p.wp, triangleOf(p.ab - back * p.wb, p.ac - back * p.wc));
    if (min(b.x, min(b.y, b.z)) < -1e-3) return noStop; // at an edge of two faces at least one detects it
    const vec3 n = before < 0.0 ? -normal : normal;
    return Stop(2.0 - t, n, min(height, reach) - dot(n, p.ap), max(0.0, reach - height), carriedBy(p, a, height, n));
}

// The part of the reach that is left to ordinary contacts in a substep: folded cloth must not be pressed through
// itself.
const float soft = 0.25;

// The stop of a point that has gone past the face, on the line of their first touch.
Stop goneBeyond(Passage p, vec3 a, float reach) {
    float back;
    const Nearest start = nearestAt(p, 1.0), touch = firstTouch(p, reach, back);
    const vec3 n = normalize(touch.d), b = touch.weights;
    const float missing = reach - dot(n, p.ap - b.y * p.ab - b.z * p.ac);
    if (missing <= 0.0) return noStop;
    const float rise = clamp(-dot(n, p.wp - b.y * p.wb - b.z * p.wc), 0.0, missing);
    return Stop(1.0 + back, n, rise, missing - rise, a + start.weights.y * p.ab + start.weights.z * p.ac + start.d);
}

// The stop of a point that ends too near: one that approached by more than this part of the reach, or ends nearer
// than half of it.
Stop pressing(Passage p, vec3 a, Triangle triangle, float reach, vec3 seen) {
    const Nearest nearest = nearestOf(p.ap, triangle);
    const float distance = length(nearest.d);
    if (distance >= reach || distance < 1e-15) return noStop;
    const vec3 n = nearest.d / distance;
    const vec3 way = p.wp - nearest.weights.y * p.wb - nearest.weights.z * p.wc;
    const float rise = clamp(-dot(n, way), 0.0, reach - distance);
    const bool isBeyond = isPast(p, reach, nearest);
    if (!isBeyond && rise < soft * reach && distance > 2.0 * soft * reach) return noStop;
    if (!(length(nearestOf(seen - a, triangle).d) < reach)) return noStop;
    if (isBeyond) return goneBeyond(p, a, reach);
    return Stop((reach - distance) / reach, n, rise, reach - distance - rise, vec3(0.0));
}

// The stop of a point that moves from x0 to x1. It touches the face at distances below `reach`. It is stopped
// slightly above the plane, so that rounding does not decide its side. `seen`: a position within reach of all faces
// that the point may end too near to.
Stop stopAt(ContactFace face, float reach, vec3 x0, vec3 x1, vec3 seen) {
    const float h = step.h;
    const vec3 a = PREDICTED(face.a).xyz, wa = h * PREDICTED_VELOCITY(face.a).xyz;
    const Passage p = Passage(x1 - a, PREDICTED(face.b).xyz - a, PREDICTED(face.c).xyz - a, x1 - x0 - wa,
                              h * PREDICTED_VELOCITY(face.b).xyz - wa, h * PREDICTED_VELOCITY(face.c).xyz - wa);
    const Triangle now = triangleOf(p.ab, p.ac);
    const float before = heightAt(p, 1.0), after = heightAt(p, 0.0);
    const float side = before < 0.0 ? -1.0 : 1.0, least = side * min(0.05 * reach, 0.5 * abs(before));
    if (side * after >= reach || isSliver(now)) return noStop;
    if (side * (after - least) < 0.0 && before != 0.0) {
        const Stop stop = passing(p, a, normalize(now.normal), reach, least, before, after);
        if (stop.urgency > 0.0) return stop;
    }
    return onlyPassing ? noStop : pressing(p, a, now, reach, seen);
}
