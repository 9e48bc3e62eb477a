#version 460
// Says how many groups the passes that build the grid have: none while lists are still complete.
#extension GL_GOOGLE_include_directive : require
#include "kernel.glsl"

layout(std430, binding = 0) buffer Bounds { GridBounds bounds; };
layout(std430, binding = 1) writeonly buffer Arguments { DispatchArguments arguments[]; };
layout(push_constant) uniform Push { GridPush push; };

uint groupsOf(uint items) { return (items - 1u) / GROUP_SIZE + 1u; }

void main() {
    if (gl_GlobalInvocationID.x > 0u) return;
    const uint whole = bounds.moved > 0u ? 1u : 0u; // watch_motion writes only what is too far
    const uint particleChunks = (push.count - 1u) / GRID_CHUNK + 1u;
    arguments[GRID_PARTICLES] = DispatchArguments(whole * groupsOf(push.count), 1u, 1u, 0u);
    arguments[GRID_PARTICLE_CHUNKS] = DispatchArguments(whole * groupsOf(particleChunks), 1u, 1u, 0u);
    arguments[GRID_CELL_CHUNKS] = DispatchArguments(whole * groupsOf(push.cells / GRID_CHUNK), 1u, 1u, 0u);
    arguments[GRID_ONE_GROUP] = DispatchArguments(whole, 1u, 1u, 0u);
    if (push.others > 0u) arguments[GRID_OTHERS] = DispatchArguments(whole * groupsOf(push.others), 1u, 1u, 0u);
    if (whole == 0u) return;
    bounds = GridBounds(~0u, ~0u, ~0u, 0u, 0u, 0u, 0u, bounds.builds + 1u);
}
