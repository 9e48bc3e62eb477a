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
    const uint n = counts[i];
    vec3 sum = vec3(0.0);
    for (uint s = 0u; s < n; ++s)
        if (directions[s * push.row + i].w > 0.0) sum += impulses[s * push.row + i].xyz;
    for (uint k = corners[i]; k < corners[i + 1u]; ++k) {
        const uint face = corners[k] / 4u, corner = corners[k] % 4u, points = linkCounts[face];
        for (uint s = 0u; s < points; ++s) {
            const uint element = links[s * push.faceRow + face];
            if (directions[element].w > 0.0) sum -= weights[element][corner] * impulses[element].xyz;
        }
    }
    return sum;
}
#endif
