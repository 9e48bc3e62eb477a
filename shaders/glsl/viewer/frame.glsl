// The resources of every picture shader, and their sample pattern.
#include "viewer/frame.h"

layout(set = 0, binding = 0, std140) uniform Frame { FrameParams frame; };

vec3 rotated(vec4 q, vec3 v) { return v + 2.0 * cross(q.xyz, cross(q.xyz, v) + q.w * v); }

const float pi = 3.14159265;

// Even samples of a disc (Vogel's spiral): direction i + 1 is direction i turned by the golden angle, point i
// of n lies at discRadius(i, n) along it.
vec2 firstTurn(float phase) {
    return vec2(cos(phase), sin(phase));
}
vec2 nextTurn(vec2 turn) {
    return mat2(-0.73736888, 0.67549029, -0.67549029, -0.73736888) * turn;
}
float discRadius(uint i, uint n) {
    return sqrt((float(i) + 0.5) / float(n));
}

// Interleaved gradient noise in [0, 1) [Jimenez 2014]: neighbours differ much, blocks average out.
float pixelNoise(vec2 pixel) {
    return fract(52.9829189 * fract(dot(floor(pixel), vec2(0.06711056, 0.00583715))));
}

const vec3 unknownValue = vec3(0.32); // grey: the value is unknown

// Color of a value in a map whose last color is that of `range`.
vec3 mapColor(float value, float range) {
    const float place = clamp(value / max(range, 1e-30), 0.0, 1.0) * float(MAP_COLORS - 1);
    const int low = min(int(place), MAP_COLORS - 2);
    const vec3 color = mix(frame.mapColors[low].rgb, frame.mapColors[low + 1].rgb, place - float(low));
    return value < 0.0 || range <= 0.0 ? unknownValue : color;
}
