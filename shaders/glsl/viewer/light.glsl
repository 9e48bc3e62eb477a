// The light of the studio: a warm key with a soft shadow, a cool sky, the ground's bounce, and the way to the screen.
#include "viewer/frame.glsl"

layout(constant_id = 0) const bool encodesSrgb = false; // where the target does not do it itself
layout(constant_id = 1) const uint shadowTaps = 32u;

layout(set = 0, binding = 1) uniform sampler2DShadow shadowMap;
layout(set = 0, binding = 2) uniform sampler2D shadowDepth; // the same map, uncompared
layout(set = 0, binding = 4) uniform sampler2D floorMap;    // of floor.frag

const vec3 keyLight = vec3(2.75, 2.58, 2.34); // irradiance of a facing surface
const vec3 skyLight = vec3(0.82, 0.85, 0.90); // irradiance of an upward surface
const vec3 skyZenith = vec3(0.16, 0.27, 0.42);
const vec3 skyHorizon = vec3(0.90, 0.965, 1.01);
const vec3 floorAlbedo = vec3(0.73, 0.745, 0.77);
const float lightRadius = 0.085; // tangent of the key light's angular radius: how fast a penumbra widens

vec3 skyColor(vec3 direction) {
    const float up = direction.y;
    const vec3 dome = mix(skyHorizon, skyZenith, 1.0 - exp(-7.5 * max(up, 0.0)));
    const float glow = max(dot(direction, normalize(vec3(frame.toLight.x, 0.25, frame.toLight.z))), 0.0);
    const vec3 lower = skyHorizon * mix(1.0, 0.62, 1.0 - exp(4.0 * min(up, 0.0)));
    return (up > 0.0 ? dome : lower) + vec3(0.10, 0.085, 0.06) * pow(glow, 4.0) * exp(-6.0 * abs(up));
}

// Shares of the key light and of the sky at the floor below a place, see floor.frag.
vec2 floorLight(vec3 position) {
    const vec2 uv = (position.xz - frame.floor.xy) / frame.floor.z + 0.5;
    return frame.ground.w > 0.0 ? textureLod(floorMap, uv, 0.0).rg : vec2(1.0);
}

// Share of the key light that reaches a surface: percentage-closer soft shadows [Fernando 2005]. Blockers near the
// surface give a sharp edge, far ones a soft one. Each tap is compared with the depth of the surface's own plane. `phase` turns the taps
// [rad].
float keyShadow(vec3 position, vec3 normal, uint taps, float phase) {
    const float texel = frame.shadow.x / float(textureSize(shadowDepth, 0).x);
    const vec4 clip = frame.shadowFromWorld * vec4(position + 1.5 * texel * normal, 1.0);
    const vec2 center = clip.xy * 0.5 + 0.5;
    if (any(notEqual(center, clamp(center, 0.0, 1.0)))) return 1.0;

    const vec3 right = vec3(frame.shadowFromWorld[0].x, frame.shadowFromWorld[1].x, frame.shadowFromWorld[2].x);
    const vec3 down = vec3(frame.shadowFromWorld[0].y, frame.shadowFromWorld[1].y, frame.shadowFromWorld[2].y);
    const float facing = max(dot(normal, frame.toLight.xyz), 0.15);
    const vec2 tilt = vec2(dot(normal, normalize(right)), dot(normal, normalize(down)));
    const vec2 slope = clamp(tilt / facing, vec2(-4.0), vec2(4.0)); // depth per offset in the map's plane [m/m]
    const float bias = texel / frame.shadow.y;

    float blockers = 0.0, depth = 0.0;
    const float search = min(0.10 * frame.shadow.x, lightRadius * frame.shadow.y * clip.z);
    const uint searchTaps = taps / 2u;
    const vec2 start = firstTurn(phase);
    vec2 turn = start;
    for (uint i = 0u; i < searchTaps; ++i, turn = nextTurn(turn)) {
        const vec2 offset = search * discRadius(i, searchTaps) * turn;
        const float here = textureLod(shadowDepth, center + offset / frame.shadow.x, 0.0).r;
        const float plane = clip.z - bias + (dot(slope, offset) - 0.15 * length(offset)) / frame.shadow.y;
        if (here < min(plane, 1.0)) { // 1: nothing there
            blockers += 1.0;
            depth += here;
        }
    }
    if (blockers == 0.0) return 1.0;
    const float gap = max(clip.z - depth / blockers, 0.0) * frame.shadow.y;
    const float radius = clamp(lightRadius * gap, 1.5 * texel, search);
    float lit = 0.0;
    turn = start;
    for (uint i = 0u; i < taps; ++i, turn = nextTurn(turn)) {
        const vec2 offset = radius * discRadius(i, taps) * turn;
        const float plane = clip.z + dot(slope, offset) / frame.shadow.y - bias;
        lit += textureLod(shadowMap, vec3(center + offset / frame.shadow.x, min(plane, 1.0)), 0.0);
    }
    return lit / float(taps);
}

// Filmic tone curve [Narkowicz 2015], the target's encoding, and noise of half a step against bands in the sky.
vec4 finish(vec3 color, vec2 pixel) {
    const vec3 x = 0.66 * color;
    const vec3 shown = clamp(x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14), 0.0, 1.0);
    const float dither = (pixelNoise(pixel) - 0.5) / 255.0;
    if (!encodesSrgb) return vec4(shown + dither * 2.0 * sqrt(shown), 1.0); // the target encodes, nearly as a root
    const vec3 encoded = mix(12.92 * shown, 1.055 * pow(shown, vec3(1.0 / 2.4)) - 0.055, step(0.0031308, shown));
    return vec4(encoded + dither, 1.0);
}
