// Part of write_pieces and write_piece_textures: the triangles of the pieces of a skin triangle. Corners are numbered as
// in piece_vertices.glsl. Requires prism, self and the names of skin_prisms.glsl.

// Corners of triangles to write, 4 bits each. There is one place that writes them, because a software device inlines
// every call.
uint noted[6], count = 0u;
void triangle(uint a, uint b, uint c) { noted[count++] = a | b << 4 | c << 8; }

void addPieces() {
    const uvec3 pattern = patternOf(prism);
    if (pattern.y + pattern.z == 0u) { // whole, but its neighbour is not: the point on their edge is inserted
        [[dont_unroll]] for (uint n = 0u; n < 3u; ++n) {
            const SkinEdge edge = edgeOf(prism, self, n);
            if ((owned[push.first + edge.prism].x >> 2u * edge.edge & 1u) == 0u) continue;
            triangle(n, 3u + n, (n + 2u) % 3u);
            triangle(3u + n, (n + 1u) % 3u, (n + 2u) % 3u);
        }
    } else if (pattern.y == 1u && pattern.z == 2u) {
        [[dont_unroll]] for (uint n = 0u; n < 3u; ++n) {
            triangle(n, 3u + n, firstCenter + n);
            triangle(n, firstCenter + n, 6u + (n + 2u) % 3u);
        }
    } else {
        const uint a = pattern.y == 0u ? 2u : pattern.z == 0u ? 1u : 0u, b = (a + 1u) % 3u, c = (a + 2u) % 3u;
        triangle(a, 3u + a, 6u + c);
        triangle(6u + a, b, c);
        triangle(6u + a, c, 3u + c);
    }
}
