// Part of gather_lattice: what holds a link, and where bodies may be cut which links are left.
#ifdef HAS_MASKS
#include "link_masks.glsl"
#ifdef TEXELS
layout(binding = CHUNK_BINDING + 1) uniform usamplerBuffer links;
#define LINKS(i) texelFetch(links, int(i)).x
#else
layout(std430, binding = CHUNK_BINDING + 1) readonly buffer Links { uint links[]; };
#define LINKS(i) links[i]
#endif
#ifdef VOLUME
#define HAS_WHOLE_CELLS
layout(std430, binding = CHUNK_BINDING + 2) readonly buffer WholeCells { uint wholeCells[]; }; // as cells; 0 where cut
#endif
#else
#define LINKS(i) 0u
#define whole fill // cells of the march
#endif

// What holds a link: 0 where it is cut. AND, because lavapipe makes a branch of a choice.
float held(Fill fill, uint links, int dx, int dy, int dz) {
    const float sum = heldBy(fill, dx, dy, dz);
#ifdef HAS_MASKS
    return uintBitsToFloat(floatBitsToUint(sum) & uint(bitfieldExtract(int(links), bitOf(dx, dy, dz), 1)));
#else
    return sum;
#endif
}
