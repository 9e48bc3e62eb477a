// The part of layout.h for force fields; only layout.h includes it.

#define MOST_FIELDS 16 // ranges::mostFields
#define FIELD_NONE 0
#define FIELD_UNIFORM 1
#define FIELD_RADIAL 2
#define FIELD_WIND 3
#define FIELD_TURBULENCE 4
#define FIELD_ALL_BODIES 0xffffffffu
#define FIELD_NO_BODY 0xfffffffeu // of a particle in none of Scene::bodies

// A force field of a step, from the host (ForceField).
struct FieldRequest {
    vec4 vector; // xyz: acceleration [m/s^2], or velocity of the air [m/s]; w: ForceField::strength
    vec4 center; // xyz [m]; w: radius of the region [m], 0 = everywhere
    uint kind;   // FIELD_...
    uint body;   // index into Scene::bodies, or FIELD_ALL_BODIES
    float scale; // of turbulence [m]
    uint unused0;
};

// A corner of a triangle at the surface of a body on a grid: the particles of the triangle, its own first.
struct FieldCorner {
    uint particles[3];
    float farthest; // squared length of an edge beyond which the triangle is torn and has no area [m^2]
};

// The corners of a particle: elements of their list, which follow each other.
struct FieldCorners {
    uint first;
    uint count; // with FIELD_CLOSED if the surface encloses the body, so that only its windward side counts
};
#define FIELD_CLOSED 0x80000000u

// Indices into the arguments of the passes of fields: a wind needs both.
#define FIELDS_AREAS 0 // once a step
#define FIELDS_APPLIED 1
#define FIELD_ARGUMENTS 2

struct FieldPush {
    uint count;   // corners; slots in apply_fields
    uint fields;  // capacity
    uint isFirst; // first substep of a step of `split`
    float lateKick; // part of h that the kick of the substep does not move particles for (`jacobi`: 0.5)
};
