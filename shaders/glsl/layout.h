// Every struct and push constant that C++ and GLSL share, defined once. std430: scalars align to 4, vec4 to 16; a
// struct that mixes them lists its vec4 first. C++ sees them in sinew::sim::layout with equal sizes and strides.
#ifndef SINEW_LAYOUT_H
#define SINEW_LAYOUT_H

#ifdef __cplusplus
#include <cstdint>
namespace sinew::sim::layout {
using uint = std::uint32_t;
struct alignas(16) vec4 {
    float x, y, z, w;
};
#endif

// Work-group size of every kernel.
#define GROUP_ITEMS 128

// The one binding that need not follow on the one before it, for what a form of any kernel has in addition.
#define LAST_BINDING 31

// How many groups an indirect dispatch has, written by a kernel: VkDispatchIndirectCommand, padded to 16 bytes.
struct DispatchArguments {
    uint groupsX, groupsY, groupsZ; // 0 groups in x = nothing runs
    uint unused0;
};

// Written once per step, at the head of the command buffer.
struct StepParams {
    vec4 gravity;         // xyz [m/s^2]
    float h;              // substep length [s]
    float hPrevious;      // of the step before; 0 in the first step (half-kick)
    float thetaH;         // `split`: stored position = x + thetaH v [s]
    float thetaHPrevious; // of the step before
    float velocityFactor; // exp(-damping h)
    float restSpeed;      // impacts slower than this do not rebound: 2 |g| h [m/s]
    uint frame;
    float dampingShare; // `split`: h x damping coefficient of a link, at most this x k~ x the smaller tau of its ends
    float multiplierScale; // `gauss_seidel`: of the multipliers kept from the step before, min(1, (h / hPrevious)^2)
    float thetaHStored; // `split`: thetaH, or 0 where contacts follow the gather: it then stores x
    uint wakes; // 1 = the host wakes all that sleep
    uint lists; // bits of LISTS_...
};

#include "lists_layout.h"

// `split` keeps the links of a work group's particles together, slot by slot: link s of particle i is element
// (i / LINK_BLOCK * degree + s) * LINK_BLOCK + i % LINK_BLOCK. Slots of the whole scene behind one another would lie a power
// of two apart where the particle count is one, and evict each other from a CPU's cache.
#define LINK_BLOCK GROUP_ITEMS

// One of a particle's links, in the general form.
struct SplitLink {
    uint other;       // the particle at the far end; i itself in padding
    float restLength; // [m]
    float stiffness;  // [N/m]
    float share;      // k~, its weight among the links of a particle [N/m]
};

// The packed form, for regular bodies: a link is one word, its far end and a code. Its slot belongs to a group with
// one rest length, one unit of stiffness and one of shares: stiffness = (code + 1) x unit.
#define PACKED_END_BITS 24
#define PACKED_CODES 256
#define PACKED_GROUPS 4

// `split`: a bend as one of its three particles sees it.
struct SplitBend {
    uint a, b, c;     // in a row; all three the particle itself in padding
    float weight;     // of C = x_a - 2 x_b + x_c in its impulse: -1 for an end, 2 for the middle
    float stiffness;  // [N/m]
    float clamp;      // stiffness x h^2 at most [kg]
    uint unused0, unused1;
};

// `jacobi`: a bend, and what both ends and the middle really take of each new multiplier.
struct BendRow {
    uint a, b, c;
    float compliance; // [m/N]
    float share;
    uint sleeping;         // particles
    uint unused0, unused1;
};

// `gauss_seidel`: likewise.
struct ColoredBend {
    uint a, b, c;
    float compliance; // [m/N]
};

struct DrivenParticle {
    vec4 place; // in the frame of its body [m]
    uint particle;
    uint pose; // among those of a substep
    uint unused0, unused1;
};

struct DrivenPush {
    uint count;
    uint before, after; // first of the poses when the substep begins and when it ends
};

struct AttachedParticle {
    uint particle;
    float compliance; // [m/N]
    float maxForce;   // [N]
    uint unused0;
};

// A hand that may hold something, as the host has it in a step: where the point that it holds goes, and how.
#define GRAB_HANDS 8
struct GrabHand {
    vec4 from, to;         // of the held point when the step begins and ends [m]
    vec4 velocity;         // in between [m/s]
    uint serial;           // 0 = holds nothing; another one than in the step before = takes hold anew
    uint particle;         // around which it does
    float radius;          // of what it takes [m]
    float stiffness;       // what it does to all that is linked to what it holds: [1/s^2]
    float damping;         // [1/s]
    float maxAcceleration; // [m/s^2]
    uint unused0, unused1;
};

// Of a hand, between steps.
struct GrabState {
    uint serial;
    uint isNew; // 1 = lets go of what it held and takes hold of what the host says, in this step
    uint total; // of the shares of what it holds
    uint unused0;
};

// What a hand needs to know of a particle.
struct GrabBody {
    uint component; // by which the linked ones are named
    float part;     // of the mass of all that is linked; 0 = never moves
    float mass;     // of all that is linked [kg]
    uint slot;      // of the particle in the solver's state
};

// What holds a particle: GRAB_SHARE bits its share, above them the number of the hand + 1, or 0.
#define GRAB_SHARE_BITS 28
struct Grip {
    vec4 offset; // from the held point [m]
    uint held;
    uint unused0, unused1, unused2;
};

struct GrabPush {
    uint count;  // of particles
    uint groups; // of work groups for that many
    uint hands;
    float fraction; // of the step that is over when this substep is
    float lateKick; // part of h g that is in v and has not moved x
};

// A tethered particle's tethers: entries first .. first + count - 1 of the list of TetherReach.
struct TetheredParticle {
    uint particle, first, count;
};

struct TetherReach {
    uint anchor;
    float reach; // [m]
};

// `jacobi`, `gauss_seidel`: a distance constraint.
struct DistanceEdge {
    uint a, b;
    float restLength; // [m]
    float compliance; // [m/N]
};

// `jacobi`: the multiplier of a compliant constraint and the share of each new one that both ends really take.
struct DistanceMultiplier {
    float lambda; // [N s^2]
    float share;
};

// `gauss_seidel`: what the constraints of the open substep have moved a particle by, and what it touched.
struct ParticleCorrection {
    float x, y, z; // [m]
    uint touched;  // bit set of planes
};

// `gauss_seidel`: one of a particle's links in the warm start is the index of its constraint, with this bit set at the
// constraint's end a; in blocks like those of `split`.
#define WARM_LINK_SIGN 0x80000000u

// `jacobi`: which slots of the correction buffer belong to a particle.
struct Incidence {
    uint first, count;
    float weight; // over-relaxation x averaging weight
};

struct PlaneCollider {
    vec4 normalOffset;    // unit normal, offset [m]
    float friction;       // of what slides
    float restitution;
    float staticFriction; // of what does not, at least as much
    float unused0;
};

// A box grown by a radius, about its middle and along its own axes.
struct Collider {
    vec4 core;            // half extents, radius [m]
    float friction;       // of what slides
    float staticFriction; // of what does not, at least as much
    float restitution;
    uint isAbsent;        // 1 = a poke that is not there
};

struct ColliderPose {
    // Of the middle [m]. w: of the way of a poke, where from: how far it reached before the step [m]; where to: how often it
    // came, left or took another shape, below 0 while it is not there.
    vec4 position;
    vec4 rotation; // unit quaternion x, y, z, w from the collider's frame to the world
};

// `jacobi`: temporary constraints of a particle, found anew each substep.
struct PlaneContact {
    float vx, vy, vz; // velocity before the substep [m/s]
    uint touched;     // bit set of planes
};

// What a step found out about the state.
struct StatusWords {
    uint nonFinite;        // particles with a non-finite position or velocity
    uint invertedFirstBad; // ~index of the first of them
    uint frame;
    uint candidates;       // the most that a particle needs room for, where its list was too short; else 0
    uint slowed;           // particles slowed down by cap_speeds, in all substeps
    uint sleeping;         // particles
    uint laterLists;       // times that lists had to be made, or particles slowed down, in substeps after the first
    uint lacksLists;       // 1 = one of those was needed in a calm step, or in one before it that was not repeated
};

// A skin vertex in a lattice cell; corner k has the offset (k & 1, k >> 1 & 1, k >> 2).
struct CellVertex {
    vec4 weights; // xyz: local coordinates in the cell
    uint corners[8];
};

// Squared heights of triangles, by the squared place of a vertex, that some thirty steps of float32 make there: flatter ones may be
// turned over by rounding, and hardly count in normals.
#define NORMAL_BLUR 4e-12

struct SkinVertex {
    vec4 position; // xyz [m], w = 0 where nothing moves that carries the vertex, else 1
    vec4 normal;   // xyz unit length
};

// A skin vertex's triangles: entries first .. first + count - 1 of the triangle-of-vertex list.
struct VertexTriangles {
    uint first, count;
};

struct CountPush {
    uint count; // items; the last group may be partly idle
};

struct BoxesPush { // particles on grids that are equal, full and one behind another
    uint count;
    uint perBox;         // particles of a grid
    uint nodesX, nodesY; // of a grid
    uint origin;         // slot of the first particle
    uint rowStride, sliceStride, boxStride; // slots from a node to the next in y, in z, in the next grid
};

// Hash grid (hash_grid.glsl): the box around what is in it, as integers in the order of the floats they stand for, and the
// farthest that anything has moved since it was built.
struct GridBounds {
    uint lowX, lowY, lowZ, highX, highY, highZ; // keys
    uint moved;                                 // bits of a float [m]
    uint builds;                                // how often it was built since the simulation began
    // Of the substep that is watched: whether somebody moves so far that contacts may lie on the way, and how many are
    // listed as too fast for cells. plan_grid hands them on:
    uint sweeping, hurrying;
    uint isSwept, fast; // of the substep that is solved
    uint listed, listedParticles; // work groups in which an owner of a list, a particle, has a candidate
    uint lacking; // room that a step of this simulation has lacked (StatusWords::candidates), or 0: no later one may end either
    float drift;  // how far particles may still stray, together, from where their bodies are expected in this step [m]
    // Of the lists that were made last (pooled_lists): pairs that were found, also those that there was no room for; entries of all lists;
    // links of faces to entries.
    uint pairs, entries, links;
    uint lacksLists; // StatusWords::lacksLists of the last step
};

#include "frames_layout.h"

// Cells that one invocation sums up, and particles that one measures.
#define GRID_CHUNK 64

// Indices into the arguments of its passes: one item a particle, a chunk of particles, a chunk of cells, one group; one a
// particle where more are too fast than there is room for, where contacts may lie on the way, where they do not.
#define GRID_PARTICLES 0
#define GRID_PARTICLE_CHUNKS 1
#define GRID_CELL_CHUNKS 2
#define GRID_ONE_GROUP 3
#define GRID_OTHERS 4 // only where there are others
#define GRID_SLOWED 5
#define GRID_SWEPT 6
#define GRID_UNSWEPT 7
#define GRID_ARGUMENTS 8

// Particles too fast for cells, at most; where there are more, all of them are slowed down.
#define MOST_FAST 256

struct GridPush {
    uint count;  // of particles; whole work groups
    uint cells;  // a power of two
    float edge;  // of a cell, at least [m]
    float most;  // radius in the grid [m]; particles with more are searched one by one
    uint others; // items of further passes that run with a build; 0 = none
    float quiet; // way in a substep up to which nobody meets anybody on it [m]
    uint bodies; // with a frame
    float reach, margin; // as in FramePush
    uint isLater; // 1 = in a substep after the first
};

// Element of a list, which stands in one piece in the pool of all lists (ListRange).
struct ContactCandidate {
    uint other;
    float reach; // distance below which they touch [m]
};

struct FindPush {
    uint count, cells;
    float edge, most;
    float margin;  // beyond touching, up to which a pair is listed [m]
    uint room;     // entries of the pool, of all lists together
    uint large;    // particles that are searched one by one
    float quiet;   // as in GridPush
};

struct ContactPush {
    uint count; // of particles; whole work groups
    float friction, staticFriction; // as a pair of surfaces has them
    float restitution;
    float recoverySpeed; // of pairs that overlapped when the scene was loaded [m/s]
    uint surfaces;       // where there are several: pair (a, b) of them is element a * surfaces + b of a table
};

// A particle of bodies that lie in each other when the scene is loaded. Where it is a node of a lattice: the slots before and
// after it along the three axes, its own where there is none.
struct InterlockNode {
    uint before[3], after[3];
    uint body; // from 1 on; 0 = of none of these bodies
    uint unused0;
};

// The depth of a node from which no way leads out, and of what is no node.
#define INTERLOCK_DEEPEST 1e30f

// What becomes of two such bodies: they part along their lattices' normals, have just done so, touch like any others.
#define INTERLOCK_APART 0
#define INTERLOCK_PARTING 1
#define INTERLOCK_LEFT 2
#define INTERLOCK_SHALLOW 0.05 // of the reach of a contact: a tenth of a radius

struct InterlockPair {
    uint state;
    uint deepest; // overlap in this step by the reach of the contact, bits of a float; 0 = nobody awake looked
};

struct InterlockPush {
    uint count; // of particles; whole work groups
    float recoverySpeed; // [m/s]
    uint pairs; // of bodies
};

// What two surfaces make of a contact.
struct SurfacePair {
    float friction;       // of what slides
    float restitution;
    float staticFriction; // of what does not, at least as much
};

// A triangle between particles that others touch.
struct ContactFace {
    uint a, b, c;
    float thickness; // [m]; below 0 where the front of something solid is the other side
};
#define EXCLUDED_LINKED 0x80000000u // in the last word of a row of points that a face never touches, beside where strides stand

// Of all particles that may touch faces: those too wide or too fast for the grid are listed apart. Of all faces: those with
// too much around them are listed as wide. Some devices end a kernel's loops silently at 65,535 turns in all.
struct FacePoints {
    uint apart;  // how many points
    uint widest; // radius and way in a substep of the others, at most; bits of a float [m]
    uint wide;   // how many faces
    uint unused0;
};

// Entries that a list may have: some devices end a kernel's loops silently at 65,535 turns in all. A list that is longer ends a step as one
// without room does, and so do more entries on average than there can be room for.
#define LIST_MOST 2048u
#define CONTACT_MOST_ROOM 1024u

// Where a list stands in the pool of some lists; a uvec2 in kernels.
struct ListRange {
    uint first, count;
};

#define FACE_MOST_POINTS 20000 // that a face looks at itself
#define FACE_MOST_WIDE 50000   // faces that a point looks at itself

struct FaceFindPush {
    uint points, searched; // particles; small faces; whole work groups
    uint cells;            // of the grid
    float edge;
    float most;    // radius and way of a point that the grid is searched for [m]
    float margin;  // beyond touching, up to which a pair is listed [m]
    uint room;     // entries of the pool, of all lists together
    uint moving;   // faces before that one have a corner that moves
    uint large;    // faces that every point is compared with, beside wide ones
};

// An edge of faces that other edges touch. In the grid it is its middle.
struct ContactEdge {
    uint a, b;
    uint isMoving; // 1 = one of its ends may move
    float radius;  // of the ball around its middle that holds all of it; below 0 in padding [m]
};

struct PlaceEdgesPush { uint items, edges, members; }; // the larger, whole work groups; edges; ends that are watched

struct FacePush {
    uint count;   // of particles, or edges; whole work groups
    uint surfaces; // pair (a, b) of them is element a * surfaces + b of a table
    float recoverySpeed; // of what overlapped when the scene was loaded [m/s]
    uint moving; // faces before that one have a corner that moves; of edges nothing
    uint sheets; // of those, faces before that one have two sides, the others are the surface of something solid
};

struct StopPush {
    uint count; // of points that move
    uint moving, faces; // faces from the first to before the second have no corner that gives way
};

struct SubstepPush {
    uint count;
    uint isFirst; // 1 in the first substep of a step
};

struct PackedSubstepPush {
    uint count;
    uint isFirst;
    float restLengths[PACKED_GROUPS]; // [m]
    float units[PACKED_GROUPS];       // of stiffness [N/m]
    float shares[PACKED_GROUPS];      // of shares [N/m]
};

// Bodies on a regular grid: the invocations of a work group that march, as well the slots of a run where an invocation
// computes one node; and one unit in the fill of a cell.
#define LATTICE_GROUP 32
#define LATTICE_FULL 15

// The part of its volume below which a cell is unfolded, with all pressure from 0 on.
#define RECOVERY_START 0.5

// A run of slices of a block of columns, which one invocation marches; or a run of slots, each the node of an invocation.
struct LatticeChunk {
    uint origin; // slot of its first node
    uint layers; // 0 = nothing to do; of a run of slots, their number
};

// Kinds of link: along an edge, a face diagonal, a body diagonal.
struct LatticePush {
    uint count;
    uint isFirst;
    uint rowStride, sliceStride; // slots from a node to the next in y, in z
    float restLengths[3];        // [m]
    float units[3];              // stiffness for each 1/15 of a cell's fill [N/m]
    float shares[3];             // k~ likewise
    uint substeps, bodySlots, bodyChunks; // RESIDENT: all substeps of a step at once; count = bodies x group size
    float volumeUnit;            // lambda_v a for each 1/15 of a cell's fill [N/m]
    float volumeShare;           // 2 k~ likewise
    float recoveryUnit;          // pressure x a likewise
    float recoveryShare;         // 2 k~ likewise
};

#include "cut_layout.h"

struct DampedSubstepPush {
    uint count;
    uint isFirst;
    float dampingTime; // damping coefficient over stiffness [s]
};

struct AttachmentPush {
    uint count;
    float fraction; // of the step that is over when this substep is
};

struct ColliderPush {
    uint count;         // of particles; whole work groups
    uint before, after; // first pose of the colliders when the substep begins, and when it ends
    float lateKick;     // part of h g that is in v and has not moved x
};

// Indices into the arguments of passes that only pokes need.
#define POKES_PLACED 0
#define POKES_TOUCHING 1 // once a substep
#define POKE_ARGUMENTS 2

struct PlacePush {
    uint count; // colliders x (substeps + 1)
    uint colliders, substeps;
};

// What rests for so long, no faster than that, sleeps (contacts: 6).
#define SLEEP_TIME 0.5   // [s]
#define SLEEP_SPEED 0.03 // [m/s]
#define SLEEP_MOST_SPEED 0.1 // [m/s], of large particles (watch_rest)
#define SLEEP_DRIVEN -1.0f // stands for the inverse mass of what is driven

// Indices into the arguments of waking and falling asleep: all particles, or one group, when a step begins, in a substep,
// and after a step that came to its end; one group after any step in which somebody was awake.
#define SLEEP_OPENING 0
#define SLEEP_OPENING_ONE 1
#define SLEEP_WAKING 2
#define SLEEP_WAKING_ONE 3
#define SLEEP_RESTING 4
#define SLEEP_CLOSING_ONE 5
#define SLEEP_ARGUMENTS 6

// What of the passes of a step runs while not everybody sleeps: how many groups it has in all, and which of them.
#define SLEEP_ALL 0    // all, while anybody is awake
#define SLEEP_LISTED 1 // those of particles of which one is awake
#define SLEEP_MIXED 2  // likewise, while anybody sleeps
#define SLEEP_MIXED_ALL 3
struct SleepPass {
    uint groups, kind;
};

struct SleepState {
    vec4 gravity;  // of the last step that came to its end [m/s^2]
    float h;       // likewise [s]
    uint sleeping; // particles, at the end of the last step
    uint listed;   // groups that the next substep runs
    uint isMixed;  // 1 = somebody is awake, somebody sleeps
    uint wakes;    // 1 = all, as soon as a step comes to its end
    uint touched;  // 1 = somebody awake has come to touch somebody asleep
    uint wakesAll; // 1 = in this step
    uint unused0;
};

struct SleepPush {
    uint count;  // of particles; whole work groups
    uint groups; // of them
    uint attachments, colliders;
    uint driven;   // so many of the colliders, the last, are balls around driven bodies
    uint passes;   // entries of the list of SleepPass
    uint substeps; // of a step
};

struct DampedIterationPush {
    uint count;
    uint firstSlot;
    uint isFirst;
    float dampingTime; // [s]
};

struct IterationPush {
    uint count;
    uint firstSlot; // of this constraint type in the correction buffer
    uint isFirst;   // 1 in the first iteration of a substep
};

struct ColorPush {
    uint count;      // constraints of the color, padded to whole work groups
    uint first;      // of them in the list
    uint isOpening;  // 1 in the first sweep of a step
    uint isClosing;  // 1 in the last sweep of a substep
    float warmStart; // share of a multiplier that the next substep starts with
};

struct BendColorPush {
    uint count;   // bends of the color, padded to whole work groups
    uint first;   // of them in the list
    uint isFirst; // 1 in the first sweep of a substep
};

struct DampColorPush {
    uint count;        // constraints of the color, padded to whole work groups
    uint first;        // of them in the list
    float dampingTime; // damping coefficient over stiffness [s]
};

#include "forces_layout.h"

struct SkinPush {
    uint count;
    uint firstVertex; // of this skin in the vertex buffer
};

#ifdef __cplusplus
} // namespace sinew::sim::layout
#endif
#endif
