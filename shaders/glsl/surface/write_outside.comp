#version 460
// The surface of a cut, sixth pass: pieces of outer faces. Each triangle has its own vertices, because a body's faces
// meet at sharp edges.
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
layout(std430, binding = 5) readonly buffer State { SurfaceState state; };
layout(std430, binding = 6) readonly buffer Rest { vec4 rest[]; }; // w = index of the body's skin
layout(std430, binding = 7) buffer Vertices { CutVertex vertices[]; };
layout(std430, binding = 8) writeonly buffer Indices { uint indices[]; };
layout(std430, binding = 9) readonly buffer Particles { uint particles[]; }; // one per slot

uint next; // index of the next outer triangle
int normal[3];

void setNormal(uint axis, bool isHigh) {
    const int size = int(SURFACE_NORMAL) * (isHigh ? 1 : -1);
    [[dont_unroll]] for (uint n = 0u; n < 3u; ++n) normal[n] = axis == 1u << n ? size : 0;
}

bool hasPoint(uvec2 point) { return hasBit(owned[point.x], point.y & ~1u); }

const uint ofParticle = 128u; // particleBit of cut_outside

CutVertex vertexAt(uvec2 point) {
    const uint i = point.x;
    if (point.y == ofParticle)
        return CutVertex(rest[i], vec4(1.0, 0.0, 0.0, 0.0), uint[4](i, i, i, i), normal, SURFACE_PARTICLE | particles[i]);
    CutVertex vertex = vertices[placeOf(owned[i], copyOf(owned[i], point.y))];
    vertex.normal = normal;
    return vertex;
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

void writeNoted() {
    [[dont_unroll]] for (uint n = 0u; n < count; ++n) {
        const uint vertex = state.points + 3u * next + n;
        vertices[vertex] = vertexAt(noted[n]);
        indices[3u * (state.inside + next) + n] = vertex;
    }
    next += count / 3u;
    count = 0u;
}
#include "surface/cut_outside.glsl"

void main() {
    const uint item = itemIndex(listed[0]);
    if (item >= listed[0]) return;
    const uint i = listed[1u + item];
    if (i - push.first >= push.count) return; // belongs to another run
    next = starts[i].y;
    addOutside(i);
}
