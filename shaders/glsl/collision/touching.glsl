// The four particles of a contact: with a face, in the list of its point, or between two edges, in the list of its
// owner.
#include "collision/row_kind.glsl"
layout(std430, binding = TOUCHING_BINDING) readonly buffer Shapes { uvec4 shapes[]; }; // ContactFace or ContactEdge
layout(std430, binding = TOUCHING_BINDING + 1) readonly buffer Corners { uint corners[]; }; // of edges: first of each particle; then 4 x edge + end

uint firstList(uint i) { return areEdges ? corners[i] : i; }
uint lastList(uint i) { return areEdges ? corners[i + 1u] : i + 1u; }
uint listOf(uint k) { return areEdges ? corners[k] / 4u : k; }
uint[4] touchingOf(uint list, uint other) {
    const uvec4 one = shapes[other];
    if (!areEdges) return uint[](list, one.x, one.y, one.z);
    const uvec4 own = shapes[list];
    return uint[](own.x, own.y, one.x, one.y);
}
