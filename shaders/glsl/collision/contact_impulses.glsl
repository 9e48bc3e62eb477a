// Part of gather_contacts: impulses on a particle from other particles, normal and friction with contact memory.
// Requires the names and buffers of that kernel.
// Friction impulse that cancels the slip of a pair, x w = share of the pair: all of the slip if its force is at most
// `holds`, the static bound, else up to `slides`. The memory holds the slip before the substep, and the velocities
// after it give the displacement that followed, whatever else moved the particles: summing predicted displacements
// instead counts gravity in every substep, and creeps uphill. `way` is the relative displacement of this substep,
// `wayBefore` that of the last. A pair that did not touch in the last substep has no memory, which is 0; a slip of 0
// is therefore stored as 1e-30.
vec3 held(uint slot, vec3 n, vec3 way, vec3 wayBefore, float slides, float holds, float share, float offset) {
    vec3 slip = slips[slot].xyz;
    if (slip != vec3(0.0)) slip += wayBefore;
    slip += way;
    slip -= dot3(slip, n) * n;
    const float force = length3(slip) * share;
    if (force > holds) slip *= slides / force;
    const vec3 old = slip - (way - dot3(way, n) * n);
    slips[slot] = vec4(old == vec3(0.0) ? vec3(1e-30, 0.0, 0.0) : old, offset);
    return share * slip;
}

float offsetOf(uint slot) {
    return hasRecovery ? slips[slot].w : 0.0;
}

// Clears the slip of a pair that does not touch; the remaining overlap stays.
void forget(uint slot) {
    if (hasMemory) slips[slot] = vec4(0.0, 0.0, 0.0, offsetOf(slot));
}

bool keepsRestOf(float offset) {
    return keepsRest && isKept(offset);
}

// A marked candidate of particle i.
struct Pair {
    uint slot, other;
    vec3 d, way; // difference of the two, and its change in this substep [m]
    float offset, reach;
};

Pair pairOf(uint slot, vec3 x, vec3 velocity, bool isSwept) {
    const uvec2 candidate = CONTACT(slot);
    const uint j = candidate.x;
    const float offset = offsetOf(slot);
    const vec3 other = isSwept ? predicted[j].xyz : TOUCHING(j).xyz;
    return Pair(slot, j, x - other, step.h * (velocity - VELOCITY(j).xyz), offset, uintBitsToFloat(candidate.y) - nearerBy(offset));
}

// The impulse on particle i from the other of a pair [kg m]. `split`: contacts x inverse mass, of both. The loops of
// gather_contacts share this arithmetic, to the bit: a pair must not notice that a particle elsewhere is fast.
vec3 impulseOf(uint i, Pair pair, Contact contact, float split) {
    const bool hasPassed = !contact.isMet && keepsRestOf(pair.offset) && pair.reach > 0.0 && passes(pair.d, pair.way);
    if (!contact.exists && !hasPassed) {
        forget(pair.slot);
        return vec3(0.0);
    }
    Direction direction = directionOf(contact.at, i, pair.other);
    if (hasPassed) direction = passedDirection(pair.d, pair.way);
    const float depth = contact.isMet ? max(0.0, -dot3(direction.n, pair.way)) : pair.reach - direction.distance;
    float share = 1.0 / max(split, 1e-30); // two static particles: 0 times w = 0
    if (keepsForces && split <= 0.0) share = 0.0; // these exchange nothing
    const float lambda = depth * share;
    receiveAlong(direction.n, lambda / step.h);
    vec3 impulse = lambda * direction.n;
    if (hasFriction) {
        const vec3 wayBefore = step.h * (BEFORE(i) - BEFORE(pair.other));
        const vec2 friction = frictionOf(i, pair.other);
        impulse -= held(pair.slot, direction.n, pair.way, wayBefore, friction.x * lambda, friction.y * lambda, share, pair.offset);
    }
    return impulse;
}

// The impulse from the candidate in `slot`, which is marked as touching.
vec3 impulseFrom(uint i, uint slot, vec4 self, vec3 velocity) {
    const Pair pair = pairOf(slot, self.xyz, velocity, false);
    return impulseOf(i, pair, Contact(true, false, pair.d), self.w + TOUCHING(pair.other).w);
}

// The impulse from the candidate in `slot` in a substep with fast particles. A pair that met stays at the point of contact: it loses its
// approach, and is not moved. If one of a marked pair has met another particle first, the two do not meet.
void addSwept(uint i, uint slot, vec4 self, vec3 velocity, inout vec3 moving, inout vec3 stopping) {
    const vec4 x = predicted[i];
    const Pair pair = pairOf(slot, x.xyz, velocity, true);
    const uint j = pair.other;
    const Contact contact = contactOf(pair.d, pair.way, pair.reach, min(FIRST_IMPACT(i), FIRST_IMPACT(j)), areFreeOf(x.w, predicted[j].w));
    const vec3 impulse = impulseOf(i, pair, contact, self.w + TOUCHING(j).w);
    if (contact.isMet) stopping += impulse;
    else moving += impulse;
}
