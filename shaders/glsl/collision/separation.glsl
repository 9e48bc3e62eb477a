// Keeps two convex parts of a sheet on their sides of a plane halfway between their nearest points at the start of a
// substep. A pair has not passed if such a plane separates it at the end, whatever the velocity of the plane. First that
// plane is tried which goes along with the pair. If a corner ends too near to it, the ways of the corners are limited by
// the plane that goes along with the sheet: it is common to all pairs of the sheet, so limits contradict each other
// nowhere. keep_apart.comp ends the ways there. Requires the names and buffers of a kernel with predicted positions.
#include "collision/body_speeds.glsl"

struct Corner {
    uint index;
    vec3 start, way; // at the start of the substep; displacement in the substep [m]
};

Corner cornerOf(uint i) {
    const vec4 velocity = VELOCITY(i);
    const vec3 moved = step.h * PREDICTED_VELOCITY(i).xyz, start = PREDICTED(i).xyz - moved;
    return Corner(i, start, velocity.w == 0.0 ? moved : POSITION(i).xyz - step.thetaH * velocity.xyz - start);
}

// Parts may come as near as a tenth of their reach, or half of what they were. Nearer than a fiftieth they stay as they
// are: else their distance would halve until rounding decides the side.
float leastHeight(float apart, float reach) { return apart < 0.02 * reach ? 0.49999 * apart : min(0.05 * reach, 0.25 * apart); }

struct Plane {
    vec3 n;
    float offset, least, apart; // n . x at the start; height that corners keep; distance of both parts [m]
};

// p: a point of the first part in the direction of the other; d: shortest way from the second to the first.
Plane planeBetween(vec3 p, vec3 d, float reach) {
    const float apart = length(d);
    const vec3 n = d / max(apart, 1e-30);
    return Plane(n, dot(n, p) - 0.5 * apart, leastHeight(apart, reach), apart);
}

// Whether a pair is not looked at: its parts intersect, or are apart and do not touch in this substep. Such a pair may be in
// no list with another margin.
bool isLeftOut(Plane plane, float reach, bool touches) { return !(plane.apart > 1e-9) || !touches && plane.apart >= reach; }

// Height of a corner above the plane that moves by `along`, after `part` of its way. side: 1 above the plane, -1 below it.
float heightAfter(Corner corner, Plane plane, float side, vec3 along, float part) {
    return side * (dot(plane.n, corner.start + part * (corner.way - along)) - plane.offset);
}

// Limits the way of a corner, measured against that of its sheet.
void limit(Corner corner, Plane plane, float side, vec3 along) {
    const float from = heightAfter(corner, plane, side, along, 0.0), to = heightAfter(corner, plane, side, along, 1.0);
    if (to < plane.least && to < from) atomicMin(parts[corner.index], floatBitsToUint(clamp((from - plane.least) / (from - to), 0.0, 1.0)));
}
