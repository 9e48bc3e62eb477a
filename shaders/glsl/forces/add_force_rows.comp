#version 460
// Second pass of the forces of planes, colliders, grabs and holds: adds up the sums of the parts of a row, in order.
// An undone step gives zeros.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"

layout(std430, binding = 0) readonly buffer Parts { ForceSum parts[]; };
layout(std430, binding = 1) readonly buffer Ranges { ForceRange ranges[]; };
layout(std430, binding = 2) readonly buffer Status { StatusWords status; };
layout(std430, binding = 3) writeonly buffer Sums { ForceSum sums[]; };
layout(push_constant) uniform Push { ForcePush push; };

void main() {
    const uint r = itemIndex(push.count);
    if (r >= push.count) return;
    const ForceRange range = ranges[r];
    ForceSum sum = ForceSum(vec4(0.0), vec4(0.0));
    const uint end = isFinished(status) ? range.firstPart + range.parts : range.firstPart;
    for (uint p = range.firstPart; p < end; ++p) {
        sum.impulse += parts[p].impulse;
        sum.torque += parts[p].torque;
    }
    sums[push.firstRow + r] = ForceSum(range.sign * sum.impulse, range.sign * sum.torque);
}
