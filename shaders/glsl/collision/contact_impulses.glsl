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
    slip -= dot(slip, n) * n;
    const float force = length(slip) * share;
    if (force > holds) slip *= slides / force;
    const vec3 old = slip - (way - dot(way, n) * n);
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

// The impulse on particle i from another that is `depth` too near along n [kg m].
vec3 impulseAlong(vec3 n, float depth, uint i, uint other, uint slot, vec3 velocity, float split, float offset) {
    float share = 1.0 / max(split, 1e-30); // two static particles: 0 times w = 0
    if (keepsForces && split <= 0.0) share = 0.0; // these exchange nothing
    const float lambda = depth * share;
    vec3 impulse = lambda * n;
    if (hasFriction) {
        const vec3 way = step.h * (velocity - VELOCITY(other).xyz), wayBefore = step.h * (BEFORE(i) - BEFORE(other));
        const vec2 friction = frictionOf(i, other);
        impulse -= held(slot, n, way, wayBefore, friction.x * lambda, friction.y * lambda, share, offset);
    }
    return impulse;
}

// The impulse from the candidate in `slot`, which is marked as touching.
vec3 impulseFrom(uint i, uint slot, vec4 self, vec3 velocity) {
    const uvec2 candidate = CONTACT(slot);
    const vec4 other = TOUCHING(candidate.x);
    const vec3 d = self.xyz - other.xyz;
    const float offset = offsetOf(slot), reach = uintBitsToFloat(candidate.y) - nearerBy(offset);
    vec3 way = vec3(0.0);
    bool hasPassed = false;
    if (keepsRestOf(offset) && reach > 0.0) {
        way = step.h * (velocity - VELOCITY(candidate.x).xyz);
        hasPassed = passes(d, way);
    }
    Direction direction = directionOf(d, i, candidate.x);
    if (hasPassed) direction = passedDirection(d, way);
    return impulseAlong(direction.n, reach - direction.distance, i, candidate.x, slot, velocity, self.w + other.w, offset);
}

// The impulse from the candidate in `slot` in a substep with fast particles. A pair that met stays at the point of contact: it loses its
// approach, and is not moved. If one of a marked pair has met another particle first, the two do not meet.
void addSwept(uint i, uint slot, vec4 self, vec3 velocity, inout vec3 moving, inout vec3 stopping) {
    const uvec2 candidate = CONTACT(slot);
    const uint j = candidate.x;
    const vec4 xi = predicted[i], xj = predicted[j];
    const vec3 d = xi.xyz - xj.xyz, way = step.h * (velocity - VELOCITY(j).xyz);
    const float offset = offsetOf(slot), reach = uintBitsToFloat(candidate.y) - nearerBy(offset);
    const Contact contact = contactOf(d, way, reach, min(firsts[i], firsts[j]), areFreeOf(xi.w, xj.w));
    const bool hasPassed = !contact.isMet && keepsRestOf(offset) && reach > 0.0 && passes(d, way);
    if (!contact.exists && !hasPassed) {
        forget(slot);
        return;
    }
    Direction direction = directionOf(contact.at, i, j);
    if (hasPassed) direction = passedDirection(d, way);
    const float depth = contact.isMet ? max(0.0, -dot(direction.n, way)) : reach - direction.distance;
    const vec3 impulse = impulseAlong(direction.n, depth, i, j, slot, velocity, self.w + TOUCHING(j).w, offset);
    if (contact.isMet) stopping += impulse;
    else moving += impulse;
}
