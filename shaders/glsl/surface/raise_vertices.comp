#version 460
// Skin vertices on the contact surface of their body: each is raised along the mean normal of all faces that meet
// there, so that edges stay closed, until the face nearest to that normal is raised by the radius of the particle. A
// corner of a cube, where the way is sqrt(3) radii, is the sharpest one at rest; no vertex goes farther.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"

layout(std430, binding = 0) buffer Vertices { SkinVertex vertices[]; };
layout(std430, binding = 1) readonly buffer Meeting { VertexTriangles meeting[]; }; // by vertex: entries of Copies
layout(std430, binding = 2) readonly buffer Copies { uint copies[]; }; // vertices at the same particle, one per face
layout(std430, binding = 3) readonly buffer Heights { float heights[]; }; // by vertex [m]
layout(push_constant) uniform Push { CountPush push; };

void main() {
    const uint i = itemIndex(push.count);
    if (i >= push.count) return;
    const VertexTriangles own = meeting[i];
    vec3 along = vec3(0.0);
    for (uint k = 0u; k < own.count; ++k) along += vertices[copies[own.first + k]].normal.xyz;
    const float size = length(along);
    if (size == 0.0) return;
    along /= size;
    float nearest = 0.0; // the largest cosine between the way and a face's normal
    for (uint k = 0u; k < own.count; ++k) nearest = max(nearest, dot(along, vertices[copies[own.first + k]].normal.xyz));
    vertices[i].position.xyz += heights[i] / max(nearest, inversesqrt(3.0)) * along;
}
