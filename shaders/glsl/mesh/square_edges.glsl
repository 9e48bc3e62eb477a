// Part of mark_hull: integer tests of a triangle against a square, seen along one axis.

// True if some point of a square lies on the inner side of an edge, seen along one axis.
bool isBesideEdge(ivec2 from, ivec2 to, int side, ivec2 corner, int size) {
    const ivec2 normal = ivec2(from.y - to.y, to.x - from.x) * side;
    const ivec2 inmost = corner + size * ivec2(greaterThan(normal, ivec2(0))) - from;
    return add(multiply(normal.x, inmost.x), multiply(normal.y, inmost.y)).high >= 0;
}

bool isBesideEdges(ivec2 a, ivec2 b, ivec2 c, Int64 normal, ivec2 corner, int size) {
    const int side = normal.high < 0 ? -1 : 1;
    return isBesideEdge(a, b, side, corner, size) && isBesideEdge(b, c, side, corner, size) &&
           isBesideEdge(c, a, side, corner, size);
}
