// Whether a point and a face pass each other in a substep, in which all four particles go straight. Requires the names
// and buffers of find_passing_points.

// A particle at the start of the substep, and its displacement.
struct Path {
    vec3 x, way; // [m]
};

Path pathOf(uint i) {
    const vec4 velocity = velocities[i];
    const vec3 now = predicted[i].xyz, moved = step.h * predictedVelocities[i].xyz, x = now - moved;
    return Path(x, velocity.w == 0.0 ? moved : positions[i].xyz - step.thetaH * velocity.xyz - x);
}

// A point and the other corners of a face, relative to its first corner.
struct Passage {
    vec3 p, b, c;    // at the start [m]
    vec3 wp, wb, wc; // displacements [m]
};

Passage passageOf(Path point, ContactFace face) {
    const Path a = pathOf(face.a), b = pathOf(face.b), c = pathOf(face.c);
    return Passage(point.x - a.x, b.x - a.x, c.x - a.x, point.way - a.way, b.way - a.way, c.way - a.way);
}

float heightAt(Passage p, float t) {
    const vec3 normal = cross(p.b + t * p.wb, p.c + t * p.wc);
    return dot(normal, p.p + t * p.wp) / max(length(normal), 1e-37);
}

bool isOverFace(Passage p, float t) {
    const vec3 b = weightsOf(p.p + t * p.wp, triangleOf(p.b + t * p.wb, p.c + t * p.wc));
    return min(b.x, min(b.y, b.z)) >= -1e-3; // at an edge of two faces at least one detects it
}

float triple(vec3 a, vec3 b, vec3 c) { return dot(cross(a, b), c); }

// The volume between the point and the face over time, a cubic.
vec4 volumeOf(Passage p) {
    return vec4(triple(p.b, p.c, p.p), triple(p.wb, p.c, p.p) + triple(p.b, p.wc, p.p) + triple(p.b, p.c, p.wp),
                triple(p.wb, p.wc, p.p) + triple(p.wb, p.c, p.wp) + triple(p.b, p.wc, p.wp), triple(p.wb, p.wc, p.wp));
}

float valueAt(vec4 cubic, float t) { return cubic.x + t * (cubic.y + t * (cubic.z + t * cubic.w)); }

// Times from 0 to 1 at which the cubic turns; 1 where it does not.
vec2 turnsOf(vec4 cubic) {
    const float a = 3.0 * cubic.w, b = cubic.z, root = b * b - a * cubic.y; // of a t^2 + 2 b t + y
    if (!(root > 0.0)) return vec2(1.0);
    const float q = -(b + (b < 0.0 ? -1.0 : 1.0) * sqrt(root));
    const vec2 turns = vec2(a != 0.0 ? q / a : 1.0, q != 0.0 ? cubic.y / q : 1.0);
    const vec2 within = vec2(turns.x > 0.0 && turns.x < 1.0 ? turns.x : 1.0, turns.y > 0.0 && turns.y < 1.0 ? turns.y : 1.0);
    return vec2(min(within.x, within.y), max(within.x, within.y));
}

// The last time before a sign change of the cubic between two times.
float rootBetween(vec4 cubic, float low, float high) {
    const bool isAbove = valueAt(cubic, low) > 0.0;
    [[unroll]] for (uint turn = 0u; turn < 24u; ++turn) {
        const float t = 0.5 * (low + high);
        const bool isBefore = valueAt(cubic, t) > 0.0 == isAbove;
        low = isBefore ? t : low;
        high = isBefore ? high : t;
    }
    return low;
}

// The first time at which the point is in the plane and in the face; above 1 if there is none.
float timeThrough(Passage p) {
    const vec4 cubic = volumeOf(p);
    const vec2 turns = turnsOf(cubic);
    float from = 0.0;
    [[unroll]] for (uint part = 0u; part < 3u; ++part) {
        const float to = part == 0u ? turns.x : part == 1u ? turns.y : 1.0;
        if (to > from && valueAt(cubic, from) > 0.0 != valueAt(cubic, to) > 0.0) {
            const float t = rootBetween(cubic, from, to);
            if (isOverFace(p, t)) return t;
        }
        from = to;
    }
    return 2.0;
}

// The time until which a point may go on, `side` and `least` m above the plane: it is there for the last time before
// `end`.
float timeAbove(Passage p, float side, float least, float end) {
    float low = 0.0, high = end;
    [[unroll]] for (uint turn = 0u; turn < 12u; ++turn) {
        const float t = 0.5 * (low + high);
        const bool isAbove = side * heightAt(p, t) > least;
        low = isAbove ? t : low;
        high = isAbove ? high : t;
    }
    return low;
}

// Distance above the plane that a point must keep which begins a substep `height` above it: it never halves a small
// one again and again until rounding decides the side.
float leastOf(float height, float reach) { return height < 0.01 * reach ? 0.999 * height : min(0.05 * reach, 0.5 * height); }

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
    if (through <= 1.0) return timeAbove(p, from, least, through);
    const float after = from * heightAt(p, 1.0); // below 0: it has gone around the face
    if (after >= 0.0 && after < least && isOverFace(p, 1.0)) return timeAbove(p, from, least, 1.0);
    return 2.0;
}
