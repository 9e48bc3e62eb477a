#version 460
// Particles of bodies without a skin: one unit ball, placed and scaled per instance.
#extension GL_GOOGLE_include_directive : require
#include "common/pieces.h"
#include "viewer/frame.glsl"

layout(push_constant) uniform Push { SkinPush push; };
layout(location = 0) in vec4 corner; // on the unit ball
layout(location = 1) in vec4 center; // public position of a particle; w = 0: static
layout(location = 2) in float radius;
layout(location = 4) in uint piece;
layout(location = 0) out vec3 worldPosition;
layout(location = 1) out vec3 worldNormal;
#ifdef VALUES
layout(location = 3) in float valueIn;
layout(location = 2) out float value;
#else
layout(location = 2) out float asleep;
#endif
#ifdef REACH
layout(location = 3) out float reach;
#endif

void main() {
    worldPosition = center.xyz + (piece == REMOVED_PIECE ? 0.0 : radius) * corner.xyz;
    worldNormal = corner.xyz;
#ifdef VALUES
    value = valueIn;
#else
    asleep = center.w == 0.0 ? push.position.w : 0.0;
#endif
#ifdef REACH
    reach = piece == REMOVED_PIECE ? 0.0 : radius;
#endif
    gl_Position = frame.clipFromWorld * vec4(worldPosition, 1.0);
}
