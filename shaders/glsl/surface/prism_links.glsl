// The links below the edges of a prism (skin_prisms.glsl).

uint linkOf(SkinPrism prism, uint n) { return bitfieldExtract(prism.links, int(4u * n), 4); }

// The lower end of the link below an edge.
uint lowEnd(SkinPrism prism, uint n) { return prism.anchors[linkOf(prism, n) < 8u ? n : (n + 1u) % 3u]; }

bool areLinked(uint word, uint link) {
    const ivec3 d = cornerOf(int(link & 7u));
    return isAlive(word, d.x, d.y, d.z);
}
