// Two segments in space: their distance, and the nearest points of their lines.

// Lines x = a + s ab and c + t cd.
struct Crossing {
    vec3 n;       // unit, across both
    float height; // height of the first above the second along n [m]
    float s, t;   // parameters of the nearest points; inside both segments between 0 and 1
    bool exists;  // they are not parallel
};

// `least`: square of the sine of the angle below which lines count as parallel. ca = a - c.
Crossing crossingOf(vec3 ca, vec3 ab, vec3 cd, float least) {
    const vec3 across = cross(ab, cd);
    const float squared = dot(across, across), lengths = dot(ab, ab) * dot(cd, cd);
    const bool exists = squared > least * lengths && lengths > 0.0;
    const float scale = exists ? 1.0 / squared : 0.0;
    const vec3 n = sqrt(scale) * across;
    return Crossing(n, dot(n, ca), scale * dot(cross(cd, ca), across), scale * dot(cross(ab, ca), across), exists);
}

bool isInside(Crossing crossing, float slack) {
    return crossing.exists && min(crossing.s, crossing.t) >= -slack && max(crossing.s, crossing.t) <= 1.0 + slack;
}

// From the nearest point of a segment ab to p.
vec3 fromSegment(vec3 ap, vec3 ab) { return ap - clamp(dot(ap, ab) / max(dot(ab, ab), 1e-37), 0.0, 1.0) * ab; }

vec3 shorterOf(vec3 a, vec3 b) { return dot(b, b) < dot(a, a) ? b : a; }

// The shortest way from the segment cd to the segment ab [m].
vec3 shortestBetween(vec3 ca, vec3 ab, vec3 cd) {
    const vec3 bc = ca + ab; // b - c
    const vec3 ends = shorterOf(shorterOf(fromSegment(ca, cd), fromSegment(bc, cd)),
                                -shorterOf(fromSegment(-ca, ab), fromSegment(cd - ca, ab)));
    const Crossing crossing = crossingOf(ca, ab, cd, 1e-10);
    return isInside(crossing, 0.0) ? shorterOf(ends, crossing.height * crossing.n) : ends;
}
