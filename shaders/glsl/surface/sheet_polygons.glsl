// Part of write_sheet and write_sheet_textures: the pieces of the current triangle, each of which lies at a corner. The
// including kernel defines
//
//   addOn(corner, way)    a vertex in the piece of a corner, at an offset from it [cells]; returns its number
//   addBetween(n)         the point on edge n, between both ends
//   addTriangle(a, b, c)  of vertices
SheetTriangle triangle;
Cuts cuts;
SheetCounts next;

uint addOn(int corner, vec2 way);
uint addBetween(int n);
void addTriangle(uint a, uint b, uint c);

float hitOf(Edge edge) { return hitAt(edge.owner, bitOf(edge.way.x, 0, edge.way.y)); }

bool isJoinedBeyond(int n) {
    const ivec2 p = cornerAt(triangle.kind, n), q = cornerAt(triangle.kind, (n + 1) % 3);
    const ivec2 beyond = p + q - cornerAt(triangle.kind, (n + 2) % 3);
    if (int(slotAt(triangle.slot, beyond)) < int(push.firstSlot)) return false; // before the first row there may be another sheet
    return edgeBetween(triangle.slot, p, beyond).isAlive && edgeBetween(triangle.slot, beyond, q).isAlive;
}

uint addCorner(int corner) { return addOn(corner, vec2(0.0)); }

// The copy of an edge's point on the side of a corner, which is an end of the edge.
uint addPoint(int n, int corner) {
    if (isJoinedBeyond(n)) return addBetween(n);
    const Edge edge = cuts.edges[n];
    const bool isOwner = cornerAt(triangle.kind, corner) == edge.from;
    return addOn(corner, (isOwner ? hitOf(edge) : hitOf(edge) - 1.0) * vec2(edge.way));
}

void addQuad(uint a, uint b, uint c, uint d) {
    addTriangle(a, b, c);
    addTriangle(a, c, d);
}

void splitInThree() {
    vec2 middle = vec2(0.0);
    for (int n = 0; n < 3; ++n) middle += (vec2(cuts.edges[n].from) + hitOf(cuts.edges[n]) * vec2(cuts.edges[n].way)) / 3.0;
    for (int n = 0; n < 3; ++n) {
        const uint corner = addCorner(n), ahead = addPoint(n, n);
        const uint inside = addOn(n, middle - vec2(cornerAt(triangle.kind, n)));
        addQuad(corner, ahead, inside, addPoint((n + 2) % 3, n));
    }
}

// Splits off the corner between two dead edges.
void splitInTwo() {
    int off = 0;
    for (int n = 0; n < 3; ++n)
        if (cuts.edges[n].isAlive) off = (n + 2) % 3;
    const int ahead = (off + 1) % 3, behind = (off + 2) % 3;
    const uint corner = addCorner(off), first = addPoint(off, off);
    addTriangle(corner, first, addPoint(behind, off));
    const uint start = addPoint(off, ahead), low = addCorner(ahead), high = addCorner(behind);
    addQuad(start, low, high, addPoint(behind, behind));
}

void splitAtPoint() {
    int n = 0;
    while (cuts.edges[n].isAlive) ++n;
    const uint from = addCorner(n), point = addBetween(n), to = addCorner((n + 1) % 3);
    addQuad(point, to, addCorner((n + 2) % 3), from);
}

void addPieces() {
    if (cuts.dead == 3u) splitInThree();
    else if (cuts.dead == 2u) splitInTwo();
    else splitAtPoint();
}
