#version 460
// Positions and normals of the vertices of sheet pieces: they move with the tangents of the sheet around the corner
// to which each is bound, the best linear fit to the corner's live links. If those links lie in a line, the tangents
// of a neighbour are used, and without links those of the sheet at rest.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"
#include "lattice/link_masks.glsl"

layout(std430, binding = 0) readonly buffer State { SheetState state; };
layout(std430, binding = 1) readonly buffer SheetVertices { SheetVertex sheetVertices[]; };
layout(std430, binding = 2) readonly buffer Links { uint links[]; };
layout(std430, binding = 3) readonly buffer Particles { uint particles[]; }; // one per slot
layout(std430, binding = 4) readonly buffer Positions { vec4 positions[]; }; // one per particle
layout(std430, binding = 5) writeonly buffer Vertices { SkinVertex vertices[]; };
layout(push_constant) uniform Push { SheetSkinPush push; };

struct Tangents {
    vec3 x, z; // [m] per cell
    bool areKnown;
};

uint neighbour(uint i, ivec3 way) { return uint(int(i) + way.x + way.z * int(push.sliceStride)); }

Tangents fit(uint i) {
    const vec3 here = positions[particles[i]].xyz;
    vec3 x = vec3(0.0), z = vec3(0.0);
    float xx = 0.0, xz = 0.0, zz = 0.0;
    for (uint alive = links[i]; alive != 0u; alive &= alive - 1u) {
        const ivec3 way = directionOf(findLSB(alive));
        const vec3 d = positions[particles[neighbour(i, way)]].xyz - here;
        x += float(way.x) * d;
        z += float(way.z) * d;
        xx += float(way.x * way.x);
        xz += float(way.x * way.z);
        zz += float(way.z * way.z);
    }
    const float size = xx * zz - xz * xz; // integers
    if (!(size > 0.5)) return Tangents(push.right.xyz, push.down.xyz, false);
    return Tangents((zz * x - xz * z) / size, (xx * z - xz * x) / size, true);
}

Tangents tangentsAt(uint i) {
    const Tangents own = fit(i);
    if (own.areKnown) return own;
    for (uint alive = links[i]; alive != 0u; alive &= alive - 1u) {
        const Tangents next = fit(neighbour(i, directionOf(findLSB(alive))));
        if (next.areKnown) return next;
    }
    return own;
}

vec3 normalOf(Tangents tangents) {
    const vec3 normal = cross(tangents.z, tangents.x);
    const float size = length(normal);
    return size > 0.0 ? normal / size : vec3(0.0, 1.0, 0.0);
}

void main() {
    const uint count = min(push.vertexRoom, state.vertices), i = itemIndex(count);
    if (i >= count) return;
    const SheetVertex vertex = sheetVertices[i];
    const Tangents at = tangentsAt(vertex.a);
    const vec4 a = positions[particles[vertex.a]], b = positions[particles[vertex.b]];
    vec3 normal = normalOf(at), x = a.xyz + vertex.x * at.x + vertex.z * at.z;
    if (vertex.share > 0.0) {
        normal = mix(normal, normalOf(tangentsAt(vertex.b)), vertex.share);
        x = mix(a.xyz, b.xyz, vertex.share);
    }
    const float size = length(normal), moving = mix(a.w, b.w, vertex.share);
    vertices[push.firstVertex + i] =
        SkinVertex(vec4(x, moving > 0.0 ? 1.0 : 0.0), vec4(vertex.turn * (size > 0.0 ? normal / size : vec3(0.0, 1.0, 0.0)), 0.0));
}
