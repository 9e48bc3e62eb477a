// Points that lie behind the surface of something solid when the scene is loaded and keep that: they go no deeper. Their rest distance is
// below 0. It is that of the point and the body, not of one face: the nearest face of the body holds the point. One that has come out in front of
// the surface is a point like any other. A point that is pressed through the surface is held at the rest distance that it had in front. At most
// four bodies hold a point. In the names and buffers of touch_faces.
struct Held {
    uint body;
    uint element; // of the face that holds; ~0 = none
    float rest;   // [m]
    vec3 d;       // to the point from the nearest place [m]
    float off;    // faces of the body are as near whose d differs by less [m]
};
const float far = 3e38;
const uint mostHolders = 4u;
Held holders[mostHolders];
uint holderCount = 0u;

// Up to where faces hold a point: lists reach as far.
bool isHoldable(Meeting m) { return m.isKept && !isSliver(m.triangle) && length(m.nearest.d) < 2.0 * m.reach; }

bool isOf(uint element, uint body) {
    const uint face = contacts[element].x;
    return isSolid(face) && bodyOf(faces[face].a) == body;
}

// The nearest face of a body, and what the point remembers of all of them.
struct Nearby {
    uint element;
    float reach, distance;
    vec3 d, before;        // from the nearest place, at the end of the substep and at its beginning [m]
    float rest;            // the least
    bool remembers;        // some face
};

Nearby nearbyOf(uint i, uvec2 list, uint body) {
    Nearby nearby = Nearby(~0u, 0.0, far, vec3(0.0), vec3(0.0), far, false);
    for (uint element = list.x; element < list.x + list.y; ++element) {
        if (!isOf(element, body)) continue;
        const Meeting m = keptMeetingOf(i, contacts[element]);
        if (!isHoldable(m)) continue;
        const float remembered = memory[element].w, distance = length(m.nearest.d);
        nearby.remembers = nearby.remembers || remembered != 0.0;
        if (remembered * m.front > 0.0) nearby.rest = min(nearby.rest, restOf(m.reach, remembered));
        if (distance >= nearby.distance) continue;
        nearby.element = element;
        nearby.reach = m.reach;
        nearby.distance = distance;
        nearby.d = m.nearest.d;
        nearby.before = nearestBefore(m).d;
    }
    return nearby;
}

float offOf(Nearby nearby) { return 1e-3 * nearby.distance + REST_SLACK * nearby.reach; }

// The normal of the surface at the nearest place, where several faces may meet: the sum over them by their angles says on which side a point is
// (Baerentzen and Aanaes 2005). `rest`: the least distance that the point remembers of the nearest face and its neighbours, which are not across a
// thin wall [m].
vec3 normalAt(uint i, uvec2 list, Nearby nearby, uint body, out float rest) {
    vec3 sum = vec3(0.0);
    rest = far;
    const ContactFace nearest = faces[contacts[nearby.element].x];
    for (uint element = list.x; element < list.x + list.y; ++element) {
        if (!isOf(element, body)) continue;
        const Meeting m = keptMeetingOf(i, contacts[element]);
        if (!isHoldable(m)) continue;
        if (memory[element].w * m.front > 0.0 && areNeighbours(m.face, nearest)) rest = min(rest, restOf(m.reach, memory[element].w));
        if (distance(m.nearest.d, nearby.d) <= offOf(nearby)) sum += angleOf(m) * m.front * m.normal;
    }
    return sum;
}

Held heldBy(uint i, uvec2 list, uint body) {
    const Nearby nearby = nearbyOf(i, list, body);
    Held held = Held(body, ~0u, 0.0, nearby.d, offOf(nearby));
    if (nearby.element == ~0u) return held;
    float rest;
    const vec3 normal = normalAt(i, list, nearby, body, rest);
    if (!(dot(nearby.d, normal) < 0.0)) return held;
    if (nearby.rest < 0.0) rest = nearby.rest;
    const float before = length(nearby.before);
    if (isAtLoad() && !nearby.remembers && before < nearby.reach && dot(nearby.before, normal) < 0.0) rest = -before - REST_SLACK * nearby.reach;
    held.rest = rest;
    if (rest < far) held.element = nearby.element;
    return held;
}

bool isKnown(uint body) {
    for (uint k = 0u; k < holderCount; ++k)
        if (holders[k].body == body) return true;
    return false;
}

// Looks at each body behind a face of which the point is. One that does not hold is asked again at its next such face.
void findHolders(uint i, uvec2 list) {
    for (uint element = list.x; element < list.x + list.y && holderCount < mostHolders; ++element) {
        if (!isSolid(contacts[element].x)) continue;
        const uint body = bodyOf(faces[contacts[element].x].a);
        if (body == bodyOf(i) || isKnown(body)) continue;
        const Meeting m = keptMeetingOf(i, contacts[element]);
        if (!isHoldable(m) || m.front * m.height >= 0.0) continue;
        holders[holderCount] = heldBy(i, list, body);
        if (holders[holderCount].element != ~0u) ++holderCount;
    }
}

Touch touchOfHolder(Meeting m, Held held, Touch touch) {
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

// The memory of a face of the same body that does not push: the same rest distance where it is as near, and its own where the point is in front.
float rememberedBeside(Meeting m, Held held, float remembered) {
    if (isHoldable(m) && distance(m.nearest.d, held.d) <= held.off) return rememberedKept(m.front, 0.0, m.reach - held.rest);
    return m.isKept && m.front * m.height >= 0.0 ? remembered : 0.0;
}

// A contact of a point that may be held: as it is, but for the faces of bodies that hold it: one of these alone pushes.
Touch heldTouch(uint i, uint element, Touch touch) {
    if (!isSolid(contacts[element].x)) return touch;
    const uint body = bodyOf(faces[contacts[element].x].a);
    for (uint k = 0u; k < holderCount; ++k) {
        if (holders[k].body != body) continue;
        const Meeting m = keptMeetingOf(i, contacts[element]);
        if (holders[k].element == element) return touchOfHolder(m, holders[k], touch);
        return Touch(vec3(0.0), 0.0, touch.b, rememberedBeside(m, holders[k], touch.remembered), false, touch.face);
    }
    const float reach = abs(uintBitsToFloat(contacts[element].y));
    if (abs(touch.remembered) - 1.0 <= reach) return touch;
    touch.remembered = sign(touch.remembered) * (1.0 + reach); // out in front: 0 is the least rest distance there
    return touch;
}
