#version 460
// Positions and normals of the corners of skin pieces. Runs after place_cut_points: most corners coincide with points of the
// cut surface, but have another normal at rest.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"

layout(std430, binding = 0) readonly buffer State { SurfaceState state; };
layout(std430, binding = 1) readonly buffer CutVertices { CutVertex cutVertices[]; };
layout(std430, binding = 2) readonly buffer Positions { vec4 positions[]; }; // one per particle
layout(std430, binding = 3) readonly buffer Gradients { Gradient gradients[]; }; // one per slot
layout(std430, binding = 4) buffer Vertices { SkinVertex vertices[]; };
layout(std430, binding = 5) readonly buffer SkinVertices { SkinVertex skinVertices[]; };
layout(std430, binding = 6) readonly buffer Turns { Gradient turns[]; };
layout(push_constant) uniform Push { CountPush push; };

SkinVertex turned(vec4 place, mat3 turn, vec3 normal) {
    const vec3 n = turn * normal;
    const float size = length(n);
    return SkinVertex(place, vec4(size > 0.0 ? n / size : vec3(0.0, 1.0, 0.0), 0.0));
}

void main() {
    const uint count = min(push.count - min(push.count, state.points), 3u * state.outside), item = itemIndex(count);
    if (item >= count) return;
    const uint i = state.points + item, point = cutVertices[i].point;
    const vec3 normal = vec3(cutVertices[i].normal[0], cutVertices[i].normal[1], cutVertices[i].normal[2]);
    if ((point & SURFACE_PARTICLE) != 0u) {
        const vec4 x = positions[point ^ SURFACE_PARTICLE];
        const Gradient g = gradients[cutVertices[i].corners[0]];
        vertices[i] = turned(vec4(x.xyz, x.w > 0.0 ? 1.0 : 0.0),
                             mat3(cross(g.y.xyz, g.z.xyz), cross(g.z.xyz, g.x.xyz), cross(g.x.xyz, g.y.xyz)), normal);
    } else if ((point & SURFACE_SKIN) != 0u) {
        vertices[i] = skinVertices[point ^ SURFACE_SKIN];
    } else {
        const uint at = point & SURFACE_RIM - 1u;
        vertices[i] = turned(vertices[at].position, mat3(turns[at].x.xyz, turns[at].y.xyz, turns[at].z.xyz), normal);
    }
}
