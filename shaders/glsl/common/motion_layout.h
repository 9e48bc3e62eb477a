// The part of layout.h for motions that the host sets; only layout.h includes it.

#define MOST_MOTIONS 64 // ranges::mostMotions
#define MOTION_NONE 0
#define MOTION_ADD_VELOCITY 1
#define MOTION_SET_VELOCITY 2
#define MOTION_IMPULSE 3
#define MOTION_POSE 4
#define MOTION_ALL_BODIES 0xffffffffu
#define MOTION_NO_BODY 0xfffffffeu // of a particle in none of Scene::bodies

// A motion of a step, from the host (Motion).
struct MotionRequest {
    vec4 linear;     // xyz [m/s], [N s] or [m]; w: radius of the region [m], 0 = everywhere
    vec4 angular;    // xyz [rad/s] or [N m s]
    vec4 center;     // xyz: of the region [m]
    vec4 rotation;   // quaternion of a pose, of unit length
    uint kind;       // MOTION_...
    uint body;       // index into Scene::bodies, or MOTION_ALL_BODIES
    uint first, end; // slots between which its particles are
    uint origin;     // slot of one of them
    uint unused0, unused1, unused2;
};

// Sums over the particles that a motion acts on; d: position relative to that of the slot `origin`.
struct MotionSums {
    vec4 first;    // mass x d; w: mass [kg]
    vec4 diagonal; // mass x squares of the components of d
    vec4 mixed;    // mass x d.yzx x d.zxy
};
#define MOTION_CHUNKS 16 // sums of a motion, one for each work group that measures it

// A motion, resolved: velocity of the centre of mass and about it, or displacement of it.
struct MotionFrame {
    vec4 origin; // position of the slot `origin` [m]
    vec4 center; // of mass, relative to `origin` [m]
    vec4 linear, angular;
};

// Indices into the arguments of the passes of motions: poses, then velocities.
#define MOTIONS_MEASURED 0  // MOTION_CHUNKS groups for each
#define MOTIONS_RESOLVED 1  // one group
#define MOTIONS_APPLIED 2   // slots
#define MOTION_VELOCITIES 3 // first of those for velocities
#define MOTIONS_FORGOTTEN 6 // one group for each GROUP_ITEMS owners of contact lists: poses alone
#define MOTION_LISTS 3      // lists of pairs, of faces, of edges
#define MOTIONS_PREVIOUS 9  // particles: poses alone
#define MOTION_ARGUMENTS 10

struct MotionPush {
    uint count;    // slots; particles; owners of lists
    uint motions;  // capacity
    uint isPose;   // 1 = of poses, 0 = of velocities
    uint bodies;   // in the scene
    uint halfKick; // 1 = velocities are half a substep behind positions (`split`)
};
