// Sums of the impulses on colliders. The including kernel has the push constants of colliders.
layout(std430, binding = FORCES_BINDING + 1) buffer ColliderForces { ColliderForce colliderForces[]; };

// Adds a component to a whole number of 64 bits.
void addWhole(uint c, uint word, float component) {
    const float scaled = push.forceScale * component, size = abs(scaled);
    uint high = uint(size / 4294967296.0), low = uint(size - 4294967296.0 * float(high));
    if (scaled < 0.0) {
        low = ~low + 1u;
        high = ~high + (low == 0u ? 1u : 0u);
    }
    const uint carry = atomicAdd(colliderForces[c].words[word], low) > ~low ? 1u : 0u;
    atomicAdd(colliderForces[c].words[word + 1u], high + carry);
}

// The impulse of collider c on particle i, `arm` away from its middle [m]. A particle has an element for each collider,
// or one for all and the collider a sum of its own.
const bool sumsWhole = colliderCount > MOST_COLLIDER_ROWS;
void addColliderForce(uint c, uint i, vec3 impulse, vec3 arm) {
    if (!keepsForces) return;
    addRowForce(sumsWhole ? 0u : c, i, impulse, arm);
    if (!sumsWhole) return;
    const vec3 moment = cross(arm, impulse);
    for (uint axis = 0u; axis < 3u; ++axis) {
        addWhole(c, 2u * axis, impulse[axis]);
        addWhole(c, 6u + 2u * axis, moment[axis]);
    }
}
