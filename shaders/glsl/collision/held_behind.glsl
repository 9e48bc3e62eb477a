// Points that are behind the surface of a closed body when the scene is loaded and keep that overlap: they go no
// deeper. Their rest distance is below 0. It belongs to the point and the body, not to one face: the nearest face of
// the body holds the point. A point that has come out in front of the surface becomes an ordinary one. A point that
// is pressed through the surface is held at the rest distance that it had in front. At most four bodies hold a point.
// Requires the names and buffers of find_face_contacts.
struct Held {
    uint body;
    uint element; // element of the face that holds the point; ~0 = none
    float rest;   // [m]
    vec3 d;       // from the nearest place to the point [m]
    float off;    // faces of the body whose d differs by less count as equally near [m]
};
const float far = 3e38;
const uint mostHolders = 4u;
Held holders[mostHolders];
uint holderCount = 0u;

// True for faces that may hold a point: within twice the reach, which the lists cover.
bool isHoldable(Meeting m) { return m.isKept && !isSliver(m.triangle) && length(m.nearest.d) < 2.0 * m.reach; }

bool isOf(uint element, uint body) {
    const uint face = CONTACT(element).x;
    return isSolid(face) && bodyOf(faceAt(face).a) == body;
}

// The nearest face of a body, and the memory of the point's contacts with all of them.
struct Nearby {
    uint element;
    float reach, distance;
    vec3 d, before;        // from the nearest place, at the end and at the start of the substep [m]
    float rest;            // smallest rest distance
    bool remembers;        // any contact has memory
};

Nearby nearbyOf(uint i, uvec2 list, uint body) {
    Nearby nearby = Nearby(~0u, 0.0, far, vec3(0.0), vec3(0.0), far, false);
    for (uint element = list.x; element < list.x + list.y; ++element) {
        if (!isOf(element, body)) continue;
        const Meeting m = keptMeetingOf(i, CONTACT(element));
        if (!isHoldable(m)) continue;
        const float remembered = MEMORY(element).w, distance = length(m.nearest.d);
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

// The normal of the surface at the nearest place, where several faces may meet: their normals weighted by their
// angles give the side of a point (Baerentzen and Aanaes 2005). `rest`: the smallest rest distance of the point to
// the nearest face and its neighbours, which excludes faces across a thin wall [m].
vec3 normalAt(uint i, uvec2 list, Nearby nearby, uint body, out float rest) {
    vec3 sum = vec3(0.0);
    rest = far;
    const ContactFace nearest = faceAt(CONTACT(nearby.element).x);
    for (uint element = list.x; element < list.x + list.y; ++element) {
        if (!isOf(element, body)) continue;
        const Meeting m = keptMeetingOf(i, CONTACT(element));
        if (!isHoldable(m)) continue;
        if (MEMORY(element).w * m.front > 0.0 && areNeighbours(m.face, nearest)) rest = min(rest, restOf(m.reach, MEMORY(element).w));
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

// Finds the bodies that hold the point: tests each body with a face that the point is behind. A body that does not
// hold it is tested again at its next such face.
void findHolders(uint i, uvec2 list) {
    for (uint element = list.x; element < list.x + list.y && holderCount < mostHolders; ++element) {
        if (!isSolid(CONTACT(element).x)) continue;
        const uint body = bodyOf(faceAt(CONTACT(element).x).a);
        if (body == bodyOf(i) || isKnown(body)) continue;
        const Meeting m = keptMeetingOf(i, CONTACT(element));
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
    // all three corner bits: a contact in the face hides those beside it
    const float shown = uintBitsToFloat(floatBitsToUint(max(depth, 2e-30)) | 7u);
    touch.depth = depth > 0.0 ? shown : -shown;
    touch.isThrough = false;
    return touch;
}

// The memory of another face of the same body, which does not push: the same rest distance if it is equally near, and
// its own if the point is in front.
float rememberedBeside(Meeting m, Held held, float remembered) {
    if (isHoldable(m) && distance(m.nearest.d, held.d) <= held.off) return rememberedKept(m.front, 0.0, m.reach - held.rest);
    return m.isKept && m.front * m.height >= 0.0 ? remembered : 0.0;
}

// The contact of a point that may be held: unchanged, except for faces of bodies that hold it, only one of which
// pushes.
Touch heldTouch(uint i, uint element, Touch touch) {
    if (!isSolid(CONTACT(element).x)) return touch;
    const uint body = bodyOf(faceAt(CONTACT(element).x).a);
    for (uint k = 0u; k < holderCount; ++k) {
        if (holders[k].body != body) continue;
        const Meeting m = keptMeetingOf(i, CONTACT(element));
        if (holders[k].element == element) return touchOfHolder(m, holders[k], touch);
        return Touch(vec3(0.0), 0.0, touch.b, rememberedBeside(m, holders[k], touch.remembered), false, touch.face);
    }
    const float reach = abs(uintBitsToFloat(CONTACT(element).y));
    if (abs(touch.remembered) - 1.0 <= reach) return touch;
    touch.remembered = sign(touch.remembered) * (1.0 + reach); // the point is in front: the least rest distance there is 0
    return touch;
}
