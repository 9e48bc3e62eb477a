#version 460
// `split` for bodies on a regular grid: neighbours are computed, not listed. An invocation marches a block of
// COLUMNS_X x COLUMNS_Y columns of nodes along z and keeps two slices of the block and its rim in registers, so that
// a node is loaded once for every column that needs it. Every link is computed from both of its ends and a node's
// links are summed in the order z, y, x: bits do not depend on the shape of the block.
//
// A node's word holds the fill of the eight cells around it, four bits each in 1/15; cell k lies on the side (k & 1,
// k >> 1 & 1, k >> 2). A link's stiffness is the sum over the cells that hold it, times a unit per kind of link: this
// is the assembly per cell, and a link that no cell holds is absent. SHEET: one layer of nodes in y; a link is whole
// where any cell holds it. VOLUME: every cell also resists a change of its signed volume. HAS_MASKS: a second word
// has a bit for each live link of a node, and with VOLUME a third word marks whole cells.
//
// ONE_NODE: an invocation computes one node. A GPU needs many short invocations; a CPU would load each node 27 times.
#extension GL_GOOGLE_include_directive : require
#ifdef ONE_NODE
#define NO_TEXELS // the texel unit of a GPU fetches 16 bytes several times slower than a load does
#endif
#ifndef ONE_NODE
#define GROUP_SIZE LATTICE_GROUP
#elif defined RESIDENT
#define GROUP_SIZE 512 // one group for a whole body, each invocation one node at a time; C++ reads this line
#endif
#include "solvers/split.glsl"
#include "solvers/lattice_window.glsl"
#include "solvers/cell_fill.glsl"
#include "solvers/held_links.glsl"
#include "solvers/lattice_links.glsl"
#ifdef VOLUME
#include "solvers/cell_volume.glsl"
#endif
#ifdef ONE_NODE
#include "solvers/lattice_node.glsl"
#else
#include "solvers/march_lattice.glsl"
#endif

#ifdef ONE_NODE
#define CHUNK_ITEMS LATTICE_GROUP
void moveItem(uint item, Substep substep) {
    const LatticeChunk run = chunks[item / CHUNK_ITEMS];
    const uint place = item % CHUNK_ITEMS;
    if (place < run.layers) moveNode(run.origin + place, substep);
}
#else
#define CHUNK_ITEMS 1u
void moveItem(uint item, Substep substep) {
    march(chunks[item], substep); // padding has no layers
}
#endif

#ifdef RESIDENT
// All substeps of one body in one work group. All bodies have the same number of chunks; those of small bodies are
// padded with empty ones.
void main() {
    const uint lane = isReversed ? GROUP_SIZE - 1u - gl_LocalInvocationID.x : gl_LocalInvocationID.x;
    const uint body = itemIndex(push.count) / GROUP_SIZE, items = push.bodyChunks * CHUNK_ITEMS;
    firstSlot = bodies[body];
    lastSlot = firstSlot + push.bodySlots - 1u;
    for (uint i = lane; i < push.bodySlots; i += GROUP_SIZE)
        resident[i] = resident[residentSlots + i] = positions[firstSlot + i]; // slots without a chunk keep their value in both buffers
    barrier();
    for (uint s = 0u; s < push.substeps; ++s) {
        const Substep substep = substepOf(s == 0u);
        isLook = s % CLAMP_INTERVAL == 0u;
        untilNext = min(uint(CLAMP_INTERVAL), push.substeps - s);
        for (uint item = lane; item < items; item += GROUP_SIZE) moveItem(body * items + item, substep);
        barrier();
        front = residentSlots - front;
        back = residentSlots - back;
    }
    for (uint i = lane; i < push.bodySlots; i += GROUP_SIZE) positions[firstSlot + i] = resident[front + i];
}
#else
void main() {
    const uint item = itemIndex(push.count);
#ifdef ONE_NODE
    if (item >= push.count) return;
#endif
    moveItem(item, substepOf(push.isFirst != 0u));
}
#endif
