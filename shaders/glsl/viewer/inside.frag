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

// The normal, or, in a triangle that has none, the direction across it, towards the eye.
vec3 normalHere() {
    const vec3 across = cross(dFdx(worldPosition), dFdy(worldPosition));
    if (dot(worldNormal, worldNormal) > 1e-12) return worldNormal;
    return dot(across, frame.eye.xyz - worldPosition) < 0.0 ? -across : across;
}

void main() {
    // Before anything is discarded: these need neighbouring pixels.
    const vec3 normal = normalHere(), right = dFdx(worldPosition), down = dFdy(worldPosition);
    const uint index = uint(inBody.w + 0.5), skin = min(index, SKIN_COLORS - 1u);
    const float depth = index < SKIN_COLORS ? depthBelow(inBody.xyz, skin) : 1e6;
    const InsidePlace at = InsidePlace(inBody.xyz, dFdx(inBody.xyz), dFdy(inBody.xyz), depth, insides[skin].size.x);
    keepBehindSection(worldPosition);
    const InsideSurface inside = insideSurface(at, frame.skins[skin]);
    show(worldPosition, bumped(normal, inside, at, right, down), inside.surface);
}
