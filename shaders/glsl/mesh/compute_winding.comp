#version 460
// The generalised winding number [Jacobson 2013] of every doubtful sample; inside if |w| > 1/2. Traverses the tree of
// boxes over the triangles without a stack: nodes are stored depth first and store the next node after their subtree.
// A far cluster counts as one dipole [Barill et al. 2018]; solid angles after van Oosterom and Strackee (1983).
#extension GL_GOOGLE_include_directive : require
#include "mesh/voxel.glsl"

layout(std430, binding = 0) readonly buffer Vertices { ivec4 vertices[]; };
layout(std430, binding = 1) readonly buffer Triangles { uvec4 triangles[]; };
layout(std430, binding = 2) readonly buffer Nodes { WindingNode nodes[]; };
layout(std430, binding = 3) readonly buffer Order { uint order[]; }; // triangles of the leaves, in order
layout(std430, binding = 4) readonly buffer HullCells { uint hullCells[]; };
layout(std430, binding = 5) readonly buffer Samples { uint doubtfulSamples[]; };
layout(std430, binding = 6) buffer Inside { uint insideWords[]; };

const float pi = 3.14159265358979;

// Position of a sample in integer units, exact; coordinates become floats only after it is subtracted.
ivec3 placeOf(uint index) {
#ifdef CENTERS
    return ivec3(cellAt(index) << push.fractionBits) + (cellSize() >> 1);
#else
    const uvec3 within = uvec3(index, index / 4u, index / 16u) % 4u;
    return ivec3(cellAt(hullCells[index / 64u]) << push.fractionBits) + ivec3(2u * within + 1u) * (cellSize() >> 3);
#endif
}

float windingOf(vec3 a, vec3 b, vec3 c) {
    const vec3 lengths = vec3(length(a), length(b), length(c));
    const float numerator = dot(a, cross(b, c));
    const float denominator = lengths.x * lengths.y * lengths.z + dot(a, b) * lengths.z + dot(b, c) * lengths.x +
                              dot(c, a) * lengths.y;
    return numerator == 0.0 ? 0.0 : atan(numerator, denominator) / (2.0 * pi);
}

void main() {
    const uint i = itemIndex(push.count);
    if (i >= push.count) return;
    const uint index = doubtfulSamples[push.first + i];
    const ivec3 place = placeOf(index);
    const float unit = 1.0 / float(cellSize());
    const vec3 point = vec3(place) * unit;
    float winding = 0.0;
    for (uint n = 0u; n < push.nodeCount;) {
        const WindingNode node = nodes[n];
        const vec3 offset = node.center.xyz - point;
        const float squared = dot(offset, offset);
        if (squared > node.center.w) {
            winding += dot(node.dipole.xyz, offset) / (squared * sqrt(squared));
            n = node.next;
            continue;
        }
        for (uint t = node.first; t < node.first + node.count; ++t) {
            const uvec4 corners = triangles[order[t]];
            winding += windingOf(vec3(vertices[corners.x].xyz - place) * unit, vec3(vertices[corners.y].xyz - place) * unit,
                                 vec3(vertices[corners.z].xyz - place) * unit);
        }
        ++n; // the first child, or the next node after a leaf
    }
    if (abs(winding) > 0.5) atomicOr(insideWords[index / 32u], 1u << (index % 32u));
}
