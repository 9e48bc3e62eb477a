// Where a point beside a cut is that goes with a particle: the mean of the motions around that and around all that are linked with it, near ones
// more, so that points next to each other move alike whichever particles they go with. Whoever includes this says what are, of a slot,
//
//   NEAR(i), LINKS(i)   whether how the material has turned is known there, and its links
//   HOME(i)             where its particle was at rest
//   TURN(i)             the gradient
//   AT(i)               where its particle is
const float meanReach = 2.0; // [cells]

struct Nearby {
    vec3 place, end; // where the point and another one would be
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
