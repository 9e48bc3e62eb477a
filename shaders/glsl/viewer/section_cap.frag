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

// Sum of counts at a place of the picture. What the picture does not show counts as solid.
float countNear(vec2 pixel) {
    const ivec2 at = ivec2(floor(pixel));
#ifdef ONE_SAMPLE
    const ivec2 size = textureSize(counts, 0);
#else
    const ivec2 size = textureSize(counts);
#endif
    return any(lessThan(at, ivec2(0))) || any(greaterThanEqual(at, size)) ? 1.0 : abs(texelFetch(counts, at, 0).a);
}

bool isSolid(vec2 pixel) { return countNear(pixel) > 0.5; }

// Whether a place beside the cap is between the walls of a cut: the ray of the pixel does not leave as many walls as it
// enters. A gap that the ray leaves through its opening is not told from the outside.
bool isGap(vec2 pixel) { return countNear(pixel) > 0.5 / 512.0; }

// The first skin of that color; SKIN_COLORS if there is none.
uint skinOf(vec3 color) {
    uint skin = 0u;
    while (skin < SKIN_COLORS && distance(frame.skins[skin].rgb, color) >= 0.002) ++skin;
    return skin;
}

// Distance to the skin in the outline of the cap, along the plane, up to `reach` [m]; large beyond. It looks for the
// outline in 12 directions.
float outlineDistance(float reach, vec3 right, vec3 down) {
    const float rr = dot(right, right), dd = dot(down, down), rd = dot(right, down), area = rr * dd - rd * rd;
    const vec3 u = normalize(right), v = normalize(cross(frame.section.xyz, u));
    float found = 1e6;
    for (int i = 0; i < 12; ++i) {
        const float angle = 2.0 * pi * float(i) / 12.0;
        const vec3 way = cos(angle) * u + sin(angle) * v;
        const vec2 pixels = vec2(dd * dot(way, right) - rd * dot(way, down), rr * dot(way, down) - rd * dot(way, right)) / area;
        float low = 0.0, high = min(reach, found);
        if (isSolid(gl_FragCoord.xy + high * pixels)) continue;
        for (int k = 0; k < 5; ++k) {
            const float middle = 0.5 * (low + high);
            if (isSolid(gl_FragCoord.xy + middle * pixels)) low = middle;
            else high = middle;
        }
        if (!isGap(gl_FragCoord.xy + high * pixels)) found = high;
    }
    return found;
}

void main() {
    const vec3 ray = frame.rayForward.xyz + clip.x * frame.rayRight.xyz + clip.y * frame.rayUp.xyz;
    const float height = dot(frame.section.xyz, frame.eye.xyz) - frame.section.w;
    const float approach = -dot(frame.section.xyz, ray);
    const vec3 position = frame.eye.xyz + height / approach * ray;
    const vec3 right = dFdx(position), down = dFdy(position); // before anything is discarded
    int mask = 0;
    vec4 sum = vec4(0.0);
    for (int i = 0; i < samples; ++i) {
        const vec4 count = countAt(i);
        if (count.a < 0.75 / 64.0) continue; // up to five walls of cuts more than skins
        mask |= 1 << i;
        sum = count;
    }
    if (mask == 0 || height <= 0.0 || approach <= 0.0) discard; // seen from behind, the skin is visible
    gl_SampleMask[0] = mask;
    const vec4 place = frame.clipFromWorld * vec4(position, 1.0);
    gl_FragDepth = place.z / place.w;

    const float skins = round(sum.a), balls = round(64.0 * (sum.a - skins));
    const bool isSkin = skins > 0.5;
    const vec3 color = sum.rgb / max(isSkin ? skins : balls, 1.0);
    if (frame.look.x > 0.5) { // sums of weighted values and of weights; grey where no particle is near
        shown = matt(position, frame.section.xyz, abs(sum.g) > 1e-3 ? mapColor(sum.r / sum.g, 1.0) : unknownValue);
        return;
    }
    if (!isSkin) {
        shown = shade(position, frame.section.xyz, tissue(color, push.color.w));
        return;
    }
    const uint skin = skinOf(color);
    const bool isKnown = skin < SKIN_COLORS;
    const float gloss = isKnown ? frame.skins[min(skin, SKIN_COLORS - 1u)].w : 1.0, size = insides[min(skin, SKIN_COLORS - 1u)].size.x;
    const float depth = isKnown && gloss >= leastMoist ? outlineDistance(rindReach * size, right, down) : 1e6;
    const InsidePlace at = InsidePlace(position, right, down, depth, size);
    const InsideSurface inside = insideSurface(at, vec4(color, gloss));
    shown = shade(position, bumped(frame.section.xyz, inside, at, right, down), inside.surface);
}
