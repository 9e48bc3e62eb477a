#version 460
// Skin vertices as stored by the simulation (SkinVertex of layout.h), and vertices of colliders, which have a pose.
#extension GL_GOOGLE_include_directive : require
#include "viewer/frame.glsl"

layout(push_constant) uniform Push { SkinPush push; };
layout(location = 0) in vec4 position;
layout(location = 1) in vec4 normal;
#ifdef SHEET
layout(location = 4) in vec4 sheetIn; // place in the sheet and size of the sheet [m]
layout(location = 3) out vec4 inSheet;
#endif
layout(location = 0) out vec3 worldPosition;
layout(location = 1) out vec3 worldNormal;
#ifdef VALUES
layout(location = 3) in float valueIn;
layout(location = 2) out float value;
#else
layout(location = 2) out float asleep;
#endif

void main() {
    worldPosition = rotated(push.rotation, push.scale.x * position.xyz) + push.position.xyz;
    worldNormal = rotated(push.rotation, normal.xyz);
#ifdef SHEET
    inSheet = sheetIn;
#endif
#ifdef VALUES
    value = valueIn;
#else
    asleep = position.w == 0.0 ? push.position.w : 0.0;
#endif
    gl_Position = frame.clipFromWorld * vec4(worldPosition, 1.0);
}
