#version 460
// The pieces of skins beside a cut; they look like the skins.
#extension GL_GOOGLE_include_directive : require
#include "viewer/tissue.glsl"
#include "viewer/section.glsl"

layout(location = 0) in vec3 worldPosition;
layout(location = 1) in vec3 worldNormal;
layout(location = 2) in vec4 inBody;
layout(location = 0) out vec4 shown;

void main() {
    keepBehindSection(worldPosition);
    const vec4 skin = frame.skins[min(uint(inBody.w + 0.5), SKIN_COLORS - 1u)];
    shown = shade(worldPosition, worldNormal, tissue(skin.rgb, skin.w));
#ifdef GLASS
    shown.a = glassAlpha(worldPosition, worldNormal);
#endif
}
