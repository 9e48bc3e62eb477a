// Position beside a cut of a point bound to a particle: the mean of the affine motions around that particle and
// around all that are linked with it, weighted towards near ones, so that adjacent points move alike whichever
// particles they are bound to. The including kernel defines, for a slot,
//
//   NEAR(i), LINKS(i)   whether its gradient is known, and its live links
//   HOME(i)             rest position of its particle
//   TURN(i)             the gradient
//   AT(i)               position of its particle
const float meanReach = 2.0; // [cells]

struct Nearby {
    vec3 place, end; // position of the point, and of a second one
    mat3 turn;
};

void addNearby(uint i, vec3 point, vec3 end, float spacing, inout Nearby sum, inout float weight) {
    if (NEAR(i) == 0u) return;
    const vec3 home = HOME(i), away = (home - point) / (meanReach * spacing);
    const float rise = max(0.0, 1.0 - dot(away, away)), share = rise * rise * float(bitCount(LINKS(i)));
    const mat3 f = TURN(i);
    const vec3 x = AT(i);
    sum.place += share * (x + f * (point - home));
    sum.end += share * (x + f * (end - home));
    sum.turn += share * f;
    weight += share;
}

Nearby nearbyOf(uint i, vec3 point, vec3 end, SkinGrid grid) {
    Nearby sum = Nearby(vec3(0.0), vec3(0.0), mat3(0.0));
    float weight = 0.0;
    addNearby(i, point, end, grid.spacing, sum, weight);
    for (uint alive = LINKS(i); alive != 0u; alive &= alive - 1u) {
        const ivec3 d = directionOf(findLSB(alive));
        const int way = d.x + d.y * int(grid.rowStride) + d.z * int(grid.sliceStride);
        addNearby(uint(int(i) + way), point, end, grid.spacing, sum, weight);
    }
    if (weight > 0.0) return Nearby(sum.place / weight, sum.end / weight, sum.turn / weight);
    const mat3 f = TURN(i);
    const vec3 x = AT(i), home = HOME(i);
    return Nearby(x + f * (point - home), x + f * (end - home), f);
}
