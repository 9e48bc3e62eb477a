// The part of layout.h, which alone includes it, that is about the sums of impulses (sim/forces.hpp).

// Impulses of a step (sim/forces.hpp): their sum [N s], and that of their moments [N m s].
struct ForceSum {
    vec4 impulse;
    vec4 torque;
};

// Kinds of forces on a body: contacts, planes, colliders, holds, hands.
#define FORCE_CONTACTS 0
#define FORCE_PLANES 1
#define FORCE_COLLIDERS 2
#define FORCE_HOLDS 3
#define FORCE_GRABS 4
#define FORCE_KINDS 5

// Particles or elements that one invocation adds up, at most.
#define FORCE_CHUNK 64

// Marks an element of a hold that counts negative.
#define FORCE_SUBTRACTED 0x80000000u

// A run that one invocation adds up: particles of a body, or elements of a row.
struct ForceChunk {
    uint first, count;
    uint origin; // of a body: its first particle, about which moments are taken
    uint moment; // of a row: how many elements behind an impulse its moment stands; 0 = it has none
};

// Sums over a chunk of a body; moments are about its origin.
struct BodyForcePart {
    ForceSum sums[FORCE_KINDS];
    vec4 massMoment; // sum of mass x place from the origin, mass [kg m], [kg]
    vec4 places;     // sum of places from the origin, number of particles
};

// How the chunks of a body, or of a row, become its sums.
struct ForceRange {
    uint firstPart, parts;
    uint origin; // as of its chunks
    float sign;  // of a row
    uint firstStop, stops; // of a body: rows of what its faces that never move give
    uint stopOrigin;       // of a body: the particle about which moments of these are taken
    uint unused0;
};

struct ForcePush {
    uint count;
    uint grabs, planes, colliders; // rows
    uint firstRow; // element of the sums that has the first row, behind all bodies
};
