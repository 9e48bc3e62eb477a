// Part of write_points: points at the centres of faces and tetrahedra. Each is the mean of the points on the edges,
// and is bound to all corners of its part. Requires the names of that kernel.

// The low face of a tetrahedron that its cell may lack has the same corners.
void writeFace(uint i, uint q) {
    const Side side = firstSide(i, q);
    const uvec4 all = cornersOf(side.p);
    const uvec3 face = faceOf(side.m), corners = uvec3(all[face.x], all[face.y], all[face.z]);
    const vec3 place = (edgePlace(i, corners.x, corners.y) + edgePlace(i, corners.x, corners.z)
                        + edgePlace(i, corners.y, corners.z)) / 3.0;
    [[dont_unroll]] for (uint own = 0u; own < 3u; ++own) {
        if (!hasBit(owned[i], faceBit(q, own))) continue;
        uint slots[4] = uint[4](i, i, i, i), count = 0u;
        [[dont_unroll]] for (uint n = 0u; n < 3u; ++n)
            if (copyOf(owned[i], faceBit(q, n)) == faceBit(q, own)) slots[count++] = slotOf(i, corners[n]);
        const float share = 1.0 / float(count);
        write(i, faceBit(q, own), place, slots, vec4(share, count > 1u ? share : 0.0, count > 2u ? share : 0.0, 0.0));
    }
}

void writeMiddle(uint i, uint p) {
    const uvec4 corners = cornersOf(p), labels = labelsOf(partitionOf(partitions[i], p));
    if (!hasBit(owned[i], middleBit(p, 0u))) return;
    vec4 sum = vec4(0.0);
    [[dont_unroll]] for (uint a = 0u; a < 3u; ++a)
        [[dont_unroll]] for (uint b = a + 1u; b < 4u; ++b)
            if (labels[a] != labels[b]) sum += vec4(edgePlace(i, corners[a], corners[b]), 1.0);
    [[dont_unroll]] for (uint own = 0u; own < 4u; ++own) {
        if (labels[own] != own) continue;
        const vec4 isOf = vec4(equal(labels, uvec4(own)));
        const uint slots[4] = uint[4](slotOf(i, corners.x), slotOf(i, corners.y), slotOf(i, corners.z), slotOf(i, corners.w));
        write(i, middleBit(p, own), sum.xyz / sum.w, slots, isOf / dot(isOf, vec4(1.0)));
    }
}
