// The four particles of a contact: with a face, in the list of its point, or, EDGES, between two edges, in the list
// of its owner.
#ifdef EDGES
layout(std430, binding = TOUCHING_BINDING) readonly buffer Edges { ContactEdge edges[]; };
layout(std430, binding = TOUCHING_BINDING + 1) readonly buffer Corners { uint corners[]; }; // first of each particle; then 4 x edge + end
uint firstList(uint i) { return corners[i]; }
uint lastList(uint i) { return corners[i + 1u]; }
uint listOf(uint k) { return corners[k] / 4u; }
uint[4] touchingOf(uint list, uint other) {
    const ContactEdge e = edges[list], f = edges[other];
    return uint[](e.a, e.b, f.a, f.b);
}
#else
layout(std430, binding = TOUCHING_BINDING) readonly buffer Faces { ContactFace faces[]; };
uint firstList(uint i) { return i; }
uint lastList(uint i) { return i + 1u; }
uint listOf(uint k) { return k; }
uint[4] touchingOf(uint list, uint other) {
    const ContactFace face = faces[other];
    return uint[](list, face.a, face.b, face.c);
}
#endif
