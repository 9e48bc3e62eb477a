// Where a vertex of a skin is at rest: beside a cut it may have moved to the blade (move_rims). Whoever includes this has hung[], rims[]
// and moved[].
vec4 restOf(uint vertex) {
    const bool isMoved = rims[vertex] != 0u && moved[vertex].w > 0.0;
    return vec4(isMoved ? moved[vertex].xyz : hung[vertex].rest.xyz, hung[vertex].rest.w);
}
