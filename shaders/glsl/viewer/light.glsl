// Studio lighting: a warm key light with a soft shadow, a cool sky, the floor, and the encoding for the screen.
#include "viewer/frame.glsl"

layout(constant_id = 0) const bool encodesSrgb = false; // if the target does not encode itself
layout(constant_id = 1) const uint shadowTaps = 32u;

layout(set = 0, binding = 1) uniform sampler2DShadow shadowMap;
layout(set = 0, binding = 2) uniform sampler2D shadowDepth; // the same map, without comparison
layout(set = 0, binding = 4) uniform sampler2D floorMap;    // texture of floor.frag

const vec3 keyLight = vec3(2.75, 2.58, 2.34); // irradiance of a facing surface
const vec3 skyLight = vec3(0.82, 0.85, 0.90); // irradiance of an upward surface
const vec3 skyZenith = vec3(0.16, 0.27, 0.42);
const vec3 skyHorizon = vec3(0.90, 0.965, 1.01);
const vec3 floorAlbedo = vec3(0.73, 0.745, 0.77);
const float lightRadius = 0.085; // tangent of the key light's angular radius, which determines how fast a penumbra widens

// Glow of the sky around the lamp's direction, near the horizon.
vec3 glowAround(vec3 direction) {
    const float glow = max(dot(direction, normalize(vec3(frame.toLight.x, 0.25, frame.toLight.z))), 0.0);
    return vec3(0.10, 0.085, 0.06) * (glow * glow) * (glow * glow);
}

vec3 skyColor(vec3 direction) {
    const float up = direction.y;
    const float near = exp(up > 0.0 ? -7.5 * up : 4.0 * up);
    const vec3 away = up > 0.0 ? skyZenith : 0.62 * skyHorizon;
    return mix(away, skyHorizon, near) + glowAround(direction) * exp(-6.0 * abs(up));
}

// Visible shares of the key light and of the sky at the floor below a place, see floor.frag.
vec2 floorLight(vec3 position) {
    const vec2 uv = (position.xz - frame.floor.xy) / frame.floor.z + 0.5;
    return frame.ground.w > 0.0 ? textureLod(floorMap, uv, 0.0).rg : vec2(1.0);
}

// A surface point in the shadow map. `slope` is the depth that its plane gains per offset [m/m]; taps beside the
// point are compared with that plane, not with the point.
struct MapPoint {
    vec2 uv;
    float depth, texel; // texel: [m]
    vec2 slope;
};

MapPoint mapPoint(vec3 position, vec3 normal) {
    const float texel = frame.shadow.x / float(textureSize(shadowDepth, 0).x);
    const vec4 clip = frame.shadowFromWorld * vec4(position + 1.5 * texel * normal, 1.0);
    const mat3 fromWorld = mat3(frame.shadowFromWorld);
    const vec3 right = normalize(transpose(fromWorld)[0]), down = normalize(transpose(fromWorld)[1]);
    const float facing = max(dot(normal, frame.toLight.xyz), 0.15);
    const vec2 slope = clamp(vec2(dot(normal, right), dot(normal, down)) / facing, -4.0, 4.0);
    return MapPoint(clip.xy * 0.5 + 0.5, clip.z - texel / frame.shadow.y, texel, slope);
}

const float curvature = 0.15; // depth that a surface may rise above its plane without shading itself, per offset

// Depth to compare at an offset [m] of this length. Points behind the map's volume are compared with its end.
float depthAt(MapPoint point, vec2 offset, float away) {
    return min(point.depth + (dot(point.slope, offset) - curvature * away) / frame.shadow.y, 1.0);
}

// Mean depth of the blockers between the light and a disc around the point, and their weight: 0 if there are none. The
// first tap is at the point: otherwise few taps, turned differently in each pixel, miss a small blocker here and there.
// Few blockers in the rest of the disc count in part: where some pixels meet one and others none, the latter would else
// be lit in full, and a crease would be speckled.
vec2 blockersAround(MapPoint point, float radius, uint taps, vec2 turn) {
    const float fewBlockers = 2.0 + float(taps) / 8.0;
    float blockers = 0.0, depth = 0.0, isShaded = 0.0; // at the point itself
    for (uint i = 0u; i < taps; ++i, turn = nextTurn(turn)) {
        const float away = i == 0u ? 0.0 : radius * discRadius(i, taps);
        const vec2 offset = away * turn;
        const float here = textureLod(shadowDepth, point.uv + offset / frame.shadow.x, 0.0).r;
        const float isBlocker = float(here < depthAt(point, offset, away));
        if (i == 0u) isShaded = isBlocker;
        blockers += isBlocker;
        depth += isBlocker * here;
    }
    return vec2(depth / max(blockers, 1.0), min(max(fewBlockers * isShaded, blockers) / fewBlockers, 1.0));
}

// Share of the key light that reaches a surface: percentage-closer soft shadows [Fernando 2005]. Blockers near the
// surface give a sharp edge, far ones a soft one. `phase` rotates the taps [rad].
float keyShadow(vec3 position, vec3 normal, uint taps, float phase) {
    const MapPoint point = mapPoint(position, normal);
    if (any(notEqual(point.uv, clamp(point.uv, 0.0, 1.0)))) return 1.0;
    const vec2 start = firstTurn(phase);
    const float search = min(0.10 * frame.shadow.x, lightRadius * frame.shadow.y * point.depth);
    const vec2 blockers = blockersAround(point, search, taps, start);
    if (blockers.y == 0.0) return 1.0;
    const float gap = max(point.depth - blockers.x, 0.0) * frame.shadow.y;
    const float radius = clamp(lightRadius * gap, 1.5 * point.texel, search);
    float lit = 0.0;
    vec2 turn = start;
    for (uint i = 0u; i < taps; ++i, turn = nextTurn(turn)) {
        const float away = radius * discRadius(i, taps);
        const vec2 offset = away * turn;
        lit += textureLod(shadowMap, vec3(point.uv + offset / frame.shadow.x, depthAt(point, offset, away)), 0.0);
    }
    return mix(1.0, lit / float(taps), blockers.y);
}

// The target's encoding, with noise of half a step against banding in the sky.
vec4 encoded(vec3 shown, vec2 pixel) {
    const float dither = (pixelNoise(pixel) - 0.5) / 255.0;
    if (!encodesSrgb) return vec4(shown + dither * 2.0 * sqrt(shown), 1.0); // the encoding is nearly a square root
    const vec3 curved = 1.055 * pow(shown, vec3(1.0 / 2.4)) - 0.055;
    return vec4(mix(12.92 * shown, curved, step(0.0031308, shown)) + dither, 1.0);
}

// Filmic tone curve [Narkowicz 2015].
vec4 finish(vec3 color, vec2 pixel) {
    const vec3 x = 0.66 * color;
    return encoded(clamp(x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14), 0.0, 1.0), pixel);
}
