#version 460
#extension GL_GOOGLE_include_directive : require
#define LINKS_PACKED
#include "gather_split.glsl"
