#version 460
// Positions and normals of the points of a cut surface: they move with the material around the corners to which each
// is bound.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"

layout(std430, binding = 0) readonly buffer State { SurfaceState state; };
#include "surface/skin_material.glsl"
layout(std430, binding = 7) readonly buffer CutVertices { CutVertex cutVertices[]; };
TEXEL_TWIN(7, usamplerBuffer, cutVertexTexels);
CutVertex vertexAt(uint i) {
    if (!usesTexels) return cutVertices[i];
    const int v = int(4u * i);
    const uvec4 corners = texelFetch(cutVertexTexels, v + 2), last = texelFetch(cutVertexTexels, v + 3);
    const ivec3 normal = ivec3(last.xyz);
    return CutVertex(uintBitsToFloat(texelFetch(cutVertexTexels, v)), uintBitsToFloat(texelFetch(cutVertexTexels, v + 1)),
                     uint[4](corners.x, corners.y, corners.z, corners.w), int[3](normal.x, normal.y, normal.z), last.w);
}
layout(std430, binding = 8) writeonly buffer Vertices { SkinVertex vertices[]; };
layout(std430, binding = 9) writeonly buffer Turns { Gradient turns[]; }; // one per point: rotation of normals, for place_piece_corners
layout(constant_id = 1) const bool hasHung = false; // a skin is bound to the lattice
layout(std430, binding = 10) readonly buffer SkinVertices { SkinVertex skinVertices[]; };
TEXEL_TWIN(10, samplerBuffer, skinTexels);
vec3 skinPlace(uint v) {
    if (usesTexels) return texelFetch(skinTexels, int(2u * v)).xyz;
    return skinVertices[v].position.xyz;
}
#define SKIN_PLACE(v) skinPlace(v)
#define HUNG_BINDING 11
#include "surface/hung_vertex.glsl"
#define MOVED_BINDING 12
#include "surface/moved_vertex.glsl"
layout(std430, binding = 13) readonly buffer Grids { SkinGrid grids[]; }; // by skin
layout(push_constant) uniform Push { CountPush push; };

#include "lattice/link_masks.glsl"
#include "surface/skin_rest.glsl"
#include "surface/nearby.glsl"

// Position of a point on an edge of a skin: towards the end that it belongs to it approaches the skin's position of
// that end.
vec3 rimPlace(vec3 point, Nearby nearby, uint end, uint other) {
    const vec3 from = restOf(end).xyz;
    const float part = min(1.0, length(point - from) / max(length(restOf(other).xyz - from), 1e-30));
    return nearby.place + (1.0 - part) * (SKIN_PLACE(hungAt(end).vertex) - nearby.end);
}

// Position of a vertex as seen by its corner c, and the gradient there. Inside of a bound skin it is computed as for
// rims, so that neither penetrates the other.
vec3 placeAt(CutVertex vertex, int c, out mat3 turn) {
    const vec3 point = vertex.rest.xyz;
    const bool isRim = (vertex.point & SURFACE_RIM) != 0u;
    const uint skin = uint(vertex.rest.w);
    if (hasHung && grids[skin].spacing > 0.0) {
        const SkinGrid grid = grids[skin];
        const vec3 end = isRim ? restOf(vertex.corners[2 + c]).xyz : point;
        const Nearby nearby = nearbyOf(vertex.corners[c], point, end, grid);
        turn = nearby.turn;
        return isRim ? rimPlace(point, nearby, vertex.corners[2 + c], vertex.corners[3 - c]) : nearby.place;
    }
    const uint corner = vertex.corners[c];
    turn = TURN(corner);
    return AT(corner) + turn * (point - HOME(corner));
}

const float leastArea = 1e-4; // of a side of a cut around a point [cells^2]

void main() {
    const uint count = min(push.count, state.points), i = itemIndex(count);
    if (i >= count) return;
    const CutVertex vertex = vertexAt(i);
    vec3 x = vec3(0.0);
    mat3 turn = mat3(0.0); // the cofactor of the gradient
    float moving = 0.0;
    // Most have one corner: the loop visits corners with a share only, since on a software device the others cost
    // time too.
    const bvec4 isShare = notEqual(vertex.shares, vec4(0.0));
    uint left = uint(isShare.x) | uint(isShare.y) << 1 | uint(isShare.z) << 2 | uint(isShare.w) << 3;
    for (; left != 0u; left &= left - 1u) {
        const int c = findLSB(left);
        mat3 f;
        x += vertex.shares[c] * placeAt(vertex, c, f);
        moving += vertex.shares[c] * POSITION(PARTICLE(vertex.corners[c])).w;
        turn += vertex.shares[c] * mat3(cross(f[1], f[2]), cross(f[2], f[0]), cross(f[0], f[1]));
    }
    const vec3 atRest = vec3(vertex.normal[0], vertex.normal[1], vertex.normal[2]) / SURFACE_NORMAL, normal = turn * atRest;
    const float size = length(normal);
    const bool isFront = dot(atRest, atRest) < leastArea * leastArea; // the normals of the two sides cancel out
    vertices[i] = SkinVertex(vec4(x, moving > 0.0 ? 1.0 : 0.0), vec4(size > 0.0 ? normal / size : vec3(0.0, 1.0, 0.0), isFront ? 1.0 : 0.0));
    turns[i] = Gradient(vec4(turn[0], 0.0), vec4(turn[1], 0.0), vec4(turn[2], 0.0));
}
