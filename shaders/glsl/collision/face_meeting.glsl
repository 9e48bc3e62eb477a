// Geometry of a point and a face at the start and at the end of a substep. Requires the names and buffers of
// find_face_contacts.
#include "collision/face_sweep.glsl"

// True if a point that has crossed the plane of a face went through the face: tests the position on straight paths at
// the time of the crossing. A rotating face was not exactly there; a point that was never within reach may be in no
// list.
bool hasPassed(vec3 ap, vec3 ab, vec3 ac, float reach, out vec3 b) {
    b = weightsOf(ap, triangleOf(ab, ac));
    const bool isInside = min(b.x, min(b.y, b.z)) >= -1e-3; // at an edge of two faces at least one detects it
    b = max(b, vec3(0.0));
    b /= b.x + b.y + b.z;
    const vec3 d = ap - b.y * ab - b.z * ac;
    return isInside && dot(d, d) < reach * reach;
}

// A point and a face at the end of a substep, and the point's height above the plane then and at the start.
struct Meeting {
    ContactFace face;
    float reach;               // [m]
    float front;               // closed bodies: 1 = the front is along the normal, -1 = opposite
    vec3 ap, ab, ac, vp, vb, vc; // displacements from corner a, velocities relative to it
    Triangle triangle;
    Nearest nearest;
    vec3 normal;               // unit
    float height, heightBefore; // [m]
    bool isKept, isOpened;     // the pair keeps its rest distance; a cut has made the contact possible: set by the caller
    bool isBeyond;             // the point is fast and has gone past the face: set by the caller
};

Meeting meetingOf(uint i, uvec2 candidate) {
    Meeting m;
    m.face = faceAt(candidate.x);
    m.reach = abs(uintBitsToFloat(candidate.y));
    m.front = candidate.y >> 31 != 0u ? -1.0 : 1.0; // the sign bit is that of the thickness
    const float h = step.h;
    const vec3 a = PREDICTED(m.face.a).xyz, va = PREDICTED_VELOCITY(m.face.a).xyz;
    m.ap = PREDICTED(i).xyz - a, m.ab = PREDICTED(m.face.b).xyz - a, m.ac = PREDICTED(m.face.c).xyz - a;
    m.vp = PREDICTED_VELOCITY(i).xyz - va, m.vb = PREDICTED_VELOCITY(m.face.b).xyz - va, m.vc = PREDICTED_VELOCITY(m.face.c).xyz - va;
    m.triangle = triangleOf(m.ab, m.ac);
    m.nearest = nearestOf(m.ap, m.triangle);
    m.normal = normalize(m.triangle.normal);
    m.height = dot(m.normal, m.ap);
    const Triangle before = triangleOf(m.ab - h * m.vb, m.ac - h * m.vc);
    m.heightBefore = dot(before.normal, m.ap - h * m.vp) / max(length(before.normal), 1e-30);
    m.isKept = m.isOpened = m.isBeyond = false;
    return m;
}

bool wentThrough(Meeting m, out vec3 b) {
    const float back = step.h * m.height / (m.height - m.heightBefore); // time since it was in the plane [s]
    return hasPassed(m.ap - back * m.vp, m.ab - back * m.vb, m.ac - back * m.vc, m.reach, b);
}

Passage passageOf(Meeting m) { return Passage(m.ap, m.ab, m.ac, step.h * m.vp, step.h * m.vb, step.h * m.vc); }

Nearest nearestBefore(Meeting m) { return nearestAt(passageOf(m), 1.0); }

// The overlap at the start of the substep, measured as at its end.
float overlapBefore(Meeting m, float side, bool isThrough) {
    const Nearest before = nearestBefore(m);
    return m.reach - (isThrough || before.isInside ? side * m.heightBefore : length(before.d));
}

// The overlap of a point that has gone past the face, on the line n of their first touch, at the place b.
float overlapPast(Meeting m, out vec3 n, out vec3 b) {
    float back;
    const Nearest first = firstTouch(passageOf(m), m.reach, back);
    n = normalize(first.d);
    b = first.weights;
    return m.reach - dot(n, m.ap - b.y * m.ab - b.z * m.ac);
}

bool isWithinReach(Meeting m) { return dot(m.nearest.d, m.nearest.d) < m.reach * m.reach; }

// The angle that the face spans at its point nearest to the point.
float angleOf(Meeting m) {
    const vec3 w = m.nearest.weights, bc = m.ac - m.ab;
    vec3 one = m.ab, other = -m.ab; // on an edge
    if (w.x > 0.999) other = m.ac;
    else if (w.y > 0.999) one = bc;
    else if (w.z > 0.999) {
        one = -bc;
        other = -m.ac;
    }
    return acos(clamp(dot(normalize(one), normalize(other)), -1.0, 1.0));
}
