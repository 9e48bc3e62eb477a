#version 460
// The surface of a cut, fifth pass: inner triangles. Their normals at rest are added up at the points as integers, so
// that the order does not matter.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "common/cut.glsl"
#include "lattice/link_masks.glsl"
#include "lattice/kuhn.glsl"
#include "surface/cut_points.glsl"

layout(std430, binding = 0) readonly buffer Complex { uint complex[]; };
layout(std430, binding = 1) readonly buffer Partitions { uint partitions[]; };
layout(std430, binding = 2) readonly buffer Owned { uvec4 owned[]; };
layout(std430, binding = 3) readonly buffer Listed { uint listed[]; }; // the count, and then the slots
layout(std430, binding = 4) readonly buffer Starts { uvec2 starts[]; };
layout(std430, binding = 5) buffer Vertices { CutVertex vertices[]; };
layout(std430, binding = 6) writeonly buffer Indices { uint indices[]; };
layout(std430, binding = 7) readonly buffer Links { uint links[]; };

uint next; // index of the next triangle

uint indexOf(uvec2 point) {
    const uvec4 own = owned[point.x];
    return placeOf(own, copyOf(own, point.y));
}

// Corners of triangles to write. There is one place that writes them, because a software device inlines every call.
uvec2 noted[18];
uint count = 0u;
void triangle(uvec2 a, uvec2 b, uvec2 c) {
    noted[count] = a;
    noted[count + 1u] = b;
    noted[count + 2u] = c;
    count += 3u;
}

void writeTriangle(uint first) {
    const uint corners[3] = uint[3](indexOf(noted[first]), indexOf(noted[first + 1u]), indexOf(noted[first + 2u]));
    const vec3 at = vertices[corners[0]].rest.xyz;
    const vec3 area = 0.5 * cross(vertices[corners[1]].rest.xyz - at, vertices[corners[2]].rest.xyz - at);
    const ivec3 normal = ivec3(roundEven(area * (SURFACE_NORMAL / (push.spacing * push.spacing))));
    [[dont_unroll]] for (int n = 0; n < 3; ++n) {
        indices[3u * next + uint(n)] = corners[n];
        [[dont_unroll]] for (int axis = 0; axis < 3; ++axis) atomicAdd(vertices[corners[n]].normal[axis], normal[axis]);
    }
    ++next;
}

void writeNoted() {
    [[dont_unroll]] for (uint n = 0u; n < count; n += 3u) writeTriangle(n);
    count = 0u;
}
#include "surface/cut_inside.glsl"

void main() {
    const uint item = itemIndex(listed[0]);
    if (item >= listed[0]) return;
    const uint i = listed[1u + item];
    if (i - push.first >= push.count) return; // belongs to another run
    next = starts[i].x;
    addInside(i);
}
