#version 460
// The surface of a cut, sixth pass for skins of meshes: what is left of the triangles of a skin, as write_outside has it for faces of
// cells. Corners of the skin are where the skin has them; points on its edges have its normal at rest there.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "kernel.glsl"
#include "link_masks.glsl"

layout(std430, binding = 0) readonly buffer Listed { uint listed[]; }; // how many, and then the items
layout(std430, binding = 1) readonly buffer Owned { uvec4 owned[]; };
layout(std430, binding = 2) readonly buffer Links { uint links[]; };
layout(std430, binding = 3) readonly buffer Prisms { SkinPrism prisms[]; };
layout(std430, binding = 4) readonly buffer Hung { HungVertex hung[]; };
layout(std430, binding = 5) readonly buffer Starts { uvec2 starts[]; };
layout(std430, binding = 6) readonly buffer State { SurfaceState state; };
layout(std430, binding = 7) buffer Vertices { CutVertex vertices[]; };
layout(std430, binding = 8) writeonly buffer Indices { uint indices[]; };
layout(std430, binding = 9) readonly buffer Moved { vec4 moved[]; };
layout(push_constant) uniform Push { PrismPush push; };

#include "skin_prisms.glsl"
#include "skin_points.glsl"
#include "skin_rest.glsl"

uint next; // triangle, of those outside
SkinPrism prism;
uint self;

// Points: 0 to 2 are corners; 3 + n the point on edge n on the side of its start, 6 + n on that of its end, 9 + n the middle.
CutVertex vertexAt(uint point) {
    const uint n = point % 3u;
    const HungVertex from = hung[prism.vertices[n]], to = hung[prism.vertices[(n + 1u) % 3u]];
    if (point < 3u) {
        const uint i = from.anchor;
        const ivec3 normal = ivec3(from.normal.xyz * SURFACE_NORMAL);
        return CutVertex(restOf(prism.vertices[n]), vec4(0.0), uint[4](i, i, i, i), int[3](normal.x, normal.y, normal.z), SURFACE_SKIN | from.vertex);
    }
    CutVertex vertex = vertices[point < firstCenter ? skinPoint(prism, self, n, point < 6u) : skinCenter(self, n)];
    const vec3 start = restOf(prism.vertices[n]).xyz, way = restOf(prism.vertices[(n + 1u) % 3u]).xyz - start;
    const float share = clamp(dot(vertex.rest.xyz - start, way) / max(dot(way, way), 1e-30), 0.0, 1.0);
    const vec3 third = hung[prism.vertices[(n + 2u) % 3u]].normal.xyz;
    const vec3 mean = point < firstCenter ? mix(from.normal.xyz, to.normal.xyz, share) : from.normal.xyz + to.normal.xyz + third;
    const ivec3 normal = ivec3(mean * SURFACE_NORMAL);
    vertex.normal = int[3](normal.x, normal.y, normal.z);
    return vertex;
}

void triangle(uint a, uint b, uint c) {
    const uint corners[3] = uint[3](a, b, c);
    [[dont_unroll]] for (uint n = 0u; n < 3u; ++n) {
        const uint vertex = state.points + 3u * next + n;
        vertices[vertex] = vertexAt(corners[n]);
        indices[3u * (state.inside + next) + n] = vertex;
    }
    ++next;
}

void main() {
    const uint item = itemIndex(listed[0]);
    if (item >= listed[0] || listed[1u + item] < push.first) return;
    self = listed[1u + item] - push.first;
    prism = prisms[self];
    next = starts[push.first + self].y;
    const uvec3 pattern = patternOf(prism);
    if (pattern.y + pattern.z == 0u) { // whole, but the next one is not: its point is put in
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
}
