// Narrow phase of a point and a face in a substep: their contact, and the side of the point. Requires the names and
// buffers of find_face_contacts.
#include "collision/face_meeting.glsl"
#include "collision/face_meeting_marks.glsl"

struct Touch {
    vec3 n;
    float depth;    // > 0 if they touch [m]
    vec3 b;
    float remembered; // the side, 1 = along the normal, and the overlap
    bool isThrough; // the point is beyond the plane, and went through the face
    ContactFace face;
};

Meeting keptMeetingOf(uint i, uvec2 candidate) {
    Meeting m = meetingOf(i, candidate);
    const bool canOpen = firstInner != ~0u;
    m.isOpened = canOpen && (areParted(i, m.face.a) || candidate.x >= firstInner && candidate.x < push.moving);
    m.isKept = keepsUncut(i, m.face.a);
    return m;
}

// The largest overlap that the point keeps with a face of `body` that it is in front of, as the overlap of a pair
// with this reach [m]. A pair with a rest distance below 0 gives more than the reach.
float mostKept(uint i, uvec2 list, uint body, float reach) {
    float most = 0.0;
    for (uint element = list.x; element < list.x + list.y; ++element) {
        const uvec2 candidate = CONTACT(element);
        const float remembered = MEMORY(element).w, signedReach = uintBitsToFloat(candidate.y);
        if (abs(remembered) <= 1.0 || remembered * signedReach < 0.0 || !isSolid(candidate.x)) continue;
        const uint corner = faceAt(candidate.x).a;
        if (bodyOf(corner) == body && keepsUncut(i, corner)) most = max(most, reach - restOf(abs(signedReach), remembered));
    }
    return most;
}

// How a point arrives in front of a face of a closed body.
struct Exit {
    bool isLetOut; // from behind
    float kept;    // the part of that overlap which is a rest distance [m]
};
const Exit noExit = Exit(false, 0.0);

// A point that comes out in front takes over the rest distance of the body's other faces, if its pair keeps one. All
// other overlap recovers. Such an overlap is marked by the sign of the memory: it differs from that of the front, the
// only side of a closed body.
Exit exitOf(uint i, uvec2 list, uint element, Meeting m, bool wasBehind) {
    const float remembered = MEMORY(element).w;
    if (!m.isKept) return Exit(wasBehind && remembered * m.front <= 0.0, 0.0);
    if (isAtLoad() || remembered * m.front > 0.0) return noExit;
    const float kept = mostKept(i, list, bodyOf(m.face.a), m.reach);
    return Exit(remembered != 0.0 || wasBehind || kept > m.reach, min(kept, m.reach));
}

// The contact on `side` of the face, at the place with the weights b.
Touch touchAt(Meeting m, uint element, float side, vec3 b, bool isThrough, Exit outcome) {
    Touch touch = Touch(vec3(0.0), 0.0, b, 0.0, isThrough, m.face);
    const float h = step.h, distance = length(m.nearest.d);
    const bool isAbove = isThrough || m.nearest.isInside || distance < 1e-15;
    touch.n = isAbove ? side * m.normal : m.nearest.d / distance;
    float overlap = m.reach - (isAbove ? side * m.height : distance);
    if (m.isBeyond) overlap = overlapPast(m, touch.n, b);
    touch.b = b;
    const float approach = -h * dot(touch.n, m.vp - b.y * m.vb - b.z * m.vc);
    const float part = h * (m.isOpened ? min(push.recoverySpeed, CUT_RECOVERY_SPEED) : push.recoverySpeed);
    const float remembered = MEMORY(element).w;
    float left = outcome.isLetOut ? max(0.0, overlap - part) : overlapLeft(remembered, overlap, approach, part), restSide = side;
    if (m.isKept && outcome.isLetOut) {
        left = overlapLetOut(remembered, overlap, outcome.kept, part, m.reach);
        if (left > outcome.kept) restSide = -side;
    } else if (m.isKept) {
        left = overlapKept(remembered, overlap, isAtLoad() ? overlapBefore(m, side, isThrough) : 0.0, m.reach);
    }
    touch.depth = max(0.0, overlap - left);
    mayPass = mayPass || touch.depth > push.quick;
    touch.remembered = m.isKept ? rememberedKept(restSide, touch.depth, left) : rememberedOf(side, touch.depth, left);
    if (CONTACT(element).x < push.sheets) return touch;
    // a recovering contact does not push, nor do the faces beside it
    const float shown = withCorners(left > 0.0 ? max(touch.depth, 2e-30) : touch.depth, b, m.triangle, m.reach);
    touch.depth = touch.depth > 0.0 ? shown : -shown;
    return touch;
}

