#version 460
// Disables tethers between particles that a cut has separated, and enables them again when links are restored.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"

layout(std430, binding = 0) readonly buffer Labels { uint labels[]; }; // piece labels, by slot
layout(std430, binding = 1) readonly buffer Parted { CutTether parted[]; };
layout(std430, binding = 2) buffer Tethers { TetherReach tethers[]; };
layout(push_constant) uniform Push { CountPush push; };

void main() {
    const uint i = itemIndex(push.count);
    if (i >= push.count) return;
    const CutTether tether = parted[i];
    tethers[tether.tether].reach = labels[tether.particle] == labels[tether.anchor] ? tether.reach : NO_REACH;
}
