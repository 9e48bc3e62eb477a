// Rest position of a skin vertex: beside a cut it may have moved to the blade. Requires hung_vertex.glsl and
// moved_vertex.glsl.
vec4 restOf(uint vertex) {
    const vec4 to = MOVED(vertex), before = hungAt(vertex).rest;
    return vec4(to.w >= VERTEX_MOVED ? to.xyz : before.xyz, before.w);
}
