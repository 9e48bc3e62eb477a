// Position of a skin vertex: trilinear over the corners of its cell, as in skin_cells. Corners that are not connected
// to the vertex's anchor by live links within the cell are replaced by their extrapolation from the surroundings of
// the anchor, so that a skin does not stretch over a cut. The including kernel defines
//
//   ALIVE(i), AT(i), REST(i)   as for gradient.glsl
//   TURN(i)                    the gradient there

// Corners of a cell that are still linked to a given corner. Corners connected only around the end of a cut, through
// others of the cell, do not count: a vertex between the two would hang in the gap. If the body has no stiff link in
// that direction, a link to any corner held directly counts.
uint heldWith(uint cell, uint corner) {
    const uint word = ALIVE(slotOf(cell, corner));
    uint held = 1u << corner, unknown = 0u;
    [[dont_unroll]] for (uint k = 0u; k < 8u; ++k) {
        if (k == corner) continue;
        const ivec3 d = cornerOf(int(k)) - cornerOf(int(corner));
        if (isAlive(word, d.x, d.y, d.z)) held |= 1u << k;
        else if (!isAlive(push.stiffLinks, d.x, d.y, d.z)) unknown |= 1u << k;
    }
    for (uint direct = unknown != 0u ? held : 0u; direct != 0u; direct &= direct - 1u) {
        const int c = findLSB(direct);
        const uint links = ALIVE(slotOf(cell, uint(c)));
        [[dont_unroll]] for (uint k = 0u; k < 8u; ++k) {
            const ivec3 d = cornerOf(int(k)) - cornerOf(c);
            if ((unknown >> k & 1u) != 0u && isAlive(links, d.x, d.y, d.z)) held |= 1u << k;
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
