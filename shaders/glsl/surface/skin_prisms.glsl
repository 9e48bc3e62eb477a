// Skins of meshes and their prisms (src/sim/surface/skin_complex). An edge of a skin is cut if the link between the
// anchors of its ends is; a prism is cut like the face between its three anchors. The points of a prism are owned by
// the surface item of the prism, after all slots:
//
//   0 .. 5    edges that no prism before it has: 2 n + side, 0 = on the side of corner n; only side 0 where both are one (6 + n)
//   9 .. 11   the centre of the triangle, for each corner, where all three are apart
//
// Requires prisms[], links[] and owned[].

const uint skinPoints = 0xe3fu, firstCenter = 9u;

#include "surface/prism_links.glsl"

// True if the ends of edge n share an anchor, or have anchors with a live link.
bool isHeld(SkinPrism prism, uint n) {
    const uint link = linkOf(prism, n);
    return link == 0u || areLinked(links[lowEnd(prism, n)], link);
}

// Connectivity of the corners.
uvec3 patternOf(SkinPrism prism) { return patternOf(isHeld(prism, 0u), isHeld(prism, 1u), isHeld(prism, 2u)); }

bool areApart(uvec3 pattern, uint n) { return pattern[n] != pattern[(n + 1u) % 3u]; }

// The owner of an edge, and the number of the edge there; reversed if the owner is the other prism.
struct SkinEdge {
    uint prism, edge;
    bool isReversed;
};
SkinEdge edgeOf(SkinPrism prism, uint self, uint n) {
    const uint other = prism.beyond[n] >> 2;
    return self < other ? SkinEdge(self, n, false) : SkinEdge(other, prism.beyond[n] & 3u, true);
}

// The bit of the point on an edge, on the side of its start or of its end.
uint sideBit(SkinEdge edge, bool isStart) { return 2u * edge.edge + (isStart == edge.isReversed ? 1u : 0u); }
