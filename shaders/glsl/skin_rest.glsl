// Where a vertex of a skin is at rest: beside a cut it has moved to the blade. Whoever includes this has hung_vertex.glsl and moved_vertex.glsl.
vec4 restOf(uint vertex) {
    const vec4 to = MOVED(vertex), before = hungAt(vertex).rest;
    return vec4(to.w == VERTEX_MOVED ? to.xyz : before.xyz, before.w);
}
