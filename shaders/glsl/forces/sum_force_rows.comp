#version 460
// First pass of the forces of planes, colliders, grabs and holds: sums a run of their elements for the step.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"

layout(std430, binding = 0) readonly buffer Forces { vec4 forces[]; };
layout(std430, binding = 1) readonly buffer Elements { uint elements[]; }; // elements of holds
layout(std430, binding = 2) readonly buffer Chunks { ForceChunk chunks[]; };
layout(std430, binding = 3) writeonly buffer Parts { ForceSum parts[]; };
layout(push_constant) uniform Push { ForcePush push; };

void main() {
    const uint c = itemIndex(push.count);
    if (c >= push.count) return;
    const ForceChunk chunk = chunks[c];
    const bool isListed = chunk.moment == 0u; // holds have no moments
    vec3 impulse = vec3(0.0), moment = vec3(0.0);
    for (uint k = chunk.first; k < chunk.first + chunk.count; ++k) {
        const uint element = isListed ? elements[k] : k;
        const vec3 given = forces[element & ~FORCE_SUBTRACTED].xyz;
        impulse += (element & FORCE_SUBTRACTED) != 0u ? -given : given;
        if (!isListed) moment += forces[k + chunk.moment].xyz;
    }
    parts[c] = ForceSum(vec4(impulse, 0.0), vec4(moment, 0.0));
}
