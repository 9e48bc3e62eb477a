// The normal of a vertex beside a cut: triangles around it are in pieces or collapsed, so it is the normal at rest,
// rotated with the material like points of the cut (place_cut_points).
//
//   NEAR(i), LINKS(i), HOME(i), TURN(i), AT(i)   as for nearby.glsl
//   grids                                        of each skin
#include "lattice/link_masks.glsl"
#include "surface/nearby.glsl"

SkinGrid grid; // grid of the current vertex
int offsetOf(ivec3 d) { return d.x + d.y * int(grid.rowStride) + d.z * int(grid.sliceStride); }
#define ALIVE(i) LINKS(i)
#define REST(i) HOME(i)
#include "surface/gradient.glsl"

vec3 turnedNormal(HungVertex vertex) {
    const uint i = vertex.anchor;
    grid = grids[uint(vertex.rest.w)];
    const vec3 place = vertex.rest.xyz;
    // A large triangle with a cut reaches beyond the slots beside the cut whose gradients are stored.
    const mat3 turn = NEAR(i) != 0u ? nearbyOf(i, place, place, grid).turn : gradientAt(i);
    return cofactor(turn) * vertex.normal.xyz;
}

vec4 unitNormal(vec3 normal) {
    const float size = length(normal);
    return vec4(size > 0.0 ? normal / size : vec3(0.0, 1.0, 0.0), 0.0);
}
