// Points that lie behind the surface of something solid when the scene is loaded and keep that: they go no deeper. Their rest distance is
// below 0. It is the point's, not that of one face: whichever face of that surface is nearest holds it. One that has come out in front of
// the surface is a point like any other. In the names and buffers of touch_faces.
struct Held {
    uint element; // of the face that holds; ~0 = none
    float rest;   // below 0 [m]
};
const Held noHeld = Held(~0u, 0.0);
const float far = 3e38;

bool isSolid(uint face) { return face >= push.sheets && face < push.moving; }

// Up to where faces hold a point: lists reach as far.
bool isHoldable(Meeting m) { return m.isKept && !isSliver(m.triangle) && length(m.nearest.d) < 2.0 * m.reach; }

// The nearest face behind which the point is. Rest distances, and how deep the point was before, come with it.
struct Behind {
    uint element, corner; // a corner of the face
    float reach, depth, depthBefore, rest;
    bool remembers; // some face
};

Behind behindOf(uint i, uvec2 list) {
    Behind behind = Behind(~0u, ~0u, 0.0, far, far, 0.0, false);
    for (uint element = list.x; element < list.x + list.y; ++element) {
        if (!isSolid(contacts[element].x) || areOfOneBody(i, faces[contacts[element].x].a)) continue;
        const Meeting m = keptMeetingOf(i, contacts[element]);
        if (!isHoldable(m)) continue;
        const float remembered = memory[element].w;
        behind.remembers = behind.remembers || remembered != 0.0;
        if (remembered != 0.0) behind.rest = min(behind.rest, m.reach - (abs(remembered) - 1.0));
        const float depth = length(m.nearest.d);
        if (m.front * m.height >= 0.0 || depth >= behind.depth) continue;
        behind.element = element;
        behind.corner = m.face.a;
        behind.reach = m.reach;
        behind.depth = depth;
        behind.depthBefore = m.front * m.heightBefore < 0.0 ? length(nearestBefore(m).d) : far;
        if (behind.depthBefore >= m.reach) behind.depthBefore = far; // too deep to be a pair
    }
    return behind;
}

// How near the point is to a face of that body in front of which it is [m].
float frontOf(uint i, uvec2 list, uint corner) {
    float front = far;
    for (uint element = list.x; element < list.x + list.y; ++element) {
        if (!isSolid(contacts[element].x) || !areOfOneBody(corner, faces[contacts[element].x].a)) continue;
        const Meeting m = keptMeetingOf(i, contacts[element]);
        if (isHoldable(m) && m.front * m.height >= 0.0) front = min(front, length(m.nearest.d));
    }
    return front;
}

Held heldBehind(uint i, uvec2 list) {
    const Behind behind = behindOf(i, list);
    const bool isNew = step.hPrevious == 0.0 && !behind.remembers && behind.depthBefore < far;
    if (behind.element == ~0u || !isNew && behind.rest >= 0.0) return noHeld;
    const float front = frontOf(i, list, behind.corner);
    // as near to a face in front as to one behind: at an edge, where whoever was behind still is
    if (isNew ? behind.depth > 0.999 * front : behind.depth > 1.001 * front) return noHeld;
    return Held(behind.element, isNew ? -behind.depthBefore - REST_SLACK * behind.reach : behind.rest);
}

// A contact of a point that may be held: as it is, but for the face that holds and others behind which the point is.
Touch heldTouch(uint i, uint element, Held held, Touch touch) {
    if (!isSolid(contacts[element].x)) return touch;
    if (element != held.element) {
        const float reach = abs(uintBitsToFloat(contacts[element].y));
        if (abs(touch.remembered) - 1.0 <= reach) return touch;
        if (held.element != ~0u) return Touch(vec3(0.0), 0.0, touch.b, 0.0, false, touch.face); // another face holds now
        touch.remembered = sign(touch.remembered) * (1.0 + reach); // out in front: 0 is the least rest distance there
        return touch;
    }
    const Meeting m = keptMeetingOf(i, contacts[element]);
    const float distance = length(m.nearest.d), left = m.reach - held.rest;
    touch.n = m.nearest.isInside || distance < 1e-15 ? m.front * m.normal : -m.nearest.d / distance;
    touch.b = m.nearest.weights;
    const float depth = max(0.0, distance + held.rest);
    touch.remembered = rememberedKept(m.front, depth, left);
    // as with all corners nearest: it hides what is beside it
    const float shown = uintBitsToFloat(floatBitsToUint(max(depth, 2e-30)) | 7u);
    touch.depth = depth > 0.0 ? shown : -shown;
    touch.isThrough = false;
    return touch;
}
