#version 460
// Cloth: two sides of different tone, threads, and a hem with a seam. Threads finer than two pixels fade, so that they
// do not flicker.
#extension GL_GOOGLE_include_directive : require
#include "viewer/tissue.glsl"
#include "viewer/section.glsl"

const float threads = 72.0; // pairs along the shorter side
const float hemShare = 0.024; // of the shorter side

layout(push_constant) uniform Push { SkinPush push; };
layout(location = 0) in vec3 worldPosition;
layout(location = 1) in vec3 worldNormal;
layout(location = 2) in float asleep; // 1 = paler
#ifdef WHOLE
layout(location = 3) in vec4 inSheet; // place in the sheet and size of the sheet [m]
#endif
layout(location = 0) out vec4 shown;

// Triangles face along right x down of the sheet, that is downwards in a sheet that lies flat. That side is as a print
// seen from behind: paler, less saturated.
vec3 sideOf(vec3 color) {
    const float grey = dot(color, vec3(0.3, 0.6, 0.1));
    return gl_FrontFacing ? mix(color, vec3(grey), 0.3) * 0.75 + 0.12 : color;
}

#ifdef WHOLE
// 1 where the light on a thread is mean; threads of a plain weave pass over each other in turn.
float weave(vec2 place, float side) {
    const vec2 x = place * (threads / side), width = fwidth(x);
    const float shown = 1.0 - smoothstep(0.15, 0.45, max(width.x, width.y));
    const vec2 wave = sin(2.0 * pi * x);
    return 1.0 + 0.2 * shown * (wave.x * wave.y + 0.5 * abs(wave.x) - 0.5 * abs(wave.y));
}

// Two layers and a seam of stitches along the border.
float hem(vec4 at, float side) {
    const vec2 rim = min(at.xy, at.zw - at.xy);
    const float inwards = min(rim.x, rim.y), width = hemShare * side, blur = fwidth(inwards);
    const float along = rim.x < rim.y ? at.y : at.x;
    const float stitch = smoothstep(-0.3, 0.3, sin(2.0 * pi * along / (0.35 * width)));
    const float isSeam = 1.0 - smoothstep(0.08 * width, 0.08 * width + blur, abs(inwards - 0.78 * width));
    const float isHem = 1.0 - smoothstep(width - blur, width, inwards);
    return mix(1.0, 0.74, isHem) + 0.30 * isSeam * stitch * (1.0 - smoothstep(0.1, 0.3, blur / width));
}
#endif

void main() {
    keepBehindSection(worldPosition);
    vec3 albedo = sideOf(mix(push.color.rgb, vec3(0.62, 0.66, 0.72), 0.55 * asleep));
#ifdef WHOLE
    const float side = min(inSheet.z, inSheet.w);
    albedo *= weave(inSheet.xy, side) * hem(inSheet, side);
#endif
    // threads scatter what wet tissue mirrors, and let light through
    shown = shade(worldPosition, worldNormal, Surface(albedo, 0.0, 0.3, 0.10));
}
