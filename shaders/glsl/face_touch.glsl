// How a point touches a face in a substep, and on which side. In the names and buffers of touch_faces.
struct Touch {
    vec3 n;
    float depth;    // > 0 where they touch [m]
    vec3 b;
    float remembered; // the side, 1 = where the normal points, and the overlap
    bool isThrough; // the point is beyond the face's plane, and came through the face
    ContactFace face;
};

// Whether a point that has passed a plane went through the face in it: on straight ways, where it was in the plane. A face
// that turns was not quite there; what it never was within reach of may be in no list.
bool hasPassed(vec3 ap, vec3 ab, vec3 ac, float reach, out vec3 b) {
    b = weightsOf(ap, triangleOf(ab, ac));
    const bool isInside = min(b.x, min(b.y, b.z)) >= -1e-3; // of two faces at an edge at least one sees it
    b = max(b, vec3(0.0));
    b /= b.x + b.y + b.z;
    const vec3 d = ap - b.y * ab - b.z * ac;
    return isInside && dot(d, d) < reach * reach;
}

// A point and a face at the end of a substep, and on which side of its plane the point then is and was at its beginning.
struct Meeting {
    ContactFace face;
    float reach;               // [m]
    vec3 ap, ab, ac, vp, vb, vc; // from corner a, and relative to its velocity
    Triangle triangle;
    Nearest nearest;
    vec3 normal;               // unit
    float height, heightBefore; // [m]
    bool isKept;               // the pair keeps its rest distance
};

Meeting meetingOf(uint i, uvec2 candidate) {
    Meeting m;
    m.face = faces[candidate.x];
    m.reach = uintBitsToFloat(candidate.y);
    const float h = step.h;
    const vec3 a = predicted[m.face.a].xyz, va = velocities[m.face.a].xyz;
    m.ap = predicted[i].xyz - a, m.ab = predicted[m.face.b].xyz - a, m.ac = predicted[m.face.c].xyz - a;
    m.vp = velocities[i].xyz - va, m.vb = velocities[m.face.b].xyz - va, m.vc = velocities[m.face.c].xyz - va;
    m.triangle = triangleOf(m.ab, m.ac);
    m.nearest = nearestOf(m.ap, m.triangle);
    m.normal = normalize(m.triangle.normal);
    m.height = dot(m.normal, m.ap);
    const Triangle before = triangleOf(m.ab - h * m.vb, m.ac - h * m.vc);
    m.heightBefore = dot(before.normal, m.ap - h * m.vp) / max(length(before.normal), 1e-30);
    m.isKept = keeps(i, m.face.a);
    return m;
}

bool wentThrough(Meeting m, out vec3 b) {
    const float back = step.h * m.height / (m.height - m.heightBefore); // since it was in the plane [s]
    return hasPassed(m.ap - back * m.vp, m.ab - back * m.vb, m.ac - back * m.vc, m.reach, b);
}

Nearest nearestBefore(Meeting m) {
    return nearestOf(m.ap - step.h * m.vp, triangleOf(m.ab - step.h * m.vb, m.ac - step.h * m.vc));
}

// By how much the two overlapped when the substep began, measured as at its end.
float overlapBefore(Meeting m, float side, bool isThrough) {
    const Nearest before = nearestBefore(m);
    return m.reach - (isThrough || before.isInside ? side * m.heightBefore : length(before.d));
}

bool isWithinReach(Meeting m) { return dot(m.nearest.d, m.nearest.d) < m.reach * m.reach; }

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
    const bool hasTouched = memory[element].w != 0.0, wasBehind = m.heightBefore < 0.0;
    vec3 b = m.nearest.weights, passed;
    if (m.height >= 0.0) return touchAt(m, element, 1.0, b, false, wasBehind && !hasTouched);
    bool isThrough = hasTouched && m.nearest.isInside && isWithinReach(m);
    if (!wasBehind) {
        isThrough = wentThrough(m, passed);
        if (isThrough && !m.nearest.isInside) b = passed;
    }
    Touch touch = Touch(vec3(0.0), 0.0, b, 0.0, false, m.face);
    if (isThrough) touch = touchAt(m, element, 1.0, b, true, false);
    touch.isThrough = false; // faces around it have the same front
    return touch;
}

// `through`: the side that a neighbouring face is being passed from, as a unit vector; 0 = none.
Touch touchOf(uint i, uint element, vec3 through) {
    const uvec2 candidate = contacts[element];
    const Meeting m = meetingOf(i, candidate);
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
