// How a point touches a face in a substep, and on which side. In the names and buffers of touch_faces.
#include "face_meeting.glsl"

struct Touch {
    vec3 n;
    float depth;    // > 0 where they touch [m]
    vec3 b;
    float remembered; // the side, 1 = where the normal points, and the overlap
    bool isThrough; // the point is beyond the face's plane, and came through the face
    ContactFace face;
};

Meeting keptMeetingOf(uint i, uvec2 candidate) {
    Meeting m = meetingOf(i, candidate);
    m.isKept = keeps(i, m.face.a);
    return m;
}

// By how much the two overlapped when the substep began, measured as at its end.
float overlapBefore(Meeting m, float side, bool isThrough) {
    const Nearest before = nearestBefore(m);
    return m.reach - (isThrough || before.isInside ? side * m.heightBefore : length(before.d));
}

// On `side` of the face, at the place with the weights b.
Touch touchAt(Meeting m, uint element, float side, vec3 b, bool isThrough, bool isLetOut) {
    Touch touch = Touch(vec3(0.0), 0.0, b, 0.0, isThrough, m.face);
    const float h = step.h, distance = length(m.nearest.d);
    const bool isAbove = isThrough || m.nearest.isInside || distance < 1e-15;
    touch.n = isAbove ? side * m.normal : m.nearest.d / distance;
    const float overlap = m.reach - (isAbove ? side * m.height : distance);
    const float approach = -h * dot(touch.n, m.vp - b.y * m.vb - b.z * m.vc), part = push.recoverySpeed * h;
    float left = isLetOut ? max(0.0, overlap - part) : overlapLeft(memory[element].w, overlap, approach, part);
    if (m.isKept && isLetOut) left = max(0.0, overlap);
    else if (m.isKept) left = overlapKept(memory[element].w, overlap, step.hPrevious == 0.0 ? overlapBefore(m, side, isThrough) : 0.0, m.reach);
    touch.depth = max(0.0, overlap - left);
    touch.remembered = m.isKept ? rememberedKept(side, touch.depth, left) : rememberedOf(side, touch.depth, left);
    if (contacts[element].x < push.sheets) return touch;
    // what parts by itself does not push, nor do the faces beside it
    const float shown = withCorners(left > 0.0 ? max(touch.depth, 2e-30) : touch.depth, b, m.triangle, m.reach);
    touch.depth = touch.depth > 0.0 ? shown : -shown;
    return touch;
}

// The surface of something solid holds what is in front of it, or comes from there. What is behind it may come out. Where an edge
// is nearest and the point is behind one of its faces, it is in front of another, or has none to do with them.
Touch touchOfSolid(uint element, Meeting m) {
    const bool hasTouched = memory[element].w != 0.0, wasBehind = m.front * m.heightBefore < 0.0;
    vec3 b = m.nearest.weights, passed;
    if (m.front * m.height >= 0.0) return touchAt(m, element, m.front, b, false, wasBehind && !hasTouched);
    bool isThrough = hasTouched && m.nearest.isInside && isWithinReach(m);
    if (!wasBehind) {
        isThrough = wentThrough(m, passed);
        if (isThrough && !m.nearest.isInside) b = passed;
    }
    Touch touch = Touch(vec3(0.0), 0.0, b, 0.0, false, m.face);
    if (isThrough) touch = touchAt(m, element, m.front, b, true, false);
    touch.isThrough = false; // faces around it have the same front
    return touch;
}

// `through`: the side that a neighbouring face is being passed from, as a unit vector; 0 = none.
Touch touchOf(uint i, uint element, vec3 through) {
    const uvec2 candidate = contacts[element];
    const Meeting m = keptMeetingOf(i, candidate);
    if (isSliver(m.triangle)) return Touch(vec3(0.0), 0.0, vec3(0.0), 0.0, false, m.face);
    if (candidate.x >= push.sheets && candidate.x < push.moving) return touchOfSolid(element, m);
    const bool isForced = dot(through, through) > 0.0;
    float side = isForced ? (dot(m.normal, through) < 0.0 ? -1.0 : 1.0) : sideOf(memory[element].w);
    const bool hasTouched = side != 0.0;
    if (!hasTouched) side = m.heightBefore < 0.0 ? -1.0 : 1.0;
    vec3 b = m.nearest.weights;
    bool isThrough = false;
    if (side * m.height < 0.0) {
        if (isForced || hasTouched && side * m.heightBefore < 0.0) {
            isThrough = isWithinReach(m); // what is farther may be in no list: let go
        } else {
            vec3 passed;
            isThrough = wentThrough(m, passed);
            if (isThrough && !m.nearest.isInside) b = passed;
        }
        if (!isThrough) side = -side; // it went around, or is far beyond
    }
    return touchAt(m, element, side, b, isThrough, false);
}
