#version 460
#extension GL_GOOGLE_include_directive : require
#define HAS_COMPLIANCE
#define HAS_DAMPING
#include "constraints/solve_distance.glsl"
