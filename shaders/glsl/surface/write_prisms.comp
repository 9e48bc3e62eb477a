#version 460
// The surface of a cut, fifth pass for skins of meshes: the inner triangles of prisms, between the points on the skin
// and those on the links below, each twice, once a side, as write_inside does for tetrahedra.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "common/kernel.glsl"
#include "lattice/link_masks.glsl"
#include "surface/surface_points.glsl"

layout(std430, binding = 0) readonly buffer Listed { uint listed[]; }; // the count, and then the items
layout(std430, binding = 1) readonly buffer Owned { uvec4 owned[]; };
layout(std430, binding = 2) readonly buffer Links { uint links[]; };
layout(std430, binding = 3) readonly buffer Prisms { SkinPrism prisms[]; };
layout(std430, binding = 4) readonly buffer Hung { HungVertex hung[]; };
layout(std430, binding = 5) readonly buffer Starts { uvec2 starts[]; };
layout(std430, binding = 6) buffer Vertices { CutVertex vertices[]; };
layout(std430, binding = 7) writeonly buffer Indices { uint indices[]; };
layout(push_constant) uniform Push { PrismPush push; };

#include "surface/skin_prisms.glsl"
#include "surface/skin_points.glsl"

uint next;        // index of the next triangle
float areaToUnit; // scale from area to the unit of a normal

void triangle(uint a, uint b, uint c) {
    const uint corners[3] = uint[3](a, b, c);
    const vec3 at = vertices[a].rest.xyz;
    const vec3 area = 0.5 * cross(vertices[b].rest.xyz - at, vertices[c].rest.xyz - at);
    const ivec3 normal = ivec3(roundEven(area * areaToUnit));
    [[dont_unroll]] for (int n = 0; n < 3; ++n) {
        indices[3u * next + uint(n)] = corners[n];
        [[dont_unroll]] for (int axis = 0; axis < 3; ++axis) atomicAdd(vertices[corners[n]].normal[axis], normal[axis]);
    }
    ++next;
}

// The point of the cut on the link below edge n, on the side of its start or of its end.
uint linkPoint(SkinPrism prism, uint n, bool isStart) {
    const uint link = linkOf(prism, n), slot = lowEnd(prism, n);
    return placeOf(owned[slot], copyOf(owned[slot], edgeBit(link & 7u, isStart == (link < 8u) ? 0u : 1u)));
}

// The point at the centre of the face below, on the side of a corner.
uint facePoint(SkinPrism prism, uint corner) {
    const uint place = prism.places >> 4u + 2u * corner & 3u;
    return placeOf(owned[prism.face], copyOf(owned[prism.face], faceBit(prism.places & 15u, place)));
}

#include "surface/parted_prisms.glsl"

void main() {
    const uint item = itemIndex(listed[0]);
    if (item >= listed[0] || listed[1u + item] < push.first) return;
    const uint self = listed[1u + item] - push.first;
    const SkinPrism prism = prisms[self];
    const uvec3 pattern = patternOf(prism);
    const float spacing = hung[prism.vertices[0]].normal.w;
    areaToUnit = SURFACE_NORMAL / (spacing * spacing);
    next = starts[push.first + self].x;
    if (pattern.z == 2u && pattern.y == 1u) partThree(prism, self);
    else if (pattern.y + pattern.z > 0u) partTwo(prism, self, pattern.y == 0u ? 2u : pattern.z == 0u ? 1u : 0u);
}
