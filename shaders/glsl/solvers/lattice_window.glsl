// Part of gather_lattice: its buffers, and the shape of the window, the part of a slice that an invocation holds: a
// block of columns and its rim.

#include "common/fetched.glsl"
FETCHED_UINT(LINK_BINDING, Cells, cellFill)
#define CELLS(i) cellFill(i)
#define CHUNK_BINDING (LINK_BINDING + 1)
layout(std430, binding = CHUNK_BINDING) readonly buffer Chunks { LatticeChunk chunks[]; };
#ifdef RESIDENT
layout(std430, binding = CHUNK_BINDING + 1) readonly buffer Bodies { uint bodies[]; }; // first slot of each
#endif
layout(push_constant) uniform Push { LatticePush push; };
layout(constant_id = 6) const bool hasBodyDiagonals = false;

#ifdef SHEET
#define COLUMNS_Y 1
#define RIM_Y 0
#else
#define RIM_Y 1
#endif
#define WIDTH (COLUMNS_X + 2)
#define SLICE (WIDTH * (COLUMNS_Y + 2 * RIM_Y))
#define NODES (COLUMNS_X * COLUMNS_Y)

int homeOf(int n) {
    return n % COLUMNS_X + 1 + WIDTH * (n / COLUMNS_X + RIM_Y);
}

// Loads the window of a slice; `origin` is the slot of the block's first node there.
void loadSlice(uint origin, out vec4 slice[SLICE]) {
    [[unroll]] for (int s = 0; s < SLICE; ++s)
        slice[s] = POSITION(origin + (s / WIDTH - RIM_Y) * push.rowStride + s % WIDTH - 1);
}
