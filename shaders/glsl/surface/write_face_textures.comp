#version 460
// Texture coordinates of the pieces of outer faces of cells that write_outside has written: linear in each triangle of
// the skin.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "common/texture_layout.h"
#define CUT_PUSH TexturedFacePush
#include "common/cut.glsl"
#include "common/triangle.glsl"
#include "lattice/link_masks.glsl"
#include "lattice/kuhn.glsl"
#include "surface/cut_points.glsl"

layout(std430, binding = 0) readonly buffer Complex { uint complex[]; };
layout(std430, binding = 1) readonly buffer Partitions { uint partitions[]; };
layout(std430, binding = 2) readonly buffer Owned { uvec4 owned[]; };
layout(std430, binding = 3) readonly buffer Textured { TexturedFace textured[]; };
layout(std430, binding = 4) readonly buffer Starts { uvec2 starts[]; };
layout(std430, binding = 5) readonly buffer State { SurfaceState state; };
layout(std430, binding = 6) readonly buffer Rest { vec4 rest[]; };
layout(std430, binding = 7) readonly buffer Vertices { CutVertex vertices[]; };
layout(std430, binding = 8) readonly buffer Counts { SurfaceCounts counts[]; };
layout(std430, binding = 9) writeonly buffer CutCoordinates { vec2 cutCoordinates[]; };

uint count = 0u; // triangles of the face
void triangle(uvec2 a, uvec2 b, uvec2 c) { ++count; }
void writeNoted() {}
bool hasPoint(uvec2 point) { return hasBit(owned[point.x], point.y & ~1u); }
void setNormal(uint axis, bool isHigh) {}
#include "surface/cut_outside.glsl"

// Number of triangles before those of a face of the cell, in the order of addOutside(). Sets the face's own count.
uint trianglesBefore(uint cell, uint face) {
    uint before = 0u;
    [[dont_unroll]] for (uint f = 0u; f <= face; ++f) {
        if (!isOuter(cell, f >> 1, f & 1u)) continue;
        before += count;
        count = 0u;
        outsideFace(cell, f >> 1, 3u * (f & 1u), partitionOf(partitions[cell], f >> 1));
    }
    return before;
}

void main() {
    const uint i = itemIndex(push.count);
    if (i >= push.count) return;
    const TexturedFace self = textured[push.first + i];
    const uint cell = self.item >> 4, face = self.item & 15u, p = face >> 1;
    if (state.missing > 0u || (counts[cell].pieces >> face & 1u) == 0u) return;
    const uint next = state.points + 3u * (starts[cell].y + trianglesBefore(cell, face));
    const uvec4 all = cornersOf(p);
    const uvec3 corners = faceOf(3u * (face & 1u));
    const vec3 a = rest[slotOf(cell, all[corners.x])].xyz;
    const Triangle whole = triangleOf(rest[slotOf(cell, all[corners.y])].xyz - a, rest[slotOf(cell, all[corners.z])].xyz - a);
    [[dont_unroll]] for (uint n = 0u; n < 3u * count; ++n) {
        const vec3 weights = weightsOf(vertices[next + n].rest.xyz - a, whole);
        cutCoordinates[next + n] = weights.x * vec2(self.at[0], self.at[1]) + weights.y * vec2(self.at[2], self.at[3])
                                   + weights.z * vec2(self.at[4], self.at[5]);
    }
}
