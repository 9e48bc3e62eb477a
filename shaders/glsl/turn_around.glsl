// Part of the kernels that carry the edge of a blade with the material: how what is around a particle has moved since the last step of
// the stroke. Whoever includes this has before[], savedLinks[] and PLACE(i), where a slot's particle is.

// The best affine motion of what i is linked with [Mueller 2005]; none where that lies in a plane.
mat3 turnAround(uint i) {
    mat3 moved = mat3(0.0), spread = mat3(0.0);
    for (int bit = 0; bit < FIRST_OWNED + OWNED_LINKS; ++bit) {
        if ((savedLinks[i] >> bit & 1u) == 0u) continue;
        const uint j = uint(int(i) + offsetOf(directionOf(bit)));
        const vec3 d = before[j].xyz - before[i].xyz;
        moved += outerProduct(PLACE(j) - PLACE(i), d);
        spread += outerProduct(d, d);
    }
    const float size = spread[0].x + spread[1].y + spread[2].z;
    return determinant(spread) > 1e-3 * size * size * size ? moved * inverse(spread) : mat3(1.0);
}
