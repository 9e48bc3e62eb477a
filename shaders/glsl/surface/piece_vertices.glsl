// Part of write_pieces: the vertices of the pieces of a skin triangle. Requires the names of that kernel.

// Points: 0 to 2 are corners; 3 + n is the point on edge n on the side of its start, 6 + n that on the side of its
// end, 9 + n the centre.
CutVertex vertexAt(uint point) {
    const uint n = point % 3u;
    const HungVertex from = hung[prism.vertices[n]], to = hung[prism.vertices[(n + 1u) % 3u]];
    if (point < 3u) {
        const uint i = from.anchor;
        const ivec3 normal = ivec3(from.normal.xyz * SURFACE_NORMAL);
        return CutVertex(restOf(prism.vertices[n]), vec4(0.0), uint[4](i, i, i, i), int[3](normal.x, normal.y, normal.z), SURFACE_SKIN | from.vertex);
    }
    CutVertex vertex = vertices[point < firstCenter ? skinPoint(prism, self, n, point < 6u) : skinCenter(self, n)];
    const vec3 start = restOf(prism.vertices[n]).xyz, way = restOf(prism.vertices[(n + 1u) % 3u]).xyz - start;
    const float share = clamp(dot(vertex.rest.xyz - start, way) / max(dot(way, way), 1e-30), 0.0, 1.0);
    const vec3 third = hung[prism.vertices[(n + 2u) % 3u]].normal.xyz;
    const vec3 mean = point < firstCenter ? mix(from.normal.xyz, to.normal.xyz, share) : from.normal.xyz + to.normal.xyz + third;
    const ivec3 normal = ivec3(mean * SURFACE_NORMAL);
    vertex.normal = int[3](normal.x, normal.y, normal.z);
    return vertex;
}
