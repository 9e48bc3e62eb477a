// Where a vertex of a skin is: trilinear over the corners of its cell, as skin_cells has it. Corners that do not hang together with the
// particle that it goes with, by live links within the cell, are taken for where that particle's surroundings would have them,
// so that a skin does not stretch over a cut. Whoever includes this says what are
//
//   ALIVE(i), AT(i), REST(i)   as for gradient.glsl
//   TURN(i)                    the gradient there

// Corners of a cell that hang together with one of them.
uint heldWith(uint cell, uint corner) {
    uint words[8];
    [[dont_unroll]] for (uint k = 0u; k < 8u; ++k) words[k] = ALIVE(slotOf(cell, k));
    uint held = 1u << corner;
    for (uint before = 0u; before != held;) {
        before = held;
        [[dont_unroll]] for (uint a = 0u; a < 7u; ++a)
            [[dont_unroll]] for (uint b = a + 1u; b < 8u; ++b) {
                const ivec3 d = cornerOf(int(b)) - cornerOf(int(a));
                const uint ends = 1u << a | 1u << b;
                if ((held & ends) != 0u && isAlive(words[a], d.x, d.y, d.z)) held |= ends;
            }
    }
    return held;
}

vec3 placeOf(HungVertex vertex, uint held) {
    const vec3 t = vertex.weights.xyz, home = AT(vertex.anchor);
    mat3 turn = mat3(1.0);
    if (held != 255u) turn = TURN(vertex.anchor);
    vec3 x = vec3(0.0);
    [[dont_unroll]] for (uint k = 0u; k < 8u; ++k) {
        const uint corner = slotOf(vertex.cell, k);
        const vec3 share = mix(1.0 - t, t, vec3(cornerOf(int(k))));
        const bool isHeld = (held >> k & 1u) != 0u;
        x += share.x * share.y * share.z * (isHeld ? AT(corner) : home + turn * (REST(corner) - REST(vertex.anchor)));
    }
    return x;
}
