// Part of the kernels for pieces of a sheet's skin: the cut edges of a triangle, and the positions of the cuts.
// Corners are nodes (x, z) relative to the cell; the owner of an edge is its lower end, along x, z or both. Across an
// edge lies the other half of a cell, whose third corner is this one's mirrored at the edge's midpoint.
#include "lattice/link_masks.glsl"

ivec2 cornerAt(uint kind, int n) {
    return n == 0 ? ivec2(0) : (kind & 1u) == 0u ? ivec2(n - 1, 1) : ivec2(1, 2 - n);
}

struct Edge {
    uint owner, other;   // slots
    ivec2 from, way;     // node of the owner; offset to the other end
    bool isAlive;
};

uint slotAt(uint slot, ivec2 node) { return uint(int(slot) + node.x + node.y * int(push.sliceStride)); }

Edge edgeBetween(uint slot, ivec2 p, ivec2 q) {
    const bool isUp = q.x - p.x + q.y - p.y > 0;
    const ivec2 from = isUp ? p : q, way = abs(q - p);
    Edge edge = Edge(slotAt(slot, from), slotAt(slot, from + way), from, way, false);
    if (int(edge.owner) >= 0) edge.isAlive = (links[edge.owner] >> bitOf(way.x, 0, way.y) & 1u) != 0u; // else the node does not exist
    return edge;
}

// The edges of a triangle: it is split in two if two edges are dead, in three if all are.
struct Cuts {
    Edge edges[3]; // from corner n to the next
    uint dead;
};

Cuts cutsOf(SheetTriangle triangle) {
    Cuts cuts;
    cuts.dead = 0u;
    for (int n = 0; n < 3; ++n) {
        cuts.edges[n] = edgeBetween(triangle.slot, cornerAt(triangle.kind, n), cornerAt(triangle.kind, (n + 1) % 3));
        cuts.dead += cuts.edges[n].isAlive ? 0u : 1u;
    }
    return cuts;
}
