// The material inside of bodies. That of tissue is wet and darker than its skin, with a solid texture of strands; that
// of a plain body is like its surface, and grainy.
const float insideMoist = 1.3;
const float leastMoist = 0.5; // of the skin of tissue

// A hash of integers in [0, 1).
float hashed(ivec3 cell) {
    uvec3 v = uvec3(cell) * uvec3(1664525u, 22695477u, 1103515245u);
    uint h = v.x ^ v.y ^ v.z;
    h = (h ^ h >> 16) * 0x7feb352du;
    h = (h ^ h >> 15) * 0x846ca68bu;
    return float((h ^ h >> 16) >> 8) / 16777216.0;
}

float noise(vec3 x) {
    const ivec3 cell = ivec3(floor(x));
    const vec3 t = x - vec3(cell), s = t * t * (3.0 - 2.0 * t);
    float sum = 0.0;
    for (int k = 0; k < 8; ++k) {
        const ivec3 corner = ivec3(k & 1, k >> 1 & 1, k >> 2);
        const vec3 share = mix(1.0 - s, s, vec3(corner));
        sum += share.x * share.y * share.z * hashed(cell + corner);
    }
    return sum;
}

// Albedo at a place in tissue, under a skin of this color.
vec3 tissueAlbedo(vec3 inBody, vec3 skin) {
    const vec3 x = inBody * (16.0 / frame.stage.w); // the stage is 32 wide
    const float warp = noise(x) + 0.5 * noise(2.3 * x);
    const float strand = noise(vec3(5.0, 1.1, 5.0) * x + 2.0 * warp);
    const float fat = smoothstep(0.60, 0.72, noise(1.3 * x + 0.9 * warp + 31.0) + 0.25 * (noise(4.0 * x) - 0.5));
    const vec3 flesh = mix(0.5 * skin, vec3(0.36, 0.035, 0.03), 0.6);
    return mix(flesh * mix(0.55, 1.25, strand), vec3(0.74, 0.55, 0.30), 0.55 * fat);
}

// `skin`: linear RGB and gloss.
Surface insideSurface(vec3 inBody, vec4 skin) {
    if (skin.w < leastMoist) {
        const float grain = noise(inBody * (260.0 / frame.stage.w));
        return Surface(skin.rgb * mix(0.66, 0.86, grain), skin.w, 0.6, insideRim);
    }
    return Surface(tissueAlbedo(inBody, skin.rgb), insideMoist, 0.6, insideRim);
}
