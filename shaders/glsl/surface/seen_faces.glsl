// The split of a face as seen by each tetrahedron or prism at it. Requires complex[], partitions[], links[].

// The split seen by a tetrahedron.
uvec3 seenFrom(Side side) { return restricted(labelsOf(partitionOf(partitions[side.cell], side.p)), faceOf(side.m)); }

bool areLinked(uint cell, uint low, uint high) {
    const ivec3 d = cornerOf(int(low ^ high));
    return isAlive(links[slotOf(cell, low)], d.x, d.y, d.z);
}

// The split seen by prisms that stand on the face, by its own links.
uvec3 seenAlone(Side side) {
    const uvec4 all = cornersOf(side.p);
    const uvec3 face = faceOf(side.m), corners = uvec3(all[face.x], all[face.y], all[face.z]);
    const bool ab = areLinked(side.cell, corners.x, corners.y), bc = areLinked(side.cell, corners.y, corners.z),
               ca = areLinked(side.cell, corners.x, corners.z);
    return patternOf(ab, bc, ca);
}
