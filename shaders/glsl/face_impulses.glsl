// What gather_faces sums up for a particle: as a point and as a corner of faces, or as an end of edges. In the names and
// buffers of that kernel.
#ifdef EDGES
vec3 impulseOn(uint i) {
    vec3 sum = vec3(0.0);
    for (uint k = corners[i]; k < corners[i + 1u]; ++k) sum += impulses[corners[k]].xyz;
    return sum;
}
#else
vec3 impulseOn(uint i) {
    const uvec2 list = lists[i];
    vec3 sum = vec3(0.0);
    for (uint element = list.x; element < list.x + list.y; ++element)
        if (directions[element].w > 0.0) sum += impulses[element].xyz;
    for (uint k = corners[i]; k < cornerEnds[i]; ++k) {
        const uint corner = corners[k] % 4u;
        const uvec2 points = linkLists[corners[k] / 4u];
        for (uint link = points.x; link < points.x + points.y; ++link) {
            const uint element = links[link];
            if (directions[element].w > 0.0) sum -= weights[element][corner] * impulses[element].xyz;
        }
    }
    return sum;
}
#endif
