// Smooth noise over space.

// A hash of integers in [0, 1).
float hashed(ivec3 cell) {
    uvec3 v = uvec3(cell) * uvec3(1664525u, 22695477u, 1103515245u);
    uint h = v.x ^ v.y ^ v.z;
    h = (h ^ h >> 16) * 0x7feb352du;
    h = (h ^ h >> 15) * 0x846ca68bu;
    return float((h ^ h >> 16) >> 8) / 16777216.0;
}

// A value in [0, 1) with waves of about 1, and its gradient: that of the cubic interpolation of random values.
vec4 noise(vec3 x) {
    const ivec3 cell = ivec3(floor(x));
    const vec3 t = x - vec3(cell), s = t * t * (3.0 - 2.0 * t), rate = 6.0 * t * (1.0 - t);
    vec4 low, high; // corners at the lower and upper end of x, by y and z
    for (int k = 0; k < 4; ++k) {
        const ivec3 corner = cell + ivec3(0, k & 1, k >> 1);
        low[k] = hashed(corner);
        high[k] = hashed(corner + ivec3(1, 0, 0));
    }
    const vec4 rows = mix(low, high, s.x), rise = high - low;
    const vec2 atY = mix(rows.xz, rows.yw, s.y), riseAtY = mix(rise.xz, rise.yw, s.y);
    const vec2 across = rows.yw - rows.xz;
    return vec4(mix(atY.x, atY.y, s.z), rate * vec3(mix(riseAtY.x, riseAtY.y, s.z), mix(across.x, across.y, s.z), atY.y - atY.x));
}
