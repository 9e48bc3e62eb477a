#version 460
// The inside of bodies opened by a cut. Its texture uses the coordinates of the body as loaded, so that it moves with
// the tissue.
#extension GL_GOOGLE_include_directive : require
#include "viewer/tissue.glsl"
#include "viewer/inside.glsl"
#include "viewer/section.glsl"
#include "viewer/shown.glsl"

layout(location = 0) in vec3 worldPosition;
layout(location = 1) in vec3 worldNormal;
layout(location = 2) in vec4 inBody;

void main() {
    keepBehindSection(worldPosition);
    const vec4 skin = frame.skins[min(uint(inBody.w + 0.5), SKIN_COLORS - 1u)];
    show(worldPosition, worldNormal, insideSurface(inBody.xyz, skin));
}
