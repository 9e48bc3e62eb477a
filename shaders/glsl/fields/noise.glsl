// A smooth random vector field that is the same on every device: values at integer points from an integer hash,
// interpolated with quintic weights, so that second derivatives are continuous.

uvec3 hashOf(uvec3 v) {
    v = v * 1664525u + 1013904223u;
    for (uint round = 0u; round < 2u; ++round) {
        v.x += v.y * v.z;
        v.y += v.z * v.x;
        v.z += v.x * v.y;
        if (round == 0u) v ^= v >> 16;
    }
    return v;
}

// Components from -1 to 1.
vec3 valueAt(ivec3 corner) {
    return vec3(hashOf(uvec3(corner)) >> 8) * (2.0 / 16777215.0) - 1.0;
}

vec3 smoothNoise(vec3 x) {
    x = clamp(x, -1e9, 1e9); // corners fit into integers
    const vec3 low = floor(x), t = x - low;
    const ivec3 corner = ivec3(low);
    const vec3 high = t * t * t * (t * (6.0 * t - 15.0) + 10.0);
    vec3 sum = vec3(0.0);
    for (int k = 0; k < 8; ++k) {
        const ivec3 side = ivec3(k & 1, k >> 1 & 1, k >> 2);
        const vec3 share = mix(1.0 - high, high, vec3(side));
        sum += share.x * share.y * share.z * valueAt(corner + side);
    }
    return sum;
}
