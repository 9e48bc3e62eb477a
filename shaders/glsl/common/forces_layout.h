// The part of layout.h for sums of impulses (sim/forces/forces.hpp); only layout.h includes it.

// Impulses of a step: their sum [N s], and the sum of their moments [N m s].
struct ForceSum {
    vec4 impulse;
    vec4 torque;
};

// Kinds of forces on a body: contacts, planes, colliders, holds, grabs.
#define FORCE_CONTACTS 0
#define FORCE_PLANES 1
#define FORCE_COLLIDERS 2
#define FORCE_HOLDS 3
#define FORCE_GRABS 4
#define FORCE_KINDS 5

// Largest number of particles or elements that one invocation adds up.
#define FORCE_CHUNK 64

// Marks an element of a hold that is subtracted.
#define FORCE_SUBTRACTED 0x80000000u

// A run that one invocation adds up: particles of a body, or elements of a row.
struct ForceChunk {
    uint first, count;
    uint origin; // body: its first particle, about which moments are taken
    uint moment; // row: offset from an impulse to its moment [elements]; 0 = it has none
};

// Sums over a chunk of a body; moments are about its origin.
struct BodyForcePart {
    ForceSum sums[FORCE_KINDS];
    vec4 massMoment; // sum of mass x position relative to the origin [kg m], mass [kg]
    vec4 places;     // sum of positions relative to the origin [m], number of particles
};

// The chunks that add up to the sums of a body, or of a row.
struct ForceRange {
    uint firstPart, parts;
    uint origin; // same as in its chunks
    float sign;  // sign of a row
    uint firstStop, stops; // body: rows of its static faces
    uint stopOrigin;       // body: the particle about which moments of these rows are taken
    uint unused0;
};

// Colliders with a row of elements each. More are summed as ColliderForce.
#define MOST_COLLIDER_ROWS 8

// The impulses on one of many colliders: three components, then three of their moments, each a whole number of 64
// bits, low word first. Integers have the same sum in any order.
struct ColliderForce {
    uint words[12];
};

struct ColliderForcePush {
    uint count;     // colliders
    uint firstPart; // that of the first of them
    float unit;     // [N s], and [N m s]
};

struct ForcePush {
    uint count;
    uint grabs, planes, colliders; // numbers of rows
    uint firstRow; // element of the sums that holds the first row, after all bodies
};
