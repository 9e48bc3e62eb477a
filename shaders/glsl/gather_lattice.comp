#version 460
// `split` for bodies on a regular grid: neighbours are computed, not listed. An invocation marches a block of COLUMNS_X x
// COLUMNS_Y columns of nodes along z and keeps two slices of it and its rim in registers, so that a node is loaded
// once for every column that needs it (lattice design, 0.1). Every link is computed from both of its ends and a node's
// links are summed in the order z, y, x: bits do not depend on the shape of the block.
//
// A node's word holds the fill of the eight cells around it, four bits each in 1/15; cell k lies on the side
// (k & 1, k >> 1 & 1, k >> 2). A link's stiffness is the sum over the cells that hold it, times a unit per kind of
// link: this is the assembly per cell, and a link that no cell holds is absent. SHEET: one layer of nodes in y; a link is
// whole where any cell holds it. VOLUME: every cell also resists a change of its signed volume.
#extension GL_GOOGLE_include_directive : require
#define GROUP_SIZE LATTICE_GROUP
#include "split.glsl"

#ifdef TEXELS
layout(binding = LINK_BINDING) uniform usamplerBuffer cells;
#define CELLS(i) texelFetch(cells, int(i)).x
#else
layout(std430, binding = LINK_BINDING) readonly buffer Cells { uint cells[]; };
#define CELLS(i) cells[i]
#endif
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

#include "cell_fill.glsl"

vec3 latticeLink(vec4 a, vec4 b, Fill fill, int dx, int dy, int dz, float hh) {
    const int kind = abs(dx) + abs(dy) + abs(dz) - 1; // edge, face diagonal, body diagonal
    const float clamped = min(push.units[kind] * hh, push.shares[kind] * min(a.w, b.w));
    return linkImpulse(a.xyz, b.xyz, push.restLengths[kind], heldBy(fill, dx, dy, dz) * clamped);
}

bool isLink(int dx, int dy, int dz) {
    const int axes = abs(dx) + abs(dy) + abs(dz);
    return axes == 1 || axes == 2 || axes == 3 && hasBodyDiagonals;
}

// The impulses on the node at `home` of `slice` from its neighbours in `other`, which lies dz slices above.
vec3 gather(vec4 slice[SLICE], vec4 other[SLICE], int home, Fill fill, int dz, float hh) {
    vec3 sum = vec3(0.0);
    [[unroll]] for (int dy = -RIM_Y; dy <= RIM_Y; ++dy)
        [[unroll]] for (int dx = -1; dx <= 1; ++dx)
            if (isLink(dx, dy, dz)) sum += latticeLink(slice[home], other[home + dx + WIDTH * dy], fill, dx, dy, dz, hh);
    return sum;
}

#ifdef VOLUME
#include "cell_volume.glsl"
#endif

uint nodeAt(uint origin, int n) {
    return origin + n % COLUMNS_X + n / COLUMNS_X * push.rowStride;
}

int homeOf(int n) {
    return n % COLUMNS_X + 1 + WIDTH * (n / COLUMNS_X + RIM_Y);
}

void loadSlice(uint origin, out vec4 slice[SLICE]) {
    [[unroll]] for (int s = 0; s < SLICE; ++s)
        slice[s] = POSITION(origin + (s / WIDTH - RIM_Y) * push.rowStride + s % WIDTH - 1);
}

void march(LatticeChunk chunk, Substep substep) {
    uint origin = chunk.origin;
    vec4 slice[SLICE], above[SLICE];
    Fill fill[NODES];
    vec3 below[NODES]; // what the links to the slice before contribute
    loadSlice(origin - push.sliceStride, slice);
    loadSlice(origin, above);
    [[unroll]] for (int n = 0; n < NODES; ++n) {
        fill[n] = unpack(CELLS(nodeAt(origin, n)));
        below[n] = gather(above, slice, homeOf(n), fill[n], -1, substep.hh);
    }
#ifdef VOLUME
    vec3 pressed[NODES], pressedBelow[NODES], pressedAbove[NODES];
    pressCells(slice, above, fill, false, substep.hh, pressedAbove, pressedBelow);
#endif
    for (uint layer = 0u; layer < chunk.layers; ++layer) {
        slice = above;
        loadSlice(origin + push.sliceStride, above);
#ifdef VOLUME
        [[unroll]] for (int n = 0; n < NODES; ++n) pressed[n] = pressedBelow[n];
        pressCells(slice, above, fill, true, substep.hh, pressedAbove, pressedBelow);
#endif
        [[unroll]] for (int n = 0; n < NODES; ++n) {
            const uint i = nodeAt(origin, n);
            const int home = homeOf(n);
            vec3 sum = below[n] + gather(slice, slice, home, fill[n], 0, substep.hh)
                       + gather(slice, above, home, fill[n], 1, substep.hh);
#ifdef VOLUME
            sum += pressed[n] + pressedAbove[n];
#endif
            fill[n] = unpack(CELLS(i + push.sliceStride));
            below[n] = gather(above, slice, home, fill[n], -1, substep.hh);
            advance(i, slice[home], velocities[i], sum, substep);
        }
        origin += push.sliceStride;
    }
}

#ifdef RESIDENT
// All substeps of one body a work group. Chunks are padded with empty ones to the same whole number for every lane.
void main() {
    const uint lane = isReversed ? GROUP_SIZE - 1u - gl_LocalInvocationID.x : gl_LocalInvocationID.x;
    const uint body = itemIndex(push.count) / GROUP_SIZE;
    firstSlot = bodies[body];
    lastSlot = firstSlot + push.bodySlots - 1u;
    for (uint i = lane; i < push.bodySlots; i += GROUP_SIZE)
        resident[i] = resident[residentSlots + i] = positions[firstSlot + i]; // what nobody marches stays in both
    barrier();
    for (uint s = 0u; s < push.substeps; ++s) {
        const Substep substep = substepOf(s == 0u);
        for (uint c = lane; c < push.bodyChunks; c += GROUP_SIZE) march(chunks[body * push.bodyChunks + c], substep);
        barrier();
        front = residentSlots - front;
        back = residentSlots - back;
    }
    for (uint i = lane; i < push.bodySlots; i += GROUP_SIZE) positions[firstSlot + i] = resident[front + i];
}
#else
void main() {
    march(chunks[itemIndex(push.count)], substepOf(push.isFirst != 0u)); // padding has no layers
}
#endif
