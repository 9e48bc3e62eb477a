#version 460
// A plain floor: matt, with a grid that fades, the shadow and contact darkening of bodies, and haze up to the
// horizon.
#extension GL_GOOGLE_include_directive : require
#include "viewer/light.glsl"

layout(location = 0) in vec3 worldPosition;
layout(location = 0) out vec4 shown;

// Coverage of lines `width` pixels wide at integer multiples of `spacing`; fades where they are too close to tell
// apart.
float gridLines(vec2 place, float spacing, float width) {
    const vec2 at = place / spacing;
    const vec2 perPixel = max(fwidth(at), vec2(1e-6));
    const vec2 away = abs(fract(at - 0.5) - 0.5) / perPixel;
    const vec2 line = clamp(0.5 + 0.5 * width - away, 0.0, 1.0) * (1.0 - smoothstep(0.08, 0.35, perPixel));
    return max(line.x, line.y);
}

void main() {
    const vec2 fromStage = worldPosition.xz - frame.stage.xz;
    const float distance = length(fromStage) / frame.stage.w;
    const float lines = 0.45 * gridLines(worldPosition.xz, frame.ground.y, 1.0) +
                        0.65 * gridLines(worldPosition.xz, 5.0 * frame.ground.y, 1.3);
    const float lineFade = 1.0 - smoothstep(1.0, 9.0, distance);
    const vec3 albedo = floorAlbedo * (1.0 - 0.20 * min(lines, 1.0) * lineFade);

    const vec2 light = floorLight(worldPosition);
    const float pool = mix(1.0, 0.78, smoothstep(0.3, 6.0, distance)); // the lamp is near
    const float open = mix(0.22, 1.0, light.y); // a body that touches the floor is not black and lights it too
    const vec3 floorColor = albedo * pool / pi * (keyLight * frame.toLight.y * light.x + skyLight * open);

    const vec3 ray = worldPosition - frame.eye.xyz;
    const vec3 haze = skyHorizon + glowAround(normalize(vec3(ray.x, 0.0, ray.z)));
    const float clear = 1.0 - smoothstep(0.0, 1.0, length(fromStage) / frame.ground.z);
    shown = finish(mix(haze, floorColor, clear * clear * clear), gl_FragCoord.xy);
}
