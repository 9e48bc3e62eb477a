#version 460
// Shades the surfaces that are seen, each pixel once: a software device shades whole blocks of pixels, so that
// triangles of a few pixels, such as those of skins that are split, would be shaded several times over.
#extension GL_GOOGLE_include_directive : require
#include "viewer/tissue.glsl"

layout(set = 0, binding = 8) uniform sampler2D normals;   // `seen` of shown.glsl
layout(set = 0, binding = 9) uniform sampler2D materials; // `material` of shown.glsl
layout(location = 0) in vec2 clip;
layout(location = 0) out vec4 shown;

void main() {
    const vec4 seen = texelFetch(normals, ivec2(gl_FragCoord.xy), 0);
    const vec4 material = texelFetch(materials, ivec2(gl_FragCoord.xy), 0);
    const vec3 ray = frame.rayForward.xyz + clip.x * frame.rayRight.xyz + clip.y * frame.rayUp.xyz;
    const bool isInside = material.w < -0.5;
    const Surface surface = Surface(material.rgb, isInside ? -1.0 - material.w : material.w, 0.6, isInside ? insideRim : skinRim);
    shown = shadeSeen(frame.eye.xyz + seen.w * ray, seen.xyz, surface);
}
