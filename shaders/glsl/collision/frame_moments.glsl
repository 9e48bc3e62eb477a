// Fits a frame to sums over particles. Requires the names sums, bodies, positions, detected, headings and bounds of
// a kernel.

// Sums as in FRAME_SUMS, relative to one origin.
struct Moments {
    float count;
    vec3 r, x, v;
    mat3 rr, dr, vr;
};

struct Origin {
    vec3 r, x;
};

// A motion: x = A (r - from) + to, dx/dt = W (x - to) + u.
struct Fit {
    vec3 from, to, u;
    mat3 a, w;
    bool stands;
};

mat3 columnsAt(uint first) { return mat3(sums[first].xyz, sums[first + 1u].xyz, sums[first + 2u].xyz); }

#include "collision/expected.glsl"

Origin originOf(uint b) {
    const uint i = bodies[b].origin;
    const vec3 x = positions[i].xyz, r = detected[i].xyz;
    return Origin(abs(r.x) < 1e17 ? alongHeading(r, i) : x, x);
}

void add(inout Moments m, uint b, Origin origin) {
    const uint first = b * FRAME_SUMS;
    const Origin own = originOf(b);
    const vec3 toR = own.r - origin.r, toX = own.x - origin.x, toD = toX - toR;
    const vec4 r = sums[first + FRAME_SUM_R];
    const vec3 x = sums[first + FRAME_SUM_X].xyz, v = sums[first + FRAME_SUM_V].xyz, d = x - r.xyz;
    m.count += r.w;
    m.r += r.xyz + r.w * toR;
    m.x += x + r.w * toX;
    m.v += v;
    m.rr += columnsAt(first + FRAME_SUM_RR) + outerProduct(r.xyz, toR) + outerProduct(toR, r.xyz) + r.w * outerProduct(toR, toR);
    m.dr += columnsAt(first + FRAME_SUM_DR) + outerProduct(d, toR) + outerProduct(toD, r.xyz) + r.w * outerProduct(toD, toR);
    m.vr += columnsAt(first + FRAME_SUM_VR) + outerProduct(v, toR);
}

// The inverse of a symmetric matrix that may be singular: a small multiple of the identity is added, which matters
// only in directions without data.
mat3 inverseOf(mat3 moments) {
    const float trace = max(moments[0][0] + moments[1][1] + moments[2][2], 1e-20);
    return inverse(moments / trace + 1e-5 * mat3(1.0)) / trace;
}

Fit standing(Origin origin) { return Fit(origin.r, origin.r, vec3(0.0), mat3(1.0), mat3(0.0), true); }

bool isFinite(mat3 a) { return squaredNorm(a) < 1e20; }

// Least squares over the particles of one cluster, or of one body alone.
Fit fitOf(Moments m, Origin origin) {
    const vec3 r = m.r / m.count, x = m.x / m.count, v = m.v / m.count;
    const mat3 inverseMoments = inverseOf(m.rr - m.count * outerProduct(r, r));
    const mat3 a = mat3(1.0) + (m.dr - m.count * outerProduct(x - r, r)) * inverseMoments;
    const mat3 rate = (m.vr - m.count * outerProduct(v, r)) * inverseMoments;
    Fit fit = Fit(origin.r + r, origin.x + x, v, a, mat3(0.0), false);
    if (!isFinite(a) || !isFinite(rate) || determinant(a) < 0.1) return standing(origin);
    fit.w = rate * inverse(a);
    return fit;
}
