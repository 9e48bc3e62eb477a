// Where a vertex of a skin is at rest: beside a cut it has moved to the blade (move_rims). Whoever includes this has hung[] and moved[].
vec4 restOf(uint vertex) {
    return vec4(moved[vertex].w == VERTEX_MOVED ? moved[vertex].xyz : hung[vertex].rest.xyz, hung[vertex].rest.w);
}
