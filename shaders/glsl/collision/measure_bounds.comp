#version 460
// Computes the box around the particles in the grid. An invocation measures a chunk, so that there are few atomics on
// the shared words.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"
#include "collision/hash_grid.glsl"

#include "common/fetched.glsl"
FETCHED_VEC4(0, Positions, positionAt)
FETCHED_FLOAT(1, Radii, radiusOf)
#define POSITION(i) positionAt(i)
#define RADIUS(i) radiusOf(i)
layout(std430, binding = 2) buffer Bounds { GridBounds bounds; };
layout(push_constant) uniform Push { GridPush push; };

void main() {
    const uint chunks = (push.count - 1u) / GRID_CHUNK + 1u, chunk = itemIndex(chunks);
    if (chunk >= chunks) return;
    uvec3 low = uvec3(~0u), high = uvec3(0u);
    for (uint i = chunk; i < push.count; i += chunks) { // neighbours in a group read neighbours in memory
        if (!isInGrid(RADIUS(i), push.most)) continue;
        const vec3 x = POSITION(i).xyz;
        const uvec3 key = uvec3(keyOf(x.x), keyOf(x.y), keyOf(x.z));
        low = min(low, key);
        high = max(high, key);
    }
    atomicMin(bounds.lowX, low.x);
    atomicMin(bounds.lowY, low.y);
    atomicMin(bounds.lowZ, low.z);
    atomicMax(bounds.highX, high.x);
    atomicMax(bounds.highY, high.y);
    atomicMax(bounds.highZ, high.z);
}
