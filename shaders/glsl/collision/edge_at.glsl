// An edge, whole in one read. Requires the names edges and edgeTexels of a kernel.
ContactEdge edgeAt(uint e) {
    if (!usesTexels) return edges[e];
    const uvec4 words = texelFetch(edgeTexels, int(e));
    return ContactEdge(words.x, words.y, words.z, uintBitsToFloat(words.w));
}
