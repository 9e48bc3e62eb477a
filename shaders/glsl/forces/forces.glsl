// Adds the impulses of a kernel on particles to the sums of a step [N s] (sim/forces/forces.hpp). Every invocation writes
// elements of its own particle alone, so no atomics are needed and sums have one order. Without forces the functions do
// nothing. NO_FORCES: no scene with forces has this kernel.
#ifdef NO_FORCES
const bool keepsForces = false;
void addContactForce(uint i, vec3 impulse) {}
void addRowForce(uint row, uint i, vec3 impulse, vec3 arm) {}
uint rowElement(uint row, uint i) { return 0u; }
#else
layout(constant_id = 20) const uint forceSlots = 0; // elements of a section: slots of the state; 0 = no forces
layout(constant_id = 21) const uint firstForce = 0; // first element of the sections, or entries, of this kernel
layout(std430, binding = FORCES_BINDING) buffer Forces { vec4 forces[]; };
const bool keepsForces = forceSlots > 0u;

void addContactForce(uint i, vec3 impulse) {
    if (keepsForces) forces[i].xyz += impulse;
}

void addHoldForce(uint i, vec3 impulse) {
    if (keepsForces) forces[forceSlots + i].xyz += impulse;
}

// The impulse in one entry of a list.
void addListedForce(uint entry, vec3 impulse) {
    if (keepsForces) forces[firstForce + entry].xyz += impulse;
}

// The element of the impulses of row `row` of this kernel on particle i; its moments are forceSlots behind.
uint rowElement(uint row, uint i) { return firstForce + 2u * row * forceSlots + i; }

// The impulse of plane, collider, grab or body `row` of this kernel on particle i, which is `arm` away from the row's
// place [m].
void addRowForce(uint row, uint i, vec3 impulse, vec3 arm) {
    if (!keepsForces) return;
    const uint element = rowElement(row, i);
    forces[element].xyz += impulse;
    forces[element + forceSlots].xyz += cross(arm, impulse);
}

#ifdef STOPS
// Static faces: the row that sums the impulses of a face (forces::Stops), and the particle about which its moments
// are taken.
layout(std430, binding = FORCES_BINDING + 1) readonly buffer StopRows { uvec2 stopRows[]; };
layout(std430, binding = FORCES_BINDING + 2) readonly buffer Places { vec4 places[]; }; // positions of static particles in this substep [m]

// The impulse of static face f on particle i at x.
void addStopForce(uint f, uint i, vec3 impulse, vec3 x) {
    if (!keepsForces) return;
    const uvec2 row = stopRows[f];
    addRowForce(row.x, i, impulse, x - places[row.y].xyz);
}
#endif
#endif

// The place of a plane is its point nearest to the origin.
vec3 planeArm(PlaneCollider plane, vec3 x) { return x - plane.normalOffset.w * plane.normalOffset.xyz; }
void addPlaneForce(PlaneCollider plane, uint p, uint i, vec3 impulse, vec3 x) {
    addRowForce(p, i, impulse, planeArm(plane, x));
}
