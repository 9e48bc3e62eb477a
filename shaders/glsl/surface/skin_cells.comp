#version 460
// Skin vertices in lattice cells: trilinear over the cell's eight particles, exact for affine motion.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"

#include "common/fetched.glsl"
FETCHED_VEC4(0, Positions, positionAt)
layout(std430, binding = 1) readonly buffer Cells { CellVertex cells[]; };
TEXEL_TWIN(1, usamplerBuffer, cellTexels);
#define POSITION(i) positionAt(i)
CellVertex cellAt(uint i) {
    if (!usesTexels) return cells[i];
    const int c = int(3u * i);
    const uvec4 weights = texelFetch(cellTexels, c), low = texelFetch(cellTexels, c + 1), high = texelFetch(cellTexels, c + 2);
    return CellVertex(uintBitsToFloat(weights), uint[8](low.x, low.y, low.z, low.w, high.x, high.y, high.z, high.w));
}
layout(std430, binding = 2) writeonly buffer Vertices { SkinVertex vertices[]; };
layout(push_constant) uniform Push { SkinPush push; };

void main() {
    const uint i = itemIndex(push.count);
    if (i >= push.count) return;
    const CellVertex cell = cellAt(i);
    const vec3 t = cell.weights.xyz;
    vec3 x = vec3(0.0);
    float w = 0.0;
    for (uint k = 0u; k < 8u; ++k) {
        const bvec3 isHigh = notEqual(uvec3(k) & uvec3(1u, 2u, 4u), uvec3(0u));
        const vec3 share = mix(1.0 - t, t, isHigh);
        const vec4 corner = POSITION(cell.corners[k]);
        x += share.x * share.y * share.z * corner.xyz;
        w += corner.w;
    }
    vertices[push.firstVertex + i].position = vec4(x, w > 0.0 ? 1.0 : 0.0);
}
