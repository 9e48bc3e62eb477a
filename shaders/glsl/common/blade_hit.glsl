// Part of the kernels that find links hit by a blade. During a step the ends a and b of a link move from their old to
// their new positions, and an edge of the blade moves from (e, g) at its start to (e, g) at its end. Both motions are
// straight, so in space and time link and edge are surfaces of two triangles each,
//
//   link  a0 b0 b1, a0 a1 b1        edge  e0 g0 g1, e0 g1 e1
//
// and the blade hits the link where the surfaces intersect. Two triangles in four dimensions intersect in a point if
// six determinants have the right signs. Links that share a particle share the determinants of its path, edges that
// share a point share those of its path, and consecutive steps share those of the moment between them. All these
// expressions are equal bit for bit, so no link slips between two edges or two steps, however the material moves
// meanwhile. Particles of a lattice at rest often lie exactly in the path of the blade, and rounding would then
// decide at random: the blade is shifted by a thousandth of a cell, always in one direction, which
// lies in no plane and no row of a lattice.
#include "common/math.glsl"

const float never = 2.0;
const vec3 bladeShift = vec3(BLADE_SHIFT_X, BLADE_SHIFT_Y, BLADE_SHIFT_Z);

struct Ends {
    vec3 a0, b0, a1, b1;
};

float volumeOf(vec3 a, vec3 b, vec3 c) {
    return dot3(cross3(a, b), c);
}

// The position along the link at which two triangles intersect, else `never`. Each of the six corners has a number,
// to be multiplied by the given sign: the determinant of the other five corners. The corners of one triangle,
// weighted with these numbers, add up to a point of the other. Zero counts as positive, whichever sign it is
// multiplied by.
float meetingOf(vec3 link, vec3 linkSigns, vec3 edge, vec3 edgeSigns, vec3 isB) {
    const bvec3 l = notEqual(greaterThanEqual(link, vec3(0.0)), lessThan(linkSigns, vec3(0.0)));
    const bvec3 e = notEqual(greaterThanEqual(edge, vec3(0.0)), lessThan(edgeSigns, vec3(0.0)));
    if (l.x != l.y || l.y != l.z || e.x != e.y || e.y != e.z || l.x == e.x) return never;
    const vec3 weights = abs(link);
    const float all = weights.x + weights.y + weights.z;
    return dot3(weights, isB) / max(all, 1e-37);
}

// The position along the link at which an edge of the blade hits it, 0 to 1; `never` if it does not.
float edgeHit(Ends x, vec3 e0, vec3 g0, vec3 e1, vec3 g1) {
    const vec3 l0 = x.b0 - x.a0, l1 = x.b1 - x.a1;
    const vec3 ae0 = e0 - x.a0, ag0 = g0 - x.a0, ae1 = e1 - x.a1, ag1 = g1 - x.a1;
    const vec3 be0 = e0 - x.b0, bg0 = g0 - x.b0, be1 = e1 - x.b1, bg1 = g1 - x.b1;
    const float a1 = volumeOf(ae0, ag0, ag1), a2 = volumeOf(ae0, ag1, ae1); // path of a
    const float b1 = volumeOf(be0, bg0, bg1), b2 = volumeOf(be0, bg1, be1); // path of b
    const float d1 = volumeOf(ae0, ag0, bg1), d2 = volumeOf(ae0, bg1, be1);           // from a to b during the step
    const float s0 = volumeOf(ae0, ag0, l0), s1 = volumeOf(ae1, ag1, l1);             // link before and after
    const float x1 = volumeOf(l0, ae0, bg1), x2 = volumeOf(l1, ae0, ag1);             // from e to g during the step
    const float e1_ = volumeOf(l0, ae0, be1), e2 = volumeOf(l1, ae0, ae1);            // path of e
    const float g1_ = volumeOf(l0, ag0, bg1), g2 = volumeOf(l1, ag0, ag1);            // path of g
    const vec3 eg0 = g0 - e0, ge1 = e1 - g1;
    const float m1 = volumeOf(eg0, l1, ag1), m2 = volumeOf(l0, ae0, ge1);
    const float n1 = volumeOf(ae0, ag0, l1), n2 = volumeOf(l0, bg1, be1);
    const vec3 first = vec3(0.0, 1.0, 1.0), second = vec3(0.0, 0.0, 1.0);
    return min(min(meetingOf(vec3(b1, d1, s0), vec3(1, -1, -1), vec3(g1_, x1, s0), vec3(1, -1, 1), first),
                   meetingOf(vec3(b2, d2, m2), vec3(1, -1, 1), vec3(n2, e1_, x1), vec3(1, -1, 1), first)),
               min(meetingOf(vec3(m1, d1, a1), vec3(-1, -1, 1), vec3(g2, x2, n1), vec3(-1, 1, -1), second),
                   meetingOf(vec3(s1, d2, a2), vec3(-1, -1, 1), vec3(s1, e2, x2), vec3(1, 1, -1), second)));
}

// The nearest points of two segments, a to b and p to q [Ericson 2005, 5.1.9]: the position along the first if they
// are nearer than `radius`, else `never`.
float rayHit(vec3 a, vec3 b, vec3 p, vec3 q, float radius) {
    const vec3 d = b - a, e = q - p, r = a - p;
    const float dd = max(dot3(d, d), 1e-30), ee = max(dot3(e, e), 1e-30), de = dot3(d, e), er = dot3(e, r), dr = dot3(d, r);
    const float apart = dd * ee - de * de, least = 1e-12 * dd * ee, ahead = (de * er - dr * ee) / apart;
    float s = apart > least ? clamp(ahead, 0.0, 1.0) : 0.0;
    const float t = clamp((de * s + er) / ee, 0.0, 1.0);
    s = clamp((de * t - dr) / dd, 0.0, 1.0);
    const vec3 between = r + s * d - t * e;
    const float most = radius * radius;
    return dot3(between, between) < most ? s : never;
}
