// The clamp by directions (docs/clamp.md): how long a substep the links of a particle bear in their present directions.
// With A_i = sum_c k~_c (along n n^T + (1 - along) I), along = min(1, L / length), a particle is stable while 2 tau_i w_i
// lambda_max(A_i) is at most mostOfLinks. Its tau is the one at rest while that holds, falls at once where it does not,
// and returns within seconds, so that a clamp that follows the state feeds no energy.
layout(constant_id = 24) const bool followsDirections = false; // this dispatch finds the clamp of the next substep
layout(constant_id = 25) const float mostOfLinks = 0.0;
#ifdef RESIDENT
bool isLook = false; // in this substep
#define findsTimes (followsDirections && isLook)
uint untilNext = 0u; // substeps until times are found again
#else
#define findsTimes followsDirections
layout(constant_id = 26) const uint untilNext = 0u;
#endif

// A symmetric matrix: its diagonal, then xy, xz, yz.
#define SYMMETRIC mat2x3

// The part of a link of share k~ in A of both ends [N/m].
SYMMETRIC borneBy(vec3 a, vec3 b, float restLength, float share) {
    const vec3 d = b - a;
    const float inverse = inversesqrt(dot3(d, d) + 1e-30);
    const vec3 n = inverse * d;
    const float along = min(restLength * inverse, 1.0) * share;
    const vec3 m = along * n;
    return SYMMETRIC(m * n + vec3(share - along), vec3(m.x * n.y, m.x * n.z, m.y * n.z));
}

// The largest eigenvalue of a matrix whose eigenvalues are not negative, from above, at most 0.5 % too large. With the mean
// q of the eigenvalues and p^2 a sixth of the deviation's squared norm it is q + p (1 + x), 3 x^2 + x^3 = 2 + 2 r, where r is
// half the deviation's determinant over p^3. A step of Newton's from x0 = sqrt((2 + 2 r) / 3), above the root, stays above.
float largestEigenvalue(SYMMETRIC a) {
    const float q = (a[0].x + a[0].y + a[0].z) * (1.0 / 3.0);
    if (!(q > 0.0)) return 0.0;
    const vec3 d = a[0] / q - 1.0, o = a[1] / q;
    const float p = sqrt((dot3(d, d) + 2.0 * dot3(o, o)) * (1.0 / 6.0));
    const float determinant = d.x * (d.y * d.z - o.z * o.z) - o.x * (o.x * d.z - o.z * o.y) + o.y * (o.x * o.z - d.y * o.y);
    const float r = clamp(determinant / (2.0 * p * p * p + 1e-30), -1.0, 1.0);
    const float x = sqrt((2.0 + 2.0 * r) * (1.0 / 3.0));
    return q * (1.0 + p * (1.0 + x - x * x / (6.0 + 3.0 * x)));
}

// tau of a particle [s^2]; one that never moves keeps its own.
float timeFor(SYMMETRIC a, float atRest, float before, float w) {
    if (w <= 0.0) return before;
    const float returning = before * (1.0 + step.h * float(untilNext) / CLAMP_MEMORY);
    return min(min(atRest, returning), mostOfLinks / (2.0 * w * largestEigenvalue(a) + 1e-30));
}
