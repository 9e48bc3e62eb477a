#version 460
// Where the vertices of a cut surface are, and their normals: moved with the material around the corners that each hangs on.
#extension GL_GOOGLE_include_directive : require
#include "kernel.glsl"

layout(std430, binding = 0) readonly buffer State { SurfaceState state; };
layout(std430, binding = 1) readonly buffer CutVertices { CutVertex cutVertices[]; };
layout(std430, binding = 2) readonly buffer Rest { vec4 rest[]; };
layout(std430, binding = 3) readonly buffer Particles { uint particles[]; }; // of each slot
layout(std430, binding = 4) readonly buffer Positions { vec4 positions[]; }; // of each particle
layout(std430, binding = 5) readonly buffer Gradients { Gradient gradients[]; };
layout(std430, binding = 6) writeonly buffer Vertices { SkinVertex vertices[]; };
layout(std430, binding = 7) readonly buffer SkinVertices { SkinVertex skinVertices[]; };
layout(push_constant) uniform Push { CountPush push; };

void main() {
    const uint count = min(push.count, state.points + 3u * state.outside), i = itemIndex(count);
    if (i >= count) return;
    const CutVertex vertex = cutVertices[i];
    if (vertex.point >> 30 == 1u) { // a corner of a skin
        vertices[i] = skinVertices[vertex.point ^ SURFACE_SKIN];
        return;
    }
    const vec3 normal = vec3(vertex.normal[0], vertex.normal[1], vertex.normal[2]) / SURFACE_NORMAL;
    vec3 x = vec3(0.0), turned = vec3(0.0);
    float moving = 0.0;
    for (int c = 0; c < 4; ++c) {
        const uint corner = vertex.corners[c];
        const Gradient g = gradients[corner];
        const mat3 f = mat3(g.x.xyz, g.y.xyz, g.z.xyz), cofactor = mat3(cross(f[1], f[2]), cross(f[2], f[0]), cross(f[0], f[1]));
        const vec4 place = positions[particles[corner]];
        x += vertex.shares[c] * (place.xyz + f * (vertex.rest.xyz - rest[corner].xyz));
        moving += vertex.shares[c] * place.w;
        turned += vertex.shares[c] * (cofactor * normal);
    }
    const float size = length(turned);
    vertices[i] = SkinVertex(vec4(x, moving > 0.0 ? 1.0 : 0.0), vec4(size > 0.0 ? turned / size : vec3(0.0, 1.0, 0.0), 0.0));
}
