#version 460
#extension GL_GOOGLE_include_directive : require
#define LINKS_GENERAL
#define HAS_PLANES
#include "gather_split.glsl"
