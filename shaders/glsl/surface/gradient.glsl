// The deformation gradient around a particle since the scene was loaded: F = (sum d D^T) (sum D D^T)^-1 over its live
// links, D at rest. If the links lie in a plane, the normal of that plane maps to the normal of its image; if they
// lie in a line, or there are none, F = 1. The including kernel defines
//
//   ALIVE(i)   the live links of a slot
//   AT(i)      the position of its particle
//   REST(i)    the rest position of its particle

mat3 cofactor(mat3 m) { return mat3(cross(m[1], m[2]), cross(m[2], m[0]), cross(m[0], m[1])); }

// The largest column: for a cofactor matrix of rank 1, the best estimate of the null direction.
vec3 largestColumn(mat3 m) {
    vec3 best = m[0];
    for (int c = 1; c < 3; ++c)
        if (dot(m[c], m[c]) > dot(best, best)) best = m[c];
    return best;
}

mat3 gradientOf(mat3 moved, mat3 spread) {
    const float size = spread[0].x + spread[1].y + spread[2].z;
    if (determinant(spread) > 1e-3 * size * size * size) return moved * inverse(spread);
    const vec3 flat_ = largestColumn(cofactor(spread));
    const float area = length(flat_);
    if (!(area > 1e-3 * size * size)) return mat3(1.0);
    const vec3 normal = flat_ / area, turned = cofactor(moved) * normal;
    const float turnedArea = length(turned);
    if (!(turnedArea > 1e-6 * area)) return mat3(1.0);
    return (moved + 0.5 * size * outerProduct(turned / turnedArea, normal)) * inverse(spread + 0.5 * size * outerProduct(normal, normal));
}

mat3 gradientAt(uint i) {
    const vec3 x = AT(i), home = REST(i);
    mat3 moved = mat3(0.0), spread = mat3(0.0);
    for (uint alive = ALIVE(i); alive != 0u; alive &= alive - 1u) {
        const uint j = uint(int(i) + offsetOf(directionOf(findLSB(alive))));
        const vec3 d = REST(j) - home;
        moved += outerProduct(AT(j) - x, d);
        spread += outerProduct(d, d);
    }
    return gradientOf(moved, spread);
}
