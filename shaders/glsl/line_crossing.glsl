// One triangle, and then all of a cell, against one line of samples along push.axis: which of them lie above it, as if every
// sample were moved by (e1, e2, e3), e1 >> e2 >> e3 > 0. Exact. The kernel says how many `samples` a cell has, evenly spread;
// points are seen along the axis (voxel.glsl) and relative to where the line enters the cell.

// Whether the moved sample lies above a triangle that it lies in, along an axis along which the normal is `along`.
bool isAboveTie(ivec3 ab, ivec3 ac, bool isUpward) {
    const Int64 u = cross(ab.yz, ac.yz), v = cross(ab.zx, ac.zx);
    if (push.axis == 0u) return true;
    if (!isZero(u)) return isPositive(u) == isUpward;
    return push.axis == 1u || isZero(v) || isPositive(v) == isUpward;
}

// The edge from a to b, relative to the line, and their cross product: does a ray towards +u cross it?
bool isCrossed(ivec2 a, ivec2 b, Int64 area) {
    return (a.y > 0) != (b.y > 0) && (b.y > 0 ? isPositive(area) : area.high < 0);
}

// Adds the turn of one triangle to the samples that lie above it; `top` is the lower end of the next cell.
void meet(ivec3 a, ivec3 b, ivec3 c, inout int turns[samples], inout int top) {
    const Int64 bc = cross(b.xy, c.xy), ca = cross(c.xy, a.xy), ab = cross(a.xy, b.xy);
    if (!(isCrossed(a.xy, b.xy, ab) != (isCrossed(b.xy, c.xy, bc) != isCrossed(c.xy, a.xy, ca)))) return;
    const Int64 along = add(add(bc, ca), ab);
    const bool isUpward = along.high >= 0;
    // (height of the sample above the triangle) x along, first at the lower end of the cell
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

// The triangles of one cell against the line at `uv`: what is noted in `votes`, and the winding number behind the cell.
uint passCell(uint begin, uint end, ivec3 origin, inout int winding) {
    int turns[samples], top = winding;
    [[unroll]] for (uint s = 0u; s < samples; ++s) turns[s] = winding;
    for (uint t = begin; t < end; ++t) {
        const uvec4 corners = triangles[touching[t]];
        meet(seenAlong(push.axis, vertices[corners.x].xyz) - origin, seenAlong(push.axis, vertices[corners.y].xyz) - origin,
             seenAlong(push.axis, vertices[corners.z].xyz) - origin, turns, top);
    }
    winding = top;
    uint bits = 0u; // first whether the surface winds around the sample at all, then whether oddly
    [[unroll]] for (uint s = 0u; s < samples; ++s)
        bits |= uint(turns[s] != 0) << s | uint(turns[s] & 1) << (samples + s);
    return bits << (2u * samples * push.axis);
}
