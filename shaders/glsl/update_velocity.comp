#version 460
#extension GL_GOOGLE_include_directive : require
#include "update_velocity.glsl"