// The contact with a face of a closed body. It acts on points in front of the face, and on points that came from
// there. A point behind it may come out. If an edge is nearest and the point is behind one of its faces, the point
// is in front of another one, or in contact with neither. A pair without a rest distance remembers by the sign that
// the point was behind: contacts may move the point to the front after this pass, so that the next one finds it
// there.
Touch touchOfSolid(uint i, uvec2 list, uint element, Meeting m) {
    const bool isFromBehind = !m.isKept && MEMORY(element).w * m.front < 0.0;
    const bool hasTouched = MEMORY(element).w != 0.0 && !isFromBehind, wasBehind = isFromBehind || m.front * m.heightBefore < 0.0;
    vec3 b = m.nearest.weights, passed;
    if (m.front * m.height >= 0.0) {
        m.isBeyond = m.isBeyond && !wasBehind;
        return touchAt(m, element, m.front, b, false, exitOf(i, list, element, m, wasBehind));
    }
    bool isThrough = hasTouched && m.nearest.isInside && isWithinReach(m);
    if (!wasBehind) {
        isThrough = wentThrough(m, passed);
        if (isThrough && !m.nearest.isInside) b = passed;
    }
    Touch touch = Touch(vec3(0.0), 0.0, b, !m.isKept && isWithinReach(m) ? -m.front : 0.0, false, m.face);
    if (isThrough) touch = touchAt(m, element, m.front, b, true, hasTouched ? exitOf(i, list, element, m, false) : noExit);
    touch.isThrough = false; // faces around it have the same front
    return touch;
}

// The contact with the face of a candidate. `through`: the side from which the point passes through a neighbouring
// face, as a unit vector; 0 = none.
Touch touchOf(uint i, uvec2 list, uint element, vec3 through) {
    const uvec2 candidate = CONTACT(element);
    Meeting m = keptMeetingOf(i, candidate);
    meets = 0u;
    if (isSliver(m.triangle)) return Touch(vec3(0.0), 0.0, vec3(0.0), 0.0, false, m.face);
    if (hasZones) noteMeeting(m);
    m.isBeyond = !m.isKept && isPast(passageOf(m), m.reach, m.nearest);
    if (isSolid(candidate.x)) return touchOfSolid(i, list, element, m);
    const bool isForced = dot(through, through) > 0.0;
    float side = isForced ? (dot(m.normal, through) < 0.0 ? -1.0 : 1.0) : areOneSheet(i, m.face.a) ? 0.0 : sideOf(MEMORY(element).w);
    const bool hasTouched = side != 0.0;
    if (!hasTouched) side = m.heightBefore < 0.0 ? -1.0 : 1.0;
    const bool isBefore = side * m.heightBefore >= 0.0;
    vec3 b = m.nearest.weights;
    bool isThrough = false;
    if (side * m.height < 0.0) {
        if (isForced || hasTouched && side * m.heightBefore < 0.0) {
            isThrough = isWithinReach(m); // a pair that is farther apart may be in no list: released
        } else {
            vec3 passed;
            isThrough = wentThrough(m, passed);
            if (isThrough && !m.nearest.isInside) b = passed;
        }
        if (!isThrough) side = -side; // it moved around the face, or is far beyond
    }
    m.isBeyond = m.isBeyond && !isThrough && isBefore;
    Touch touch = touchAt(m, element, side, b, isThrough, noExit);
    // The point goes back to the side that it came from, which the next substep sees by itself.
    if (m.isBeyond) touch.remembered = 0.0;
    return touch;
}
