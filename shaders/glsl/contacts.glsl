// What the passes of a contact between two particles share: when they touch, and along which direction. Both ends of a pair
// compute equal bits, or exactly opposite ones.

// d = x_i - x_j. Of a pair in a list; the sign of |d| - reach, without a root.
// Exact: passes that disagreed about it would divide a particle among fewer contacts than it has.
bool touches(vec3 d, float reach) {
    precise float left = reach * reach - dot(d, d);
    return left > 0.0;
}

// What is left after a substep of the overlap that a pair had when the scene was loaded (contacts: 3). As much as remains
// is taken for touching, so that the pair parts at the speed with which it recovers, `way` a substep, whatever it carries.
float recovering(float offset, float way, float overlap) { return max(0.0, min(offset - way, overlap)); }

// Unit vector for two particles in one place: any, but the same every time, and opposite for the other of the two.
vec3 axisFor(uint i, uint j) {
    uint bits = (min(i, j) * 2654435761u) ^ (max(i, j) * 2246822519u);
    bits ^= bits >> 15;
    bits *= 2654435761u;
    bits ^= bits >> 13;
    const vec3 any = vec3(bits & 1023u, bits >> 10 & 1023u, bits >> 20 & 1023u) - 511.5; // never 0
    return (i < j ? 1.0 : -1.0) * normalize(any);
}

struct Direction {
    vec3 n;         // unit, from j to i
    float distance; // [m]
};

Direction directionOf(vec3 d, uint i, uint j) {
    const float squared = dot(d, d);
    if (squared < 1e-30) return Direction(axisFor(i, j), 0.0);
    const float distance = sqrt(squared);
    return Direction(d / distance, distance);
}
