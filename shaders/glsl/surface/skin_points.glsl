// Part of the kernels that write triangles of prisms: indices of a prism's points in the list of vertices.

uint placeOfSkin(uint item, uint bit) {
    const uvec4 own = owned[item];
    const uint copy = bit < 6u && (own.x >> 6u + (bit >> 1) & 1u) != 0u ? bit & ~1u : bit;
    return own.w + uint(bitCount(own.x & skinPoints & (1u << copy) - 1u));
}

// The point on edge n of a prism, on the side of its start or of its end.
uint skinPoint(SkinPrism prism, uint self, uint n, bool isStart) {
    const SkinEdge edge = edgeOf(prism, self, n);
    return placeOfSkin(push.first + edge.prism, sideBit(edge, isStart));
}

// The point at the centre of the triangle, on the side of a corner.
uint skinCenter(uint self, uint corner) { return placeOfSkin(push.first + self, firstCenter + corner); }
