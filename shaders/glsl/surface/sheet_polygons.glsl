// Part of write_sheet: the current triangle, and functions that write one of its pieces, each of which lies at a
// corner.
SheetTriangle triangle;
Cuts cuts;
SheetCounts next;

float turn() { return (triangle.kind & 2u) == 0u ? 1.0 : -1.0; }

float hitOf(Edge edge) { return hitAt(edge.owner, bitOf(edge.way.x, 0, edge.way.y)); }

bool isJoinedBeyond(int n) {
    const ivec2 p = cornerAt(triangle.kind, n), q = cornerAt(triangle.kind, (n + 1) % 3);
    const ivec2 beyond = p + q - cornerAt(triangle.kind, (n + 2) % 3);
    if (int(slotAt(triangle.slot, beyond)) < int(push.firstSlot)) return false; // before the first row there may be another sheet
    return edgeBetween(triangle.slot, p, beyond).isAlive && edgeBetween(triangle.slot, beyond, q).isAlive;
}

uint add(SheetVertex vertex) {
    vertices[next.vertices] = vertex;
    return push.firstVertex + next.vertices++;
}

uint addOn(int corner, vec2 way) {
    const uint slot = slotAt(triangle.slot, cornerAt(triangle.kind, corner));
    return add(SheetVertex(slot, slot, 0.0, way.x, way.y, turn()));
}

uint addCorner(int corner) { return addOn(corner, vec2(0.0)); }

uint addBetween(int n) {
    const Edge edge = cuts.edges[n];
    return add(SheetVertex(edge.owner, edge.other, hitOf(edge), 0.0, 0.0, turn()));
}

// The copy of an edge's point on the side of a corner, which is an end of the edge.
uint addPoint(int n, int corner) {
    if (isJoinedBeyond(n)) return addBetween(n);
    const Edge edge = cuts.edges[n];
    const bool isOwner = cornerAt(triangle.kind, corner) == edge.from;
    return addOn(corner, (isOwner ? hitOf(edge) : hitOf(edge) - 1.0) * vec2(edge.way));
}

void addTriangle(uint a, uint b, uint c) {
    const uint first = push.firstPiece + 3u * next.triangles++;
    const bool isTurned = (triangle.kind & 2u) != 0u;
    indices[first] = a;
    indices[first + 1u] = isTurned ? c : b;
    indices[first + 2u] = isTurned ? b : c;
}

void addQuad(uint a, uint b, uint c, uint d) {
    addTriangle(a, b, c);
    addTriangle(a, c, d);
}
