#version 460
// Says how many groups the passes that build the grid have: none while lists are still complete. And those that depend on
// how fast particles are.
#extension GL_GOOGLE_include_directive : require
#include "kernel.glsl"

layout(std430, binding = 0) buffer Bounds { GridBounds bounds; };
layout(std430, binding = 1) writeonly buffer Arguments { DispatchArguments arguments[]; };
layout(push_constant) uniform Push { GridPush push; };

uint groupsOf(uint items) { return (items - 1u) / GROUP_SIZE + 1u; }

void plan(uint element, bool runs, uint items) {
    arguments[element] = DispatchArguments(runs ? groupsOf(items) : 0u, 1u, 1u, 0u);
}

void main() {
    if (gl_GlobalInvocationID.x > 0u) return;
    const bool isBuilt = bounds.moved > 0u; // watch_motion writes only what is too far
    const bool isSwept = bounds.sweeping > 0u, isSlowed = bounds.hurrying > MOST_FAST;
    plan(GRID_PARTICLES, isBuilt, push.count);
    plan(GRID_PARTICLE_CHUNKS, isBuilt, (push.count - 1u) / GRID_CHUNK + 1u);
    plan(GRID_CELL_CHUNKS, isBuilt, push.cells / GRID_CHUNK);
    plan(GRID_ONE_GROUP, isBuilt, 1u);
    if (push.others > 0u) plan(GRID_OTHERS, isBuilt, push.others);
    plan(GRID_SLOWED, isSlowed, push.count);
    plan(GRID_SWEPT, isBuilt && isSwept, push.count);
    plan(GRID_UNSWEPT, isBuilt && !isSwept, push.count);
    if (isBuilt) {
        bounds.lowX = bounds.lowY = bounds.lowZ = ~0u;
        bounds.highX = bounds.highY = bounds.highZ = 0u;
        ++bounds.builds;
    }
    bounds.moved = bounds.sweeping = 0u;
    bounds.isSwept = isSwept ? 1u : 0u;
    bounds.fast = isSlowed ? 0u : bounds.hurrying;
    bounds.hurrying = 0u;
}
