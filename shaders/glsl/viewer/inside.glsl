// The material inside of bodies. Tissue has a rind (pale skin, then fat) around flesh with fibres, thin sheets of fat
// and vessels, and is wet. A plain body is inside like its surface, cloudy. Patterns are solid, in sizes of the body, so
// that both walls of a cut match; one that is finer than a pixel fades.
#include "viewer/noise.glsl"

layout(set = 0, binding = 10, std430) readonly buffer Insides {
    SkinInside insides[SKIN_COLORS];
    float depths[];
};

const float insideMoist = 1.3;
const float leastMoist = 0.5; // of the skin of tissue

const float skinBelow = 0.009, fatBelow = 0.021; // depth of the lower sides of skin and fat / size of the body
const float rindReach = 0.03;                    // its lower side varies
const float vesselRadius = 0.022;                // / size of the body

// A place in a body.
struct InsidePlace {
    vec3 place;         // [m]; of what a cut shows, in the body as loaded
    vec3 right, down;   // change of `place` per pixel [m]
    float depth, size;  // below the skin as loaded; of the body [m]
};

struct InsideSurface {
    Surface surface;
    vec3 slope; // gradient of the height of its bumps, by `place`
};

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

// 1 where a pattern of this wave length is seen, 0 where it is finer than a pixel; all in sizes of the body.
float seenShare(float wave, float pixel) { return clamp(1.6 - 2.4 * pixel / wave, 0.0, 1.0); }

// 1 below `edge`, softened over a pixel.
float belowEdge(float x, float edge, float pixel) { return clamp(0.5 + (edge - x) / max(pixel, 1e-6), 0.0, 1.0); }

// Distance to the surface on which a noise has its mean. Flat parts of the noise are no closer than steep ones.
float sheetDistance(vec4 noise, float steep) { return abs(noise.x) / max(length(noise.yzw), steep); }

// Distance to the line on which two noises have their mean.
float lineDistance(vec4 f, vec4 g) {
    const float ff = dot(f.yzw, f.yzw) + 0.02, gg = dot(g.yzw, g.yzw) + 0.02, fg = dot(f.yzw, g.yzw);
    return sqrt(max(gg * f.x * f.x - 2.0 * fg * f.x * g.x + ff * g.x * g.x, 0.0) / (ff * gg - fg * fg));
}

// Noise around 0 at a place times `waves`; its gradient is by the place.
vec4 wavesAt(vec3 x, vec3 waves, vec3 moved) {
    const vec4 n = noise(waves * x + moved);
    return vec4(n.x - 0.5, waves * n.yzw);
}

InsideSurface tissueInside(InsidePlace at, vec3 skin) {
    const vec3 x = at.place / at.size;
    const float pixel = max(length(at.right), length(at.down)) / at.size, depth = at.depth / at.size;
    const vec4 wide = wavesAt(x, vec3(2.3), vec3(7.7));
    const vec3 bent = x + 0.05 * wide.yzw;
    const vec4 coarse = wavesAt(bent, vec3(26.0, 7.0, 26.0), vec3(0.0)), fine = wavesAt(bent, vec3(80.0, 24.0, 80.0), vec3(3.1));
    const vec4 sheet = wavesAt(bent + 0.004 * coarse.yzw * vec3(0.1, 0.3, 0.1), vec3(12.0), vec3(31.4)), second = wavesAt(x, vec3(5.0), vec3(57.0));
    const float seenCoarse = seenShare(1.0 / 26.0, pixel), seenFine = seenShare(1.0 / 80.0, pixel);

    vec3 albedo = mix(0.5 * skin, vec3(0.36, 0.035, 0.03), 0.6);
    albedo *= 1.0 + 0.45 * seenCoarse * coarse.x + 0.35 * seenFine * fine.x + 0.5 * wide.x;
    const float thick = 0.0019 * max(0.5 + 2.5 * wide.x + 1.6 * seenCoarse * coarse.x, 0.0);
    const float septum = belowEdge(sheetDistance(sheet, 6.0), thick, max(pixel, 0.0015)) * min(1.0, 2.0 * thick / max(pixel, 0.0015));
    const vec3 fat = vec3(0.72, 0.56, 0.38) * (1.0 + 0.3 * seenCoarse * coarse.x);
    albedo = mix(albedo, fat, 0.62 * septum);

    const float radius = vesselRadius * (1.0 + 1.2 * sheet.x), vessel = lineDistance(wide, second);
    const bool isVein = sin(5.0 * x.x + 3.0 * x.y + 4.0 * x.z) > 0.0;
    const vec3 blood = isVein ? vec3(0.07, 0.02, 0.05) : vec3(0.16, 0.004, 0.006);
    const float wall = belowEdge(vessel, radius, pixel);
    albedo = mix(albedo, mix(vec3(0.66, 0.34, 0.30), blood, belowEdge(vessel, 0.62 * radius, pixel)), wall);

    const float edge = fatBelow * (1.0 + 0.5 * wide.x);
    albedo = mix(albedo, fat, belowEdge(depth, edge, pixel));
    albedo = mix(albedo, mix(skin, vec3(0.86, 0.66, 0.58), 0.65), belowEdge(depth, skinBelow, pixel));

    const vec3 slope = 0.0035 * seenCoarse * coarse.yzw + 0.0012 * seenFine * fine.yzw + 0.003 * sheet.yzw;
    return InsideSurface(Surface(albedo, insideMoist, 0.6, insideRim), slope);
}

// `skin`: linear RGB and gloss.
InsideSurface insideSurface(InsidePlace at, vec4 skin) {
    if (skin.w >= leastMoist) return tissueInside(at, skin.rgb);
    const float cloud = noise(at.place * (4.0 / at.size)).x;
    return InsideSurface(Surface(skin.rgb * mix(0.74, 0.86, cloud), skin.w, 0.6, insideRim), vec3(0.0));
}

// The unit normal of a surface with bumps [Mikkelsen 2010]. `right`, `down`: change of the point seen per pixel [m]. Of a
// triangle seen edge on it is that without them.
vec3 bumped(vec3 normal, InsideSurface inside, InsidePlace at, vec3 right, vec3 down) {
    const vec3 n = normalize(normal), across = cross(down, n), along = cross(n, right);
    const float area = dot(right, across);
    const vec3 rise = sign(area) * (dot(inside.slope, at.right) * across + dot(inside.slope, at.down) * along);
    return abs(area) < 1e-16 ? n : normalize(abs(area) * n - rise);
}
