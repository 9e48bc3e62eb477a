// Where a point on an edge of a skin is that a cut has parted, on the side of one end: part of skin_cut. The motion around the point is the
// mean of those around the particle that the end goes with and around all that are linked with it, near ones more, so that points next to each
// other move alike whichever particles the ends of their edges go with. Towards the end it goes over into where the skin has that.
const float rimReach = 2.0; // [cells]

struct Nearby {
    vec3 place, end; // where the point and the end of its edge would be
    mat3 turn;
};

void addNearby(uint i, vec3 point, vec3 end, float spacing, inout Nearby sum, inout float weight) {
    if (near[i] == 0u) return;
    const vec3 away = (rest[i].xyz - point) / (rimReach * spacing);
    const float rise = max(0.0, 1.0 - dot(away, away)), share = rise * rise * float(bitCount(links[i]));
    const mat3 f = matrixOf(gradients[i]);
    const vec3 x = positions[particles[i]].xyz, home = rest[i].xyz;
    sum.place += share * (x + f * (point - home));
    sum.end += share * (x + f * (end - home));
    sum.turn += share * f;
    weight += share;
}

Nearby nearbyOf(uint i, vec3 point, vec3 end, SkinGrid grid) {
    Nearby sum = Nearby(vec3(0.0), vec3(0.0), mat3(0.0));
    float weight = 0.0;
    addNearby(i, point, end, grid.spacing, sum, weight);
    for (uint alive = links[i]; alive != 0u; alive &= alive - 1u) {
        const ivec3 d = directionOf(findLSB(alive));
        const int way = d.x + d.y * int(grid.rowStride) + d.z * int(grid.sliceStride);
        addNearby(uint(int(i) + way), point, end, grid.spacing, sum, weight);
    }
    if (weight > 0.0) return Nearby(sum.place / weight, sum.end / weight, sum.turn / weight);
    const mat3 f = matrixOf(gradients[i]);
    const vec3 x = positions[particles[i]].xyz;
    return Nearby(x + f * (point - rest[i].xyz), x + f * (end - rest[i].xyz), f);
}

// `end` and `other` are vertices that hang; the point goes with the first.
vec3 rimPlace(vec3 point, Nearby nearby, uint end, uint other) {
    const vec3 from = restOf(end).xyz;
    const float part = min(1.0, length(point - from) / max(length(restOf(other).xyz - from), 1e-30));
    return nearby.place + (1.0 - part) * (skinVertices[hung[end].vertex].position.xyz - nearby.end);
}
