// The part of layout.h for colliders; only layout.h includes it.

// A box grown by a radius, centred at its pose and along its own axes.
struct Collider {
    vec4 core;            // half extents, radius [m]
    float friction;       // kinetic
    float staticFriction; // at least `friction`
    float restitution;
    uint isAbsent;        // 1 = an absent kinematic collider
};

// Colliders that every particle tests. Of more it tests those near its work group (near_colliders.glsl).
#define FEW_COLLIDERS 2
// Kinematic colliders of the host, colliders and driven bodies (sinew/ranges.hpp).
#define MOST_MOVERS 2112
// Words of the record of a work group before the bits of near colliders.
#define NEAR_HEAD 8

struct ColliderPose {
    // Centre [m]. w: for a kinematic collider, at the start of the step: its extent before the step [m]; at
    // the end: number of times that it appeared, disappeared or changed shape, below 0 while absent.
    vec4 position;
    vec4 rotation; // unit quaternion x, y, z, w from the collider's frame to the world
};

struct ColliderPush {
    uint count;         // number of particles; whole work groups
    uint before, after; // first pose of the colliders at the start of the substep, and at its end
    float lateKick;     // part of h g that is in v and has not moved x
    float forceScale;   // 1 / unit of ColliderForce [1 / N s]
};

// Indices into the arguments of passes for kinematic colliders.
#define HOST_COLLIDERS_PLACED 0
#define HOST_COLLIDERS_TOUCHING 1 // once a substep
#define HOST_COLLIDER_ARGUMENTS 2

struct NearPush {
    uint count;    // number of particles; whole work groups
    uint last;     // first pose of the colliders at the end of the step
    uint substeps; // of a step
    float reach;   // beyond the contact offset, up to which contacts are events [m]
};

struct PlacePush {
    uint count; // colliders x (substeps + 1)
    uint colliders, substeps;
};
