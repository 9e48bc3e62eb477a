#version 460
// Winding number of closed surfaces around the point where a pixel's ray meets the section plane: of all surfaces
// that the ray passes behind it, each back face adds one and each front face subtracts one. Sums with the surface's
// color, and a sum of counts alone: 1 per skin, 1/64 per ball; a wall of a cut has 1/512 beside the 1 of its skin. With a
// color map the color's place is left to section_values.frag; a ball has its own value there.
#extension GL_GOOGLE_include_directive : require
#include "viewer/frame.glsl"
#include "viewer/section.glsl"

layout(push_constant) uniform Push { SkinPush push; };
layout(location = 0) in vec3 worldPosition;
layout(location = 1) in vec3 worldNormal;
#if defined(CUTS)
layout(location = 2) in vec4 inBody;
layout(constant_id = 6) const bool isWall = true; // false: a piece of the skin beside a cut
#elif defined(VALUES)
layout(location = 2) in float value;
#else
layout(location = 2) in float asleep;
#endif
layout(location = 0) out vec4 sum;

void main() {
    keepBehindSection(worldPosition);
#if defined(CUTS)
    const vec4 surface = vec4(frame.skins[min(uint(inBody.w + 0.5), SKIN_COLORS - 1u)].rgb, isWall ? 1.0 + 1.0 / 512.0 : 1.0);
#elif defined(VALUES)
    const bool isKnown = value >= 0.0 && push.color.x > 0.0;
    const vec4 surface = vec4(isKnown ? vec3(min(value / push.color.x, 4.0), 1.0, 0.0) : vec3(0.0), 1.0 / 64.0);
#elif defined(BALLS)
    const vec4 surface = vec4(push.color.rgb, 1.0 / 64.0);
#else
    const vec4 surface = vec4(push.color.rgb, 1.0);
#endif
    sum = gl_FrontFacing ? -surface : surface;
#ifndef VALUES
    if (frame.look.x > 0.5) sum.rgb = vec3(0.0);
#endif
}
