// The part of layout.h for motions that the host sets; only layout.h includes it.

#define MOST_MOTIONS 64 // ranges::mostMotions
#define MOTION_NONE 0
#define MOTION_ADD_VELOCITY 1
#define MOTION_SET_VELOCITY 2
#define MOTION_IMPULSE 3
#define MOTION_POSE 4 // this and larger ones place a body
#define MOTION_SPAWN 5
#define MOTION_DESPAWN 6
#define MOTION_ALL_BODIES 0xffffffffu
#define MOTION_NO_BODY 0xfffffffeu // of a particle in none of Scene::bodies

// A motion of a step, from the host (Motion).
struct MotionRequest {
    vec4 linear;     // xyz [m/s], [N s] or [m]; w: radius of the region [m], 0 = everywhere
    vec4 angular;    // xyz [rad/s] or [N m s]
    vec4 center;     // xyz: of the region, or of the mass of a spawned body in the scene [m]
    vec4 rotation;   // quaternion of a pose or spawn, of unit length
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

// A change of a body that may be absent (Body::isAbsent); from POOL_SPAWNED on it is spawned by motion
// change - POOL_SPAWNED.
#define POOL_SAME 0
#define POOL_LEFT 1    // it is absent, and the tables do not say so: at first, and after an undone step
#define POOL_RETURNED 2 // it is there, and the tables do not say so
#define POOL_GONE 3    // despawned
#define POOL_SPAWNED 4

// Such a body.
struct PoolBody {
    uint body;   // index into Scene::bodies
    uint origin; // slot of one of its particles
};

// A particle of such a body.
struct PoolParticle {
    vec4 rest; // its place in the scene [m]; w: inverse mass [1/kg]
    uint slot, particle, body;
    float time; // w of its stored position [s^2]
};

// Steps that a body begins absent until passes leave it out: two have then written its place into all buffers.
#define POOL_SKIPPED 3
// In place of the number of a body that may be absent: of what is always there, and of slots without a particle.
#define POOL_STAYS 0xffffffffu
#define POOL_PADDING 0xfffffffeu

// Indices into the arguments of the passes over such bodies. POOL_SLOTS and POOL_LISTS run in a step in which one begins
// or ends to be left out.
#define POOL_PARTICLES 0
#define POOL_EDGES 1 // POOL_EDGE_GROUPS groups
#define POOL_SLOTS 2
#define POOL_LISTS 3 // one group
#define POOL_ALWAYS 4 // one group, also while everything sleeps
#define POOL_EDGE_GROUPS 32
#define POOL_ARGUMENTS 5

struct PoolPush {
    uint count;   // items of the pass
    uint bodies;  // that may be absent
    uint motions; // capacity
    uint all;     // bodies in the scene
    uint slots;   // of the state
};

struct PoolListPush {
    uint count;    // entries
    uint perGroup; // of the dispatch that they are for
    uint end;      // entry at which a reversed one begins, backwards
};
