// Part of gather_lattice: the links of a node. Every link is computed from both of its ends.

vec3 latticeLink(vec4 a, vec4 b, float stiffness, int dx, int dy, int dz, float hh) {
    const int kind = abs(dx) + abs(dy) + abs(dz) - 1; // edge, face diagonal, body diagonal
    const float clamped = stiffness * min(push.units[kind] * hh, push.shares[kind] * min(a.w, b.w));
    return linkImpulse(a.xyz, b.xyz, push.restLengths[kind], clamped);
}

bool isLink(int dx, int dy, int dz) {
    const int axes = abs(dx) + abs(dy) + abs(dz);
    return axes == 1 || axes == 2 || axes == 3 && hasBodyDiagonals;
}

// The impulses on the node at `home` of `slice` from its neighbours in `other`, which lies dz slices above.
vec3 gather(vec4 slice[SLICE], vec4 other[SLICE], int home, Fill fill, uint links, int dz, float hh) {
    vec3 sum = vec3(0.0);
    [[unroll]] for (int dy = -RIM_Y; dy <= RIM_Y; ++dy)
        [[unroll]] for (int dx = -1; dx <= 1; ++dx)
            if (isLink(dx, dy, dz))
                sum += latticeLink(slice[home], other[home + dx + WIDTH * dy], held(fill, links, dx, dy, dz), dx, dy, dz, hh);
    return sum;
}
