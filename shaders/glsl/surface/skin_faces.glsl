// Skin triangles that may be replaced by pieces, from bindings 0 to 2, and the test whether they are.
#ifdef TEXELS
layout(binding = 0) uniform usamplerBuffer counts; // SurfaceCounts
layout(binding = 2) uniform usamplerBuffer faces;  // SkinFace
#define PIECES(cell) texelFetch(counts, int(cell)).y
SkinFace faceAt(uint i) {
    const uvec4 words = texelFetch(faces, int(i));
    return SkinFace(words.x, words.y, words.z, words.w);
}
#else
layout(std430, binding = 0) readonly buffer Counts { SurfaceCounts counts[]; };
layout(std430, binding = 2) readonly buffer Faces { SkinFace faces[]; };
#define PIECES(cell) counts[cell].pieces
SkinFace faceAt(uint i) { return faces[i]; }
#endif
layout(std430, binding = 1) readonly buffer State { SurfaceState state; };

uint cellOf(SkinFace face) { return face.item >> 4; }
bool isInPieces(SkinFace face) { return state.missing == 0u && (PIECES(cellOf(face)) >> (face.item & 15u) & 1u) != 0u; }
