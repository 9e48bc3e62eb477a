// Part of gather_lattice: the links of a node. Every link is computed from both of its ends.

vec3 latticeLink(vec4 a, vec4 b, float stiffness, int dx, int dy, int dz, float hh) {
    const int kind = abs(dx) + abs(dy) + abs(dz) - 1; // edge, face diagonal, body diagonal
    const float clamped = stiffness * min(push.units[kind] * hh, push.shares[kind] * min(a.w, b.w));
    return linkImpulse(a.xyz, b.xyz, push.restLengths[kind], clamped);
}

SYMMETRIC latticeBearing(vec4 a, vec4 b, float stiffness, int dx, int dy, int dz) {
    const int kind = abs(dx) + abs(dy) + abs(dz) - 1;
    return borneBy(a.xyz, b.xyz, push.restLengths[kind], stiffness * push.shares[kind]);
}

#ifdef VOLUME
// The part of the cells around a node in A: a share k~ of each, for any gradients.
SYMMETRIC borneByCells(Fill cells) {
    float sum = 0.0;
    [[unroll]] for (int k = 0; k < 8; ++k) sum += cells.cells[k];
    return SYMMETRIC(vec3(0.5 * (push.volumeShare + push.recoveryShare) * sum), vec3(0.0));
}
#endif

bool isLink(int dx, int dy, int dz) {
    const int axes = abs(dx) + abs(dy) + abs(dz);
    return axes == 1 || axes == 2 || axes == 3 && hasBodyDiagonals;
}

// The impulses on the node at `home` of `slice` from its neighbours in `other`, which lies dz slices above; `bearing` is
// what these links add to A, if that is asked for.
vec3 gather(vec4 slice[SLICE], vec4 other[SLICE], int home, Fill fill, uint links, int dz, float hh, out SYMMETRIC bearing) {
    vec3 sum = vec3(0.0);
    bearing = SYMMETRIC(0.0);
    [[unroll]] for (int dy = -RIM_Y; dy <= RIM_Y; ++dy)
        [[unroll]] for (int dx = -1; dx <= 1; ++dx)
            if (isLink(dx, dy, dz)) {
                const vec4 end = other[home + dx + WIDTH * dy];
                const float stiffness = held(fill, links, dx, dy, dz);
                sum += latticeLink(slice[home], end, stiffness, dx, dy, dz, hh);
                if (findsTimes) bearing += latticeBearing(slice[home], end, stiffness, dx, dy, dz);
            }
    return sum;
}
