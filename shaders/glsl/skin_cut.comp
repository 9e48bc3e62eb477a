#version 460
// Where the points of a cut surface are, and their normals: moved with the material around the corners that each hangs on.
#extension GL_GOOGLE_include_directive : require
#include "kernel.glsl"

layout(std430, binding = 0) readonly buffer State { SurfaceState state; };
layout(std430, binding = 1) readonly buffer CutVertices { CutVertex cutVertices[]; };
layout(std430, binding = 2) readonly buffer Rest { vec4 rest[]; };
layout(std430, binding = 3) readonly buffer Particles { uint particles[]; }; // of each slot
layout(std430, binding = 4) readonly buffer Positions { vec4 positions[]; }; // of each particle
layout(std430, binding = 5) readonly buffer Gradients { Gradient gradients[]; };
layout(std430, binding = 6) writeonly buffer Vertices { SkinVertex vertices[]; };
layout(std430, binding = 7) writeonly buffer Turns { Gradient turns[]; }; // of each point: how normals turn there, for skin_pieces
#ifdef HUNG
layout(std430, binding = 8) readonly buffer SkinVertices { SkinVertex skinVertices[]; };
layout(std430, binding = 9) readonly buffer Hung { HungVertex hung[]; };
layout(std430, binding = 10) readonly buffer Moved { vec4 moved[]; };
layout(std430, binding = 11) readonly buffer Near { uint near[]; };
layout(std430, binding = 12) readonly buffer Links { uint links[]; };
layout(std430, binding = 13) readonly buffer Grids { SkinGrid grids[]; }; // by skin
#endif
layout(push_constant) uniform Push { CountPush push; };

mat3 matrixOf(Gradient g) { return mat3(g.x.xyz, g.y.xyz, g.z.xyz); }

#ifdef HUNG
#include "link_masks.glsl"
#include "skin_rest.glsl"
#include "nearby.glsl"

// Where a point on an edge of a skin is: towards the end of the edge that it goes with it goes over into where the skin has that.
vec3 rimPlace(vec3 point, Nearby nearby, uint end, uint other) {
    const vec3 from = restOf(end).xyz;
    const float part = min(1.0, length(point - from) / max(length(restOf(other).xyz - from), 1e-30));
    return nearby.place + (1.0 - part) * (skinVertices[hung[end].vertex].position.xyz - nearby.end);
}
#endif

// Where what corner c has of a vertex is, and how it has turned. Inside of a skin that hangs it goes as rims do, so that neither pokes out of
// the other.
vec3 placeAt(CutVertex vertex, int c, out mat3 turn) {
    const vec3 point = vertex.rest.xyz;
#ifdef HUNG
    const bool isRim = (vertex.point & SURFACE_RIM) != 0u;
    const SkinGrid grid = grids[uint(vertex.rest.w)];
    if (grid.spacing > 0.0) {
        const vec3 end = isRim ? restOf(vertex.corners[2 + c]).xyz : point;
        const Nearby nearby = nearbyOf(vertex.corners[c], point, end, grid);
        turn = nearby.turn;
        return isRim ? rimPlace(point, nearby, vertex.corners[2 + c], vertex.corners[3 - c]) : nearby.place;
    }
#endif
    const uint corner = vertex.corners[c];
    turn = matrixOf(gradients[corner]);
    return positions[particles[corner]].xyz + turn * (point - rest[corner].xyz);
}

void main() {
    const uint count = min(push.count, state.points), i = itemIndex(count);
    if (i >= count) return;
    const CutVertex vertex = cutVertices[i];
    vec3 x = vec3(0.0);
    mat3 turn = mat3(0.0); // the cofactor of the motion
    float moving = 0.0;
    // Most have one corner: a loop for those that have a share, since a software device takes its time for the others, too.
    const bvec4 isShare = notEqual(vertex.shares, vec4(0.0));
    uint left = uint(isShare.x) | uint(isShare.y) << 1 | uint(isShare.z) << 2 | uint(isShare.w) << 3;
    for (; left != 0u; left &= left - 1u) {
        const int c = findLSB(left);
        mat3 f;
        x += vertex.shares[c] * placeAt(vertex, c, f);
        moving += vertex.shares[c] * positions[particles[vertex.corners[c]]].w;
        turn += vertex.shares[c] * mat3(cross(f[1], f[2]), cross(f[2], f[0]), cross(f[0], f[1]));
    }
    const vec3 normal = turn * vec3(vertex.normal[0], vertex.normal[1], vertex.normal[2]) / SURFACE_NORMAL;
    const float size = length(normal);
    vertices[i] = SkinVertex(vec4(x, moving > 0.0 ? 1.0 : 0.0), vec4(size > 0.0 ? normal / size : vec3(0.0, 1.0, 0.0), 0.0));
    turns[i] = Gradient(vec4(turn[0], 0.0), vec4(turn[1], 0.0), vec4(turn[2], 0.0));
}
