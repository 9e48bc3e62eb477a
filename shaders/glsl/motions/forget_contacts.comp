#version 460
// Memory of contacts of placed bodies: contacts with other bodies are forgotten, those of a body with itself turn with
// it. One invocation an owner of a list.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"
#include "common/remainder.glsl"

layout(constant_id = 1) const bool areEdges = false;  // owners are edges, else slots
layout(constant_id = 2) const bool haveShapes = false; // partners are faces or edges, else slots
layout(std430, binding = 0) readonly buffer Bodies { uint bodies[]; }; // by slot
layout(std430, binding = 1) readonly buffer Placed { uint placed[]; }; // by body: its pose + 1, or 0
layout(std430, binding = 2) readonly buffer Requests { MotionRequest requests[]; };
layout(std430, binding = 3) readonly buffer Frames { MotionFrame frames[]; };
layout(std430, binding = 4) readonly buffer Contacts { ContactCandidate contacts[]; };
layout(std430, binding = 5) readonly buffer Lists { uvec2 lists[]; };
layout(std430, binding = 6) buffer Memory { vec4 memory[]; }; // xyz: slip [m]
layout(std430, binding = 7) readonly buffer Shapes { uvec4 shapes[]; }; // ContactFace or ContactEdge
layout(push_constant) uniform Push { MotionPush push; };
#include "motions/pose.glsl"

uint bodyOf(uint element, bool isShape) { return bodies[isShape ? shapes[element].x : element]; }
uint poseOf(uint body) { return body < push.bodies ? placed[body] : 0u; }

void main() {
    const uint i = itemIndex(push.count);
    if (i >= push.count) return;
    const uvec2 list = lists[i];
    if (list.y == 0u) return;
    const uint body = bodyOf(i, areEdges), pose = poseOf(body);
    for (uint element = list.x; element < list.x + list.y; ++element) {
        const uint other = bodyOf(contacts[element].other, haveShapes);
        if ((pose | poseOf(other)) == 0u) continue;
        const vec4 one = memory[element];
        const bool turns = body == other && requests[pose - 1u].kind == MOTION_POSE;
        memory[element] = turns ? vec4(rotated(requests[pose - 1u].rotation, one.xyz), one.w) : vec4(0.0);
    }
}
