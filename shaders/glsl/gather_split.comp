#version 460
#extension GL_GOOGLE_include_directive : require
#define LINKS_GENERAL
#include "gather_split.glsl"
