// Part of gather_lattice: the fill that holds a link, and the masks of live links of bodies that may be cut.
#ifdef HAS_MASKS
#include "lattice/link_masks.glsl"
#include "common/fetched.glsl"
FETCHED_UINT(CHUNK_BINDING + 1, Links, linksAt)
#define LINKS(i) linksAt(i)
#ifdef VOLUME
#define HAS_WHOLE_CELLS
layout(std430, binding = CHUNK_BINDING + 2) readonly buffer WholeCells { uint wholeCells[]; }; // like cells; 0 = not whole
#endif
#else
#define LINKS(i) 0u
#define whole fill // cells of the march
#endif

// Sum of the fill of the cells that hold a link: 0 if it is cut. Uses AND, because lavapipe turns a conditional into
// a branch.
float held(Fill fill, uint links, int dx, int dy, int dz) {
    const float sum = heldBy(fill, dx, dy, dz);
#ifdef HAS_MASKS
    return uintBitsToFloat(floatBitsToUint(sum) & uint(bitfieldExtract(int(links), bitOf(dx, dy, dz), 1)));
#else
    return sum;
#endif
}
