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
layout(location = 3) in vec3 corner;
layout(location = 4) in vec3 rim;

const float lipWidth = 1.6; // [pixels]
const float lipShade = 0.22;

// Distance of this pixel to a line between two places, which are relative to it.
float distanceTo(vec2 from, vec2 to) {
    const vec2 way = to - from;
    return length(from + clamp(-dot(from, way) / max(dot(way, way), 1e-6), 0.0, 1.0) * way);
}

// Share of the lip at this pixel. An edge or single corners of a piece lie on the cut. The weights of corners are linear
// in the picture, so that their gradients give the places of the corners.
float lip() {
    const vec2 fallB = vec2(dFdx(corner.y), dFdy(corner.y)), fallC = vec2(dFdx(corner.z), dFdy(corner.z));
    const float area = fallB.x * fallC.y - fallB.y * fallC.x; // of a pixel, in units of the piece
    const bvec3 isRim = greaterThan(abs(rim), 0.5 * abs(corner));
    if (area == 0.0) return any(isRim) ? 1.0 : 0.0;
    const vec2 b = vec2(fallC.y, -fallC.x) / area, c = vec2(-fallB.y, fallB.x) / area; // edges from the first corner
    const vec2 first = -(corner.y * b + corner.z * c);
    const vec2 at[3] = vec2[3](first, first + b, first + c);
    const bool isEdge = !all(isRim); // three corners on the cut are joined by no edge of it
    float distance = 1e6;
    for (int n = 0; n < 3; ++n) {
        const int next = (n + 1) % 3;
        if (isRim[n]) distance = min(distance, distanceTo(at[n], isRim[next] && isEdge ? at[next] : at[n]));
    }
    return 1.0 - smoothstep(lipWidth - 0.7, lipWidth + 0.7, distance);
}

void main() {
    const float dark = lip(); // before anything is discarded: it needs neighbouring pixels
    keepBehindSection(worldPosition);
    const vec4 skin = frame.skins[min(uint(inBody.w + 0.5), SKIN_COLORS - 1u)];
    show(worldPosition, worldNormal, tissue(skin.rgb * mix(1.0, lipShade, dark), skin.w));
}
