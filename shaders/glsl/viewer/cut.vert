#version 460
// The surface of cuts as stored by the simulation: the inside, and, as PIECES, those of skins beside it.
#extension GL_GOOGLE_include_directive : require
#include "viewer/frame.glsl"
#include "common/cut_layout.h"

layout(location = 0) in vec4 position;
layout(location = 1) in vec4 normal;
#ifndef VALUES
layout(location = 2) in vec4 rest; // position of the point in the body as loaded [m]; w = index of its skin
layout(location = 4) in uint point; // CutVertex of layout.h
#endif
layout(location = 0) out vec3 worldPosition;
layout(location = 1) out vec3 worldNormal;
#ifdef VALUES
layout(location = 3) in float valueIn;
layout(location = 2) out float value;
#else
layout(location = 2) out vec4 inBody; // as rest
#endif
#ifdef PIECES
layout(location = 3) out vec3 corner; // 1 for one of a triangle's three vertices, which are its own
layout(location = 4) out vec3 rim;    // the same on the cut, 0 at other vertices
#endif

void main() {
    worldPosition = position.xyz;
    worldNormal = normal.xyz;
#ifdef VALUES
    value = valueIn;
#else
    inBody = rest;
    // The front of a cut has no normal: both of its sides keep theirs up to there. Any normal there would turn through a
    // wide angle within a small triangle, and so through that of a highlight.
    worldNormal = (1.0 - normal.w) * normal.xyz;
#endif
#ifdef PIECES
    const int n = gl_VertexIndex % 3;
    corner = vec3(n == 0, n == 1, n == 2);
    rim = (point & (SURFACE_SKIN | SURFACE_PARTICLE)) == 0u ? corner : vec3(0.0);
#endif
    gl_Position = frame.clipFromWorld * vec4(worldPosition, 1.0);
}
