#version 460
// The light on the floor as a map: visible share of the key light and of the sky at each place. The plan map, the
// height of the lowest surface above the floor, hides the sky: a level patch of area A at height h and offset r hides
// A h^2 / (pi (r^2 + h^2)^2) of the cosine-weighted sky; `a2` = A / pi keeps that bounded where a patch touches the
// floor. Rings grow outwards: contact stays crisp.
#extension GL_GOOGLE_include_directive : require
#include "viewer/light.glsl"

layout(constant_id = 2) const uint skyTaps = 48u;
layout(set = 0, binding = 3) uniform sampler2D planMap;
layout(location = 0) in vec2 clip;
layout(location = 0) out vec2 light;

float openSky(vec2 center) {
    const float reach = 0.25 * frame.floor.z;
    float hidden = 0.0;
    vec2 turn = firstTurn(0.0);
    for (uint i = 0u; i < skyTaps; ++i, turn = nextTurn(turn)) {
        const float share = (float(i) + 0.5) / float(skyTaps);
        const float r = reach * share * share;
        const vec2 uv = center + r / frame.floor.z * turn;
        const float depth = textureLod(planMap, uv, 0.0).r;
        if (depth >= 1.0) continue;
        const float a2 = 4.0 * r * reach * share / float(skyTaps);
        const float h = depth * frame.floor.w;
        const float d2 = r * r + h * h + a2;
        hidden += a2 * (h * h + a2) / (d2 * d2);
    }
    return 1.0 - clamp(hidden, 0.0, 1.0);
}

void main() {
    const vec2 place = frame.floor.xy + 0.5 * clip * frame.floor.z;
    const vec3 position = vec3(place.x, frame.ground.x, place.y);
    light = vec2(keyShadow(position, vec3(0.0, 1.0, 0.0), 2u * shadowTaps, 0.0), openSky(clip * 0.5 + 0.5));
}
