#version 460
#extension GL_GOOGLE_include_directive : require
#define HAS_COMPLIANCE
#include "constraints/solve_distance.glsl"
