// Part of write_prisms: the triangles between the points of a prism. Requires the names of that kernel.

// Corner a is separated from the two others.
void partTwo(SkinPrism prism, uint self, uint a) {
    const uint b = (a + 1u) % 3u, c = (a + 2u) % 3u; // edges a: a to b, b: b to c, c: c to a
    const bool isThin = linkOf(prism, b) == 0u;
    [[dont_unroll]] for (uint side = 0u; side < 2u; ++side) {
        const bool isOwn = side == 0u;
        const uint skinB = skinPoint(prism, self, a, isOwn), skinC = skinPoint(prism, self, c, !isOwn);
        const uint linkB = linkPoint(prism, a, isOwn), linkC = linkPoint(prism, c, !isOwn);
        triangle(isOwn ? skinC : skinB, isOwn ? skinB : skinC, linkB);
        if (!isThin) triangle(skinC, isOwn ? linkB : linkC, isOwn ? linkC : linkB);
    }
}

void partThree(SkinPrism prism, uint self) {
    [[dont_unroll]] for (uint a = 0u; a < 3u; ++a)
        [[dont_unroll]] for (uint side = 0u; side < 2u; ++side) {
            const bool isOwn = side == 0u;
            const uint corner = isOwn ? a : (a + 1u) % 3u;
            const uint skin = skinPoint(prism, self, a, isOwn), link = linkPoint(prism, a, isOwn);
            const uint center = skinCenter(self, corner), face = facePoint(prism, corner);
            triangle(center, isOwn ? skin : link, isOwn ? link : skin);
            triangle(center, isOwn ? link : face, isOwn ? face : link);
        }
}
