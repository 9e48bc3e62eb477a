// The material inside of bodies. That of tissue is wet and darker than its skin, with a solid texture of strands, below a
// rind of pale skin and fat; that of a plain body is like its surface, and grainy.
layout(set = 0, binding = 10, std430) readonly buffer Insides {
    SkinInside insides[SKIN_COLORS];
    float depths[];
};

const float insideMoist = 1.3;
const float leastMoist = 0.5; // of the skin of tissue

const float skinBelow = 0.009, fatBelow = 0.021; // depth of the lower sides of skin and fat / size of the body
const float rindReach = 0.03;                    // its lower side varies

// A place in a body.
struct InsidePlace {
    vec3 place;         // [m]; of what a cut shows, in the body as loaded
    vec3 right, down;   // change of `place` per pixel [m]
    float depth, size;  // below the skin as loaded; of the body [m]
};

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
    const vec3 flesh = mix(0.5 * skin, vec3(0.36, 0.035, 0.03), 0.6);
    return flesh * mix(0.8, 1.25, strand);
}

// Depth of a place as loaded below that skin [m]; large where it has no depths.
float depthBelow(vec3 place, uint skin) {
    const SkinInside inside = insides[skin];
    if (inside.nodes.w < 0.0) return 1e6;
    const ivec3 nodes = ivec3(inside.nodes.xyz);
    const vec3 x = (place - inside.low.xyz) / inside.low.w;
    const ivec3 cell = clamp(ivec3(floor(x)), ivec3(0), nodes - 2);
    const vec3 t = clamp(x - vec3(cell), 0.0, 1.0);
    const int first = int(inside.nodes.w) + cell.x + nodes.x * (cell.y + nodes.y * cell.z), up = nodes.x * nodes.y;
    vec4 rows; // along y and z
    for (int k = 0; k < 4; ++k) {
        const int row = first + (k & 1) * nodes.x + (k >> 1) * up;
        rows[k] = mix(depths[row], depths[row + 1], t.x);
    }
    return mix(mix(rows.x, rows.y, t.y), mix(rows.z, rows.w, t.y), t.z);
}

// 1 below `edge`, softened over a pixel.
float belowEdge(float x, float edge, float pixel) { return clamp(0.5 + (edge - x) / max(pixel, 1e-6), 0.0, 1.0); }

// Albedo of the skin and the fat around flesh.
vec3 withRind(vec3 flesh, InsidePlace at, vec3 skin) {
    const float pixel = max(length(at.right), length(at.down)) / at.size, depth = at.depth / at.size;
    const float edge = fatBelow * (0.8 + 0.4 * noise(2.3 / at.size * at.place));
    const vec3 below = mix(flesh, vec3(0.72, 0.56, 0.38), belowEdge(depth, edge, pixel));
    return mix(below, mix(skin, vec3(0.86, 0.66, 0.58), 0.65), belowEdge(depth, skinBelow, pixel));
}

// `skin`: linear RGB and gloss.
Surface insideSurface(InsidePlace at, vec4 skin) {
    if (skin.w < leastMoist) {
        const float grain = noise(at.place * (260.0 / frame.stage.w));
        return Surface(skin.rgb * mix(0.66, 0.86, grain), skin.w, 0.6, insideRim);
    }
    return Surface(withRind(tissueAlbedo(at.place, skin.rgb), at, skin.rgb), insideMoist, 0.6, insideRim);
}
