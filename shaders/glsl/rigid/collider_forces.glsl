// Sums of the impulses on colliders. The including kernel has the push constants of colliders.
#define WHOLE_SUMS_BINDING (FORCES_BINDING + 1)
#include "forces/whole_sums.glsl"

// The impulse of collider c on particle i, `arm` away from its middle [m]. A particle has an element for each collider,
// or one for all and the collider a sum of its own.
const bool sumsWhole = colliderCount > MOST_COLLIDER_ROWS;
void addColliderForce(uint c, uint i, vec3 impulse, vec3 arm) {
    if (!keepsForces) return;
    addRowForce(sumsWhole ? 0u : c, i, impulse, arm);
    if (!sumsWhole) return;
    const vec3 moment = cross(arm, impulse);
    for (uint axis = 0u; axis < 3u; ++axis) {
        addWhole(c, 2u * axis, push.forceScale * impulse[axis]);
        addWhole(c, 6u + 2u * axis, push.forceScale * moment[axis]);
    }
}
