// Selects the faces that push a point, among touched faces that are static or of closed bodies. Inner edges of a flat
// surface must not push: a point over one face is near an edge of the next face too. Requires faces, contacts,
// directions and push.
layout(constant_id = 4) const bool hasSolid = true; // some faces are of closed bodies
bool isSolid(uint face) { return hasSolid && face >= push.sheets && face < push.moving; }

bool isCorner(uint i, ContactFace face) { return i == face.a || i == face.b || i == face.c; }

bool areNeighbours(ContactFace one, ContactFace other) {
    return isCorner(one.a, other) || isCorner(one.b, other) || isCorner(one.c, other);
}

// Stores in the lowest bits of a depth the corners of a face between which the nearest place lies, bit k for corner
// k: all three, or those of an edge or a corner that is so near to that place that rounding decides.
float withCorners(float depth, vec3 b, Triangle triangle, float reach) {
    const vec3 bc = triangle.ac - triangle.ab;
    const vec3 heights = length(triangle.normal) * inversesqrt(vec3(dot(bc, bc), dot(triangle.ac, triangle.ac), dot(triangle.ab, triangle.ab)));
    const bvec3 isFar = greaterThan(b * heights, vec3(0.01 * reach));
    const uint corners = (isFar.x ? 1u : 0u) | (isFar.y ? 2u : 0u) | (isFar.z ? 4u : 0u);
    // a triangle smaller than that counts with all corners
    return depth > 1e-30 ? uintBitsToFloat(floatBitsToUint(depth) & ~7u | (corners == 0u ? 7u : corners)) : 0.0;
}
uint cornersIn(float depth) { return floatBitsToUint(depth) & 7u; }

// True if `other` has all corners of `face` in the bit set `corners`.
bool has(ContactFace other, ContactFace face, uint corners) {
    return ((corners & 1u) == 0u || isCorner(face.a, other)) && ((corners & 2u) == 0u || isCorner(face.b, other)) &&
           ((corners & 4u) == 0u || isCorner(face.c, other));
}

// True if an overlap with a face of a closed body is recovering (exitOf).
bool isParting(uint element) { return isSolid(CONTACT(element).x) && weights[element].w * uintBitsToFloat(CONTACT(element).y) < 0.0; }

// True if a pair keeps its rest distance. Pairs separated by a cut do not: they touched nothing when the scene was
// loaded.
bool keepsUncut(uint i, uint j) { return keeps(i, j) && !(firstInner != ~0u && areParted(i, j)); }

// The memory of a face with the rest distance of the hidden face beside it: a point that moves from above one face to
// above the next keeps its rest distance.
float withRestOf(uint i, uint element, uint beside) {
    const float own = weights[element].w, other = weights[beside].w;
    if (abs(other) <= 1.0 || !keepsUncut(i, faceAt(CONTACT(beside).x).a) || !keepsUncut(i, faceAt(CONTACT(element).x).a)) return own;
    const bool parts = isParting(beside);
    if (parts && abs(own) > 1.0) return own;
    const float nearer = abs(uintBitsToFloat(CONTACT(element).y)) - abs(uintBitsToFloat(CONTACT(beside).y)); // 0 for equal thickness
    const float taken = abs(other) + nearer;
    if (taken <= abs(own)) return own;
    return (parts != isParting(element) ? -taken : taken) * sign(own);
}

// The side of particle j of a face's plane: above 0 = in front. 0 for a sliver, which has no plane.
float sideOfFront(uint j, uint element) {
    const ContactFace face = faceAt(CONTACT(element).x);
    const vec3 a = PREDICTED(face.a).xyz;
    const Triangle triangle = triangleOf(PREDICTED(face.b).xyz - a, PREDICTED(face.c).xyz - a);
    const float height = dot(triangle.normal, PREDICTED(j).xyz - a);
    return isSliver(triangle) ? 0.0 : CONTACT(element).y >> 31 != 0u ? -height : height; // the sign bit is that of the thickness
}

uint cornerBeside(ContactFace face, ContactFace other) {
    return !isCorner(other.a, face) ? other.a : !isCorner(other.b, face) ? other.b : other.c;
}

// True if the nearest edge is that of a concave fold, and the point is behind the face on its other side, `beside`.
// The direction from the edge then leads along the surface of the body instead of out of it, and would push the point
// aside. Not for points of the same body: a crumpling body has many such folds, and they hold its own points.
bool isBehind(uint i, uint element, uint corners, uint beside) {
    if (bitCount(corners) != 2 || !isSolid(CONTACT(element).x) || !isSolid(CONTACT(beside).x)) return false;
    if (bodyOf(i) == bodyOf(faceAt(CONTACT(beside).x).a)) return false;
    if (!(sideOfFront(i, beside) < 0.0 && sideOfFront(i, element) >= 0.0)) return false;
    return sideOfFront(cornerBeside(faceAt(CONTACT(element).x), faceAt(CONTACT(beside).x)), element) > 0.0;
}

// Stores the overlap of a contact that such an edge does not push, so that it recovers at the speed of recovery once
// it pushes again.
void leaveOverlap(uint i, uint element) {
    const float own = weights[element].w;
    if (keepsUncut(i, faceAt(CONTACT(element).x).a)) return;
    weights[element].w = rememberedOf(sign(own), 0.0, max(0.0, abs(own) - 1.0) + directions[element].w);
}

// Hides contacts at an edge or a corner of a face if another face contains that edge or corner too, and the nearest
// place on it is in a larger part, or in the same: then the first one stays. If inner edges of a flat surface pushed
// as well, a hit would be deflected, be too soft, and be thrown as it comes out. A hidden contact does not push: its
// depth is below 0. Its memory goes on, for the nearest place may move from one face to the other. Contacts with
// moving sheets are not hidden: where cloth lies on cloth, pushing the neighbouring faces as well spreads the load of
// a point, and folds come to rest sooner.
bool mayHide(uint element) {
    const float depth = directions[element].w;
    return depth > 0.0 && cornersIn(depth) != 7u && CONTACT(element).x >= push.sheets;
}

void hideOne(uint i, uint element, uint first, uint end) {
    const uint corners = cornersIn(directions[element].w);
    const ContactFace face = faceAt(CONTACT(element).x);
    bool isHidden = false;
    for (uint beside = first; beside < end && !isHidden; ++beside) {
        if (beside == element || CONTACT(beside).x < push.sheets) continue;
        const ContactFace other = faceAt(CONTACT(beside).x);
        if (!has(other, face, corners)) continue;
        if (directions[beside].w == 0.0) {
            isHidden = isBehind(i, element, corners, beside);
            if (isHidden) leaveOverlap(i, element);
            continue;
        }
        isHidden = beside < element || !has(face, other, cornersIn(directions[beside].w));
        if (isHidden && keepsRest) weights[element].w = withRestOf(i, element, beside);
    }
    if (isHidden) directions[element].w = -directions[element].w;
}

void hide(uint i, uint first, uint end) {
    for (uint from = first; from < end; from += 32u) {
        uint left = 0u; // a software device takes its time for code under a condition, but not for turns of a loop
        for (uint element = from; element < min(from + 32u, end); ++element) left |= uint(mayHide(element)) << element - from;
        for (; left != 0u; left &= left - 1u) hideOne(i, from + uint(findLSB(left)), first, end);
    }
}
