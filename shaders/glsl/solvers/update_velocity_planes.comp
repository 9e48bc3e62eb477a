#version 460
#extension GL_GOOGLE_include_directive : require
#define HAS_PLANES
#include "solvers/update_velocity.glsl"
