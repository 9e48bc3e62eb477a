// Where a vertex of a skin is at rest: beside a cut it has moved to the blade (move_rims). Whoever includes this has hung[] and moved[], or says
// what is in them.
#ifndef MOVED
#define MOVED(v) moved[v]
#define HUNG_REST(v) hung[v].rest
#endif
vec4 restOf(uint vertex) {
    const vec4 to = MOVED(vertex), before = HUNG_REST(vertex);
    return vec4(to.w == VERTEX_MOVED ? to.xyz : before.xyz, before.w);
}
