// Intersects the triangles of a cell with one line of samples along push.axis, as if every sample were moved by (e1,
// e2, e3), e1 >> e2 >> e3 > 0. Exact. The kernel defines `samples`, the number of evenly spread samples per cell;
// points are in axis order (voxel.glsl) and relative to the point at which the line enters the cell.

// True if a moved sample in the plane of a triangle lies above it, along an axis that the normal points along if
// isUpward.
bool isAboveTie(ivec3 ab, ivec3 ac, bool isUpward) {
    const Int64 u = cross(ab.yz, ac.yz), v = cross(ab.zx, ac.zx);
    if (push.axis == 0u) return true;
    if (!isZero(u)) return isPositive(u) == isUpward;
    return push.axis == 1u || isZero(v) || isPositive(v) == isUpward;
}

// True if a ray towards +u from the line crosses the edge from a to b, whose points are relative to the line and have
// the cross product `area`.
bool isCrossed(ivec2 a, ivec2 b, Int64 area) {
    return (a.y > 0) != (b.y > 0) && (b.y > 0 ? isPositive(area) : area.high < 0);
}

// Adds the orientation of one triangle to the samples above it; `top` is the winding number at the lower end of the
// next cell.
void meet(ivec3 a, ivec3 b, ivec3 c, inout int turns[samples], inout int top) {
    const Int64 bc = cross(b.xy, c.xy), ca = cross(c.xy, a.xy), ab = cross(a.xy, b.xy);
    if (!(isCrossed(a.xy, b.xy, ab) != (isCrossed(b.xy, c.xy, bc) != isCrossed(c.xy, a.xy, ca)))) return;
    const Int64 along = add(add(bc, ca), ab);
    const bool isUpward = along.high >= 0;
    // (height of the sample above the triangle) x (normal along the axis), first at the lower end of the cell
    Int96 above = add(add(multiply(bc, -a.z), multiply(ca, -b.z)), multiply(ab, -c.z));
    Int96 rise = multiply(along, cellSize() >> (samples == 1u ? 1 : 3));
    if (!isUpward) {
        above = negative(above);
        rise = negative(rise);
    }
    if (!isAboveTie(b - a, c - a, isUpward)) above = add(above, Int96(0xffffffffu, 0xffffffffu, -1));
    if (above.high >= 0) return;
    const int turn = isUpward ? 1 : -1;
    for (uint i = 0u; i < samples; ++i) {
        above = add(above, rise);
        turns[i] += above.high >= 0 ? turn : 0;
        above = add(above, rise);
    }
    top += above.high >= 0 ? turn : 0;
}

// Intersects the triangles of one cell with the line: returns the bits for `votes`, and adds the crossings to the
// winding number.
uint passCell(uint begin, uint end, ivec3 origin, inout int winding) {
    int turns[samples], top = winding;
    [[unroll]] for (uint s = 0u; s < samples; ++s) turns[s] = winding;
    for (uint t = begin; t < end; ++t) {
        const uvec4 corners = triangles[touching[t]];
        meet(seenAlong(push.axis, vertices[corners.x].xyz) - origin, seenAlong(push.axis, vertices[corners.y].xyz) - origin,
             seenAlong(push.axis, vertices[corners.z].xyz) - origin, turns, top);
    }
    winding = top;
    uint bits = 0u; // first bits for a winding number other than 0, then bits for an odd one
    [[unroll]] for (uint s = 0u; s < samples; ++s)
        bits |= uint(turns[s] != 0) << s | uint(turns[s] & 1) << (samples + s);
    return bits << (2u * samples * push.axis);
}
