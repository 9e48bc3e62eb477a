// Paths of particles in a substep, and times at which two parts of surfaces meet: a point and a face, or two edges.
// Requires the names and buffers of find_passing_points, and of its part that says how far the two are apart.

// A particle at the start of the substep, and its displacement.
struct Path {
    vec3 x, way; // [m]
};

Path pathOf(uint i) {
    const vec4 velocity = velocities[i];
    const vec3 now = predicted[i].xyz, moved = step.h * predictedVelocities[i].xyz, x = now - moved;
    return Path(x, velocity.w == 0.0 ? moved : positions[i].xyz - step.thetaH * velocity.xyz - x);
}

// The two parts relative to one of their particles: three vectors whose product is 0 where all four particles are in
// one plane.
struct Passage {
    vec3 p, b, c;    // at the start [m]
    vec3 wp, wb, wc; // displacements [m]
};

bool areOneAt(Passage p, float t);                // whether two parts in one plane meet there
float distanceAt(Passage p, float side, float t); // of the two; below 0 on the other side, if they have sides [m]

float triple(vec3 a, vec3 b, vec3 c) { return dot(cross(a, b), c); }

// The volume between the four particles over time, a cubic.
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

// The first time at which all four are in one plane and the two parts meet; above 1 if there is none.
float timeThrough(Passage p) {
    const vec4 cubic = volumeOf(p);
    const vec2 turns = turnsOf(cubic);
    float from = 0.0;
    [[unroll]] for (uint part = 0u; part < 3u; ++part) {
        const float to = part == 0u ? turns.x : part == 1u ? turns.y : 1.0;
        if (to > from && valueAt(cubic, from) > 0.0 != valueAt(cubic, to) > 0.0) {
            const float t = rootBetween(cubic, from, to);
            if (areOneAt(p, t)) return t;
        }
        from = to;
    }
    return 2.0;
}

// The time until which the two may go on, `side` and `least` m apart: they are so for the last time before `end`.
float timeApart(Passage p, float side, float least, float end) {
    float low = 0.0, high = end;
    [[unroll]] for (uint turn = 0u; turn < 12u; ++turn) {
        const float t = 0.5 * (low + high);
        const bool isApart = distanceAt(p, side, t) > least;
        low = isApart ? t : low;
        high = isApart ? high : t;
    }
    return low;
}

// Distance that two parts must keep which begin a substep `apart` from each other: they never halve a small one again
// and again until rounding decides the side.
float leastOf(float apart, float reach) { return apart < 0.01 * reach ? 0.999 * apart : min(0.05 * reach, 0.5 * apart); }
