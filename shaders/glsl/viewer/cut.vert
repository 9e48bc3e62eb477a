#version 460
// The surface of cuts as stored by the simulation: the inside, and pieces of skins beside it.
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
layout(location = 2) out vec4 inBody; // as rest, but w is larger by RIM on the cut: not at other corners of pieces
#endif

void main() {
    worldPosition = position.xyz;
    worldNormal = normal.xyz;
#ifdef VALUES
    value = valueIn;
#else
    inBody = rest;
    if ((point & (SURFACE_SKIN | SURFACE_PARTICLE)) == 0u) inBody.w += RIM;
#endif
    gl_Position = frame.clipFromWorld * vec4(worldPosition, 1.0);
}
