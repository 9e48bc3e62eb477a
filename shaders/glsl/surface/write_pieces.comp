#version 460
// The surface of a cut, sixth pass for skins of meshes: pieces of skin triangles, as write_outside does for faces of
// cells. Corners coincide with the vertices of the skin; points on its edges have the skin's normal at rest there.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "common/kernel.glsl"
#include "lattice/link_masks.glsl"

layout(std430, binding = 0) readonly buffer Listed { uint listed[]; }; // the count, and then the items
layout(std430, binding = 1) readonly buffer Owned { uvec4 owned[]; };
layout(std430, binding = 2) readonly buffer Links { uint links[]; };
layout(std430, binding = 3) readonly buffer Prisms { SkinPrism prisms[]; };
#define HUNG_BINDING 4
#include "surface/hung_vertex.glsl"
layout(std430, binding = 5) readonly buffer Starts { uvec2 starts[]; };
layout(std430, binding = 6) readonly buffer State { SurfaceState state; };
layout(std430, binding = 7) buffer Vertices { CutVertex vertices[]; };
layout(std430, binding = 8) writeonly buffer Indices { uint indices[]; };
#define MOVED_BINDING 9
#include "surface/moved_vertex.glsl"
layout(push_constant) uniform Push { PrismPush push; };

#include "surface/skin_prisms.glsl"
#include "surface/skin_points.glsl"
#include "surface/skin_rest.glsl"

uint next; // index of the first outer triangle
SkinPrism prism;
uint self;

#include "surface/piece_vertices.glsl"

// Corners of triangles to write, 4 bits each. There is one place that writes them, because a software device inlines
// every call.
uint noted[6], count = 0u;
void triangle(uint a, uint b, uint c) { noted[count++] = a | b << 4 | c << 8; }

void writeNoted() {
    [[dont_unroll]] for (uint corner = 0u; corner < 3u * count; ++corner) {
        const uint vertex = state.points + 3u * next + corner;
        vertices[vertex] = vertexAt(noted[corner / 3u] >> 4u * (corner % 3u) & 15u);
        indices[3u * (state.inside + next) + corner] = vertex;
    }
}

void main() {
    const uint item = itemIndex(listed[0]);
    if (item >= listed[0] || listed[1u + item] < push.first) return;
    self = listed[1u + item] - push.first;
    prism = prisms[self];
    next = starts[push.first + self].y;
    const uvec3 pattern = patternOf(prism);
    if (pattern.y + pattern.z == 0u) { // whole, but its neighbour is not: the point on their edge is inserted
        [[dont_unroll]] for (uint n = 0u; n < 3u; ++n) {
            const SkinEdge edge = edgeOf(prism, self, n);
            if ((owned[push.first + edge.prism].x >> 2u * edge.edge & 1u) == 0u) continue;
            triangle(n, 3u + n, (n + 2u) % 3u);
            triangle(3u + n, (n + 1u) % 3u, (n + 2u) % 3u);
        }
    } else if (pattern.y == 1u && pattern.z == 2u) {
        [[dont_unroll]] for (uint n = 0u; n < 3u; ++n) {
            triangle(n, 3u + n, firstCenter + n);
            triangle(n, firstCenter + n, 6u + (n + 2u) % 3u);
        }
    } else {
        const uint a = pattern.y == 0u ? 2u : pattern.z == 0u ? 1u : 0u, b = (a + 1u) % 3u, c = (a + 2u) % 3u;
        triangle(a, 3u + a, 6u + c);
        triangle(6u + a, b, c);
        triangle(6u + a, c, 3u + c);
    }
    writeNoted();
}
