#version 460
// The pieces of skins beside a cut. They look like the skins but for a dark lip along the cut, which shows a cut that
// does not gape.
#extension GL_GOOGLE_include_directive : require
#include "viewer/tissue.glsl"
#include "viewer/section.glsl"
#include "viewer/shown.glsl"

layout(location = 0) in vec3 worldPosition;
layout(location = 1) in vec3 worldNormal;
layout(location = 2) in vec4 inBody;

const float lipWidth = 1.6; // [pixels]
const float lipShade = 0.22;

// Share of the lip at this pixel: `rim`, 1 on the cut, is linear in a piece, so that its gradient gives the distance.
float lip() {
    const float rim = (inBody.w - roundEven(inBody.w)) / RIM;
    const float fall = length(vec2(dFdx(rim), dFdy(rim)));
    const float distance = (1.0 - rim) / max(fall, 1e-6);
    const float share = 1.0 - smoothstep(lipWidth - 0.7, lipWidth + 0.7, distance);
    return fall > 0.0 ? share : 0.0; // a piece with all its corners on cuts shows none
}

void main() {
    const float dark = lip(); // before anything is discarded: it needs neighbouring pixels
    keepBehindSection(worldPosition);
    const vec4 skin = frame.skins[min(uint(inBody.w + 0.5), SKIN_COLORS - 1u)];
    show(worldPosition, worldNormal, tissue(skin.rgb * mix(1.0, lipShade, dark), skin.w));
}
