#version 460
// The section plane where it passes through bodies: their opened inside, or their values; for balls their color.
#extension GL_GOOGLE_include_directive : require
#include "viewer/tissue.glsl"
#include "viewer/inside.glsl"

layout(push_constant) uniform Push { SkinPush push; }; // color.w: gloss of balls
#ifdef ONE_SAMPLE
const int samples = 1;
layout(set = 0, binding = 5) uniform sampler2D counts;
#else
const int samples = 4;
layout(set = 0, binding = 5) uniform sampler2DMS counts;
#endif
layout(location = 0) in vec2 clip;
layout(location = 0) out vec4 shown;

// The count of a sample; an inverted surface counts like others.
vec4 countAt(int i) {
#ifdef ONE_SAMPLE
    const vec4 sum = texelFetch(counts, ivec2(gl_FragCoord.xy), 0);
#else
    const vec4 sum = texelFetch(counts, ivec2(gl_FragCoord.xy), i);
#endif
    return sum.a < 0.0 ? -sum : sum;
}

// The skin of that color, with its gloss.
vec4 skinOf(vec3 color) {
    vec4 skin = vec4(color, 1.0);
    for (int i = 0; i < SKIN_COLORS; ++i)
        if (distance(frame.skins[i].rgb, color) < 0.002) skin.w = frame.skins[i].w;
    return skin;
}

void main() {
    const vec3 ray = frame.rayForward.xyz + clip.x * frame.rayRight.xyz + clip.y * frame.rayUp.xyz;
    const float height = dot(frame.section.xyz, frame.eye.xyz) - frame.section.w;
    const float approach = -dot(frame.section.xyz, ray);
    int mask = 0;
    vec4 sum = vec4(0.0);
    for (int i = 0; i < samples; ++i) {
        const vec4 count = countAt(i);
        if (count.a < 0.5 / 64.0) continue;
        mask |= 1 << i;
        sum = count;
    }
    if (mask == 0 || height <= 0.0 || approach <= 0.0) discard; // seen from behind, the skin is visible
    gl_SampleMask[0] = mask;
    const vec3 position = frame.eye.xyz + height / approach * ray;
    const vec4 place = frame.clipFromWorld * vec4(position, 1.0);
    gl_FragDepth = place.z / place.w;

    const float skins = round(sum.a), balls = round(64.0 * (sum.a - skins));
    const bool isSkin = skins > 0.5;
    const vec3 color = sum.rgb / max(isSkin ? skins : balls, 1.0);
    if (frame.look.x > 0.5) // sums of weighted values and of weights; grey where no particle is near
        shown = matt(position, frame.section.xyz, abs(sum.g) > 1e-3 ? mapColor(sum.r / sum.g, 1.0) : unknownValue);
    else
        shown = shade(position, frame.section.xyz, isSkin ? insideSurface(position, skinOf(color)) : tissue(color, push.color.w));
}
