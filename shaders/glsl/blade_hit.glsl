// Part of cut_links: where a link meets what cuts. A link from a (the node that owns it) to b; all expressions that decide between
// neighbouring triangles are the same for both, bit for bit, so no link passes between two of them.
//
//   side of a triangle's plane   n . (x - o) / |n| + eps >= 0: what lies in the plane is on its upper side, whichever triangle says so;
//                                all triangles of a strip turn the same way
//   side of a triangle's edge    (e x g) . (b - a) >= 0, e and g its ends seen from a: those of the earlier poly-line first, then
//                                the lower index, in both triangles that share it

const float never = 2.0;

// Share of the overlap of a sweep with the one before, of a cell.
const float overlap = 0.1;

bool isAbove(vec3 e, vec3 g, vec3 link) {
    precise const float volume = dot(cross(e, g), link);
    return volume >= 0.0;
}

// How far along the link its line meets the plane of a triangle; never where both ends are on one side.
float crossing(vec3 a, vec3 b, vec3 o, vec3 p, vec3 q, float eps) {
    precise const vec3 normal = cross(p - o, q - o);
    const float size = length(normal);
    if (!(size > 0.0)) return never;
    precise const float height = dot(normal, a - o), other = dot(normal, b - o);
    const float above = height / size + eps, beyond = other / size + eps;
    if ((above >= 0.0) == (beyond >= 0.0)) return never;
    return above / (above - beyond);
}

// A quad: two triangles that share the edge from `from` to `nextTo`.
float quadHit(vec3 a, vec3 b, vec3 from, vec3 nextFrom, vec3 to, vec3 nextTo, float eps) {
    const float first = crossing(a, b, from, nextFrom, nextTo, eps), second = crossing(a, b, from, nextTo, to, eps);
    if (min(first, second) == never) return never;
    precise const vec3 link = b - a, f = from - a, g = nextFrom - a, t = to - a, u = nextTo - a;
    const bool start = isAbove(f, g, link), end = isAbove(t, u, link), low = isAbove(f, t, link), high = isAbove(g, u, link),
               across = isAbove(f, u, link);
    const bool inFirst = start == high && start != across; // from, nextFrom, nextTo
    const bool inSecond = across != end && across != low;  // from, nextTo, to
    return min(inFirst ? first : never, inSecond ? second : never);
}

// How the material around a link has moved since the last blade: x -> now + turn (x - before).
struct Motion {
    vec3 before, now;
    mat3 turn;
    float back; // how far sweeps overlap [m]; 0 = nothing is carried
};

// Where the start of a sweep is for this link: it has moved with the material, and a little back, so that rounding leaves nothing
// between two sweeps.
vec3 carried(vec3 from, vec3 to, Motion motion) {
    precise const vec3 moved = motion.now + motion.turn * (from - motion.before), gone = moved - to;
    return moved + motion.back * inversesqrt(dot(gone, gone) + 1e-30) * gone;
}

// The nearest points of two segments, a to b and p to q [Ericson 2005, 5.1.9]: how far along the first, where they are nearer than
// `radius`.
float rayHit(vec3 a, vec3 b, vec3 p, vec3 q, float radius) {
    const vec3 d = b - a, e = q - p, r = a - p;
    const float dd = max(dot(d, d), 1e-30), ee = max(dot(e, e), 1e-30), de = dot(d, e), er = dot(e, r), dr = dot(d, r);
    const float apart = dd * ee - de * de;
    float s = apart > 1e-12 * dd * ee ? clamp((de * er - dr * ee) / apart, 0.0, 1.0) : 0.0;
    const float t = clamp((de * s + er) / ee, 0.0, 1.0);
    s = clamp((de * t - dr) / dd, 0.0, 1.0);
    const vec3 between = r + s * d - t * e;
    return dot(between, between) < radius * radius ? s : never;
}
