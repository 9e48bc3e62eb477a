// A point and a face in a substep in which all four particles go straight: whether the point has gone past the face
// beside it, and where the two touched first. Requires the names of common/triangle.glsl.

// Positions at the end of a substep, relative to corner a, and displacements in the substep.
struct Passage {
    vec3 ap, ab, ac, wp, wb, wc; // [m]
};

// The place of the face nearest to the point; `back`: part of the substep that is left then.
Nearest nearestAt(Passage p, float back) {
    return nearestOf(p.ap - back * p.wp, triangleOf(p.ab - back * p.wb, p.ac - back * p.wc));
}

// The square of the longest way of the point relative to a place of the face [m^2].
float wayOf2(Passage p) {
    const vec3 one = p.wp - p.wb, other = p.wp - p.wc;
    return max(dot(p.wp, p.wp), max(dot(one, one), dot(other, other)));
}

const float slow = 0.25; // a part of the reach: no point that moves less has gone past a face

// True if a point has gone past the face within reach: the nearest place is behind it then, and a contact on the line
// from there would push the point on. A ball that is wider than a sheet, or than the frame that holds it, meets most
// faces so. These contacts act on the line of the first touch.
bool isPast(Passage p, float reach, Nearest end) {
    if (dot(end.d, end.d) >= reach * reach || wayOf2(p) <= slow * slow * reach * reach) return false;
    const vec3 start = nearestAt(p, 1.0).d;
    return dot(start, start) > 1e-30 && dot(start, end.d) < 0.0; // a start on the face has no side
}

// The nearest place at the time at which the two come within reach; the start of the substep if they are. A turn of the
// search never leads beyond that time.
Nearest firstTouch(Passage p, float reach, out float back) {
    const float way = sqrt(wayOf2(p));
    back = 1.0;
    Nearest nearest = nearestAt(p, back);
    for (uint turn = 0u; turn < 8u; ++turn) {
        const float gap = length(nearest.d) - reach;
        if (gap <= 1e-3 * reach) break;
        back = max(0.0, back - gap / way);
        nearest = nearestAt(p, back);
    }
    return nearest;
}
