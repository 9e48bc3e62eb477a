// Hides the vertices of a removed piece: collapses them to the particle that the piece is named after.
layout(std430, binding = 0) readonly buffer Slots { uint slots[]; };         // one per vertex of all skins
layout(std430, binding = 1) readonly buffer Particles { uint particles[]; }; // one per slot
layout(std430, binding = 2) readonly buffer Pieces { uint pieces[]; };
layout(std430, binding = 3) readonly buffer Labels { uint labels[]; };
layout(std430, binding = 4) readonly buffer Positions { vec4 positions[]; };
layout(std430, binding = 5) writeonly buffer Vertices { SkinVertex vertices[]; };

void hide(uint vertex, uint slot) {
    if (slot == NO_PARTICLE || pieces[particles[slot]] != REMOVED_PIECE) return;
    vertices[vertex] = SkinVertex(vec4(positions[particles[labels[slot]]].xyz, 0.0), vec4(0.0, 1.0, 0.0, 0.0));
}
