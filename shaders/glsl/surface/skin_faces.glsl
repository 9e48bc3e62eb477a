// Skin triangles that may be replaced by pieces, from bindings 0 to 2, and the test whether they are.
#include "common/fetched.glsl"
FETCHED_UVEC2(0, Counts, surfaceCounts) // SurfaceCounts
FETCHED_UVEC4(2, Faces, faceWords)      // SkinFace
#define PIECES(cell) surfaceCounts(cell).y
SkinFace faceAt(uint i) {
    const uvec4 words = faceWords(i);
    return SkinFace(words.x, words.y, words.z, words.w);
}
layout(std430, binding = 1) readonly buffer State { SurfaceState state; };

uint cellOf(SkinFace face) { return face.item >> 4; }
bool isInPieces(SkinFace face) { return state.missing == 0u && (PIECES(cellOf(face)) >> (face.item & 15u) & 1u) != 0u; }
