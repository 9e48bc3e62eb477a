// Every struct and push constant shared by C++ and GLSL, defined once. std430: scalars align to 4, vec4 to 16; a
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

#define GROUP_ITEMS 128 // work-group size of every kernel
#include "common/bindings.h"

// Group count of an indirect dispatch, written by a kernel: VkDispatchIndirectCommand, padded to 16 bytes.
struct DispatchArguments {
    uint groupsX, groupsY, groupsZ; // 0 groups in x = nothing runs
    uint unused0;
};

// Written once per step, at the head of the command buffer.
struct StepParams {
    vec4 gravity;         // xyz [m/s^2]; w: key of the force fields (fields.hpp)
    float h;              // substep length [s]
    float hPrevious;      // substep length of the previous step; 0 in the first step (half-kick)
    float thetaH;         // `split`: stored position = x + thetaH v [s]
    float thetaHPrevious; // thetaH of the previous step
    float velocityFactor; // exp(-damping h)
    float restSpeed;      // impacts slower than this do not rebound: 2 |g| h [m/s]
    uint frame;
    float dampingShare; // `split`: h x damping coefficient of a link, at most this x k~ x the smaller tau of its ends
    float multiplierScale; // `gauss_seidel`: scale of the multipliers kept from the step before, min(1, (h / hPrevious)^2)
    float thetaHStored; // `split`: thetaH, or 0 where contacts follow the gather: it then stores x
    uint wakes, lists; // WAKES_..., bits of LISTS_...
    float longestH, unused0, unused1, unused2; // `split`: H, for which links are clamped [s]: at least h and hPrevious
};

#include "common/lists_layout.h"

// `split` keeps the links of a work group's particles together, slot by slot: link s of particle i is element (i /
// LINK_BLOCK * degree + s) * LINK_BLOCK + i % LINK_BLOCK. If each slot held the links of all particles of the scene,
// slots would lie a power of two apart where the particle count is one, and evict each other from a CPU's cache.
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

// `split`: a bend, as seen by one of its three particles.
struct SplitBend {
    uint a, b, c;     // in a row; all three the particle itself in padding
    float weight;     // factor of C = x_a - 2 x_b + x_c in its impulse: -1 for an end, 2 for the middle
    float stiffness;  // [N/m]
    float clamp;      // stiffness x h^2 at most [kg]
    uint unused0, unused1;
};

// `jacobi`: a bend, and the share of each new multiplier that its ends and its middle take.
struct BendRow {
    uint a, b, c;
    float compliance; // [m/N]
    float share;
    uint sleeping;         // number of sleeping particles
    uint unused0, unused1;
};

// `gauss_seidel`: a bend.
struct ColoredBend {
    uint a, b, c;
    float compliance; // [m/N]
};

struct DrivenParticle {
    vec4 place; // in the frame of its body [m]
    uint particle;
    uint pose; // index among the poses of a substep
    uint unused0, unused1;
};

struct DrivenPush {
    uint count;
    uint before, after; // first pose at the start of the substep, and at its end
};

struct AttachedParticle {
    uint particle;
    float compliance; // [m/N]
    float maxForce;   // [N]
    uint unused0;
};

// A grab, as the host sets it for a step: the motion of the held point, and the properties of the hold.
#define MOST_GRABS 8
struct GrabRequest {
    vec4 from, to;         // held point at the start and at the end of the step [m]
    vec4 velocity;         // velocity of the held point [m/s]
    uint serial;           // 0 = holds nothing; a value that differs from that of the step before starts a new grab
    uint particle;         // at the centre of the grab
    float radius;          // radius of the grabbed region [m]
    float stiffness;       // per mass of all particles linked to the held ones [1/s^2]
    float damping;         // [1/s]
    float maxAcceleration; // [m/s^2]
    uint unused0, unused1;
};

// State of a grab between steps.
struct GrabState {
    uint serial;
    uint isNew; // 1 = ends the grab of the step before and starts the one set by the host, in this step
    uint total; // sum of the shares of held particles
    uint unused0;
};

// The values of a particle that grabs use.
struct GrabBody {
    uint component; // identifies the particles linked to it
    float part;     // share of the mass of its component; 0 = never moves
    float mass;     // mass of its component [kg]
    uint slot;      // slot of the particle in the solver's state
};

// The grab that holds a particle: GRAB_SHARE_BITS bits of its share, above them the index of the grab + 1, or 0.
#define GRAB_SHARE_BITS 28
struct Grip {
    vec4 offset; // from the held point [m]
    uint held;
    uint unused0, unused1, unused2;
};

struct GrabPush {
    uint count;  // number of particles
    uint groups; // work groups for that many particles
    uint grabs;
    float fraction; // part of the step that is over at the end of this substep
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

// `jacobi`: the multiplier of a compliant constraint, and the share of each new one that both ends take.
struct DistanceMultiplier {
    float lambda; // [N s^2]
    float share;
};

// `gauss_seidel`: displacement of a particle by the constraints of the open substep, and the planes that it touched.
struct ParticleCorrection {
    float x, y, z; // [m]
    uint touched;  // bit set of planes
};

// `gauss_seidel`: one of a particle's links in the warm start is the index of its constraint, with this bit set at
// the constraint's end a; in blocks like those of `split`.
#define WARM_LINK_SIGN 0x80000000u

// `jacobi`: the slots of the correction buffer that belong to a particle.
struct Incidence {
    uint first, count;
    float weight; // over-relaxation x averaging weight
};

#define MOST_PLANES 32
struct PlaneCollider {
    vec4 normalOffset;    // unit normal, offset [m]
    float friction;       // kinetic
    float restitution;
    float staticFriction; // at least `friction`
    float unused0;
};

// `jacobi`: contacts of a particle with planes, found in each substep.
struct PlaneContact {
    float vx, vy, vz; // velocity before the substep [m/s]
    uint touched;     // bit set of planes
};

// Results of a step: faults of the state, overflow, and counts.
struct StatusWords {
    uint nonFinite;        // particles with a non-finite position or velocity
    uint invertedFirstBad; // ~index of the first of them
    uint frame;
    uint candidates;       // entries per particle that contacts would need, if they do not fit; else 0
    uint slowed;           // particles slowed down by clamp_speeds, in all substeps
    uint sleeping;         // number of sleeping particles
    uint laterLists;       // times that lists had to be rebuilt, or particles slowed down, in substeps after the first
    uint lacksLists;       // 1 = one of those was needed in a calm step, or in one before it that was not repeated
};

// A skin vertex in a lattice cell; corner k has the offset (k & 1, k >> 1 & 1, k >> 2).
struct CellVertex {
    vec4 weights; // xyz: local coordinates in the cell
    uint corners[8];
};

// Squared height of a triangle, over the squared distance of the vertex from the origin, that about thirty roundings
// of float32 can produce: flatter triangles may be flipped by rounding, and hardly count in normals.
#define NORMAL_BLUR 4e-12

struct SkinVertex {
    vec4 position; // xyz [m], w = 0 if none of the particles that carry the vertex can move, else 1
    vec4 normal;   // xyz unit length; w = 1 on the front of a cut, where its two sides meet and there is no normal, else 0
};

// A skin vertex's triangles: entries first .. first + count - 1 of the triangle-of-vertex list.
struct VertexTriangles {
    uint first, count;
};

struct CountPush {
    uint count; // items; the last group may be partly idle
};

struct BoxesPush { // particles on equal, full grids, stored one after another
    uint count;
    uint perBox;         // particles per grid
    uint nodesX, nodesY; // numbers of nodes of a grid
    uint origin;         // slot of the first particle
    uint rowStride, sliceStride, boxStride; // slots from a node to the next in y, in z, to that in the next grid
};

// Hash grid (hash_grid.glsl): the box around its particles, as integers in the order of the floats that they
// represent, and the largest displacement since it was built.
struct GridBounds {
    uint lowX, lowY, lowZ, highX, highY, highZ; // keys
    uint moved;                                 // bits of a float [m]
    uint builds;                                // number of builds since the simulation began
    // Results for the next substep: 1 if particles move so far that contacts may lie on their paths, the number of such
    // particles of the grid, and of those too fast for cells. plan_grid moves them to:
    uint sweeping, sweepers, hurrying;
    uint isSwept, fast; // the first for the substep that is solved, and the number of particles to be searched one by one
    uint listed, listedParticles; // owners of a list with a candidate; work groups with a particle that has one
    uint lacking; // StatusWords::candidates of a step of this simulation that lacked capacity, else 0: no later step may finish either
    float drift;  // distance that particles may still stray, in sum, from their expected positions in this step [m]
    // The newest lists (pooled_lists): number of pairs found, including those that did not fit; entries of all
    // lists; links from faces to entries.
    uint pairs, entries, links;
    uint owners, linked; // of rows: owners of the pairs that were found, and others that have links
    uint lacksLists; // StatusWords::lacksLists of the last step
    float edge;      // smallest size of a cell in the grid that was built last [m]
    uint drivenWay;  // bits of the largest radius and way of a driven particle too fast for such cells (clamp_speeds) [m]
    // Time since lists were made, at the end of the substep that is checked next, and at its start; at most `horizon` [s].
    float age, ageBefore, horizon;
    float lasted; // `age` when the lists before these were given up [s]
    float substep; // length of the substep in which lists were made, for which headings are limited [s]
    float aheadShare; // share of GridPush::ahead that the next lists use, less 1
};

#include "common/frames_layout.h"

// Cells that one invocation adds up, and particles that one invocation measures.
#define GRID_CHUNK 64

// Indices into the arguments of its passes: one item per particle, per chunk of particles, per chunk of cells, one
// group; then one item per particle if too many are fast, if contacts may lie on paths, if none can.
#define GRID_PARTICLES 0
#define GRID_PARTICLE_CHUNKS 1
#define GRID_CELL_CHUNKS 2
#define GRID_ONE_GROUP 3
#define GRID_OTHERS 4 // only if GridPush::others is not 0
#define GRID_SLOWED 5
#define GRID_SWEPT 6
#define GRID_UNSWEPT 7
#define GRID_PATCHES 8 // of sheets
#define GRID_ARGUMENTS 9

// Indices into the arguments of the passes that make lists of rows, as many as there is work.
#define MAKING_FACES 0 // faces that search for points, in pairs
#define MAKING_OWNERS 1 // owners of pairs that were found
#define MAKING_LINKS 2  // others that have links
#define MAKING_ARGUMENTS 3

// Largest number of particles too fast for cells; if there are more, all of them are slowed down.
#define MOST_FAST 256
// Up to so many particles on whose path contacts may lie are searched one by one; if there are more, all are, in wide cells.
#define MOST_SWEEPERS 32

struct GridPush {
    uint count;  // number of particles; whole work groups
    uint items;  // the same of those that are visited
    uint cells;  // a power of two
    float edge;  // smallest size of a cell in a substep in which contacts may lie on paths [m]
    float quietEdge; // the same in other substeps [m]
    float most;  // largest radius in the grid [m]; larger particles are searched one by one
    uint others; // items of further passes that run with a build; 0 = none
    float quiet; // motion in a substep up to which no contact can lie on a path [m]
    uint bodies; // bodies with a frame
    float reach, margin; // see FramePush
    float ahead;  // substeps for which particles are expected to follow their headings; 0 = they have none
    float pace;   // largest heading, as a distance in a substep [m]
    float leeway; // most that a particle may stray beyond what all may [m]
    uint isLater; // 1 = in a substep after the first
    uint loose, patches; // faces that search whenever lists are made, in pairs; patches of sheets
};

// Element of a contact list, which is a contiguous range of the pool of all lists (ListRange).
struct ContactCandidate {
    uint other;
    float reach; // distance below which they touch [m]
};

struct FindPush {
    uint count, cells;
    float most;    // largest radius in the grid [m]
    float margin;  // distance beyond the reach up to which a pair is listed [m]
    uint room;     // capacity of the pool, in entries of all lists together
    uint large;    // particles that are searched one by one
    float quiet;   // see GridPush
};

struct ContactPush {
    uint count; // number of particles; whole work groups
    float friction, staticFriction; // coefficients of the pair of surfaces, if there is only one
    float restitution;
    float recoverySpeed; // recovery speed of pairs that overlapped when the scene was loaded [m/s]
    uint surfaces;       // number of surfaces, if there are several: pair (a, b) is element a * surfaces + b of a table
};

// A particle of bodies that overlap each other when the scene is loaded. If it is a lattice node: the slots before
// and after it along the three axes, its own slot where there is no node.
struct InterlockNode {
    uint before[3], after[3];
    uint body; // from 1 on; 0 = in none of these bodies
    uint unused0;
};

// Depth of a node that no path leads out from, and of particles that are no nodes.
#define INTERLOCK_DEEPEST 1e30f

// State of a pair of such bodies: ordinary contacts; separating along their lattices' normals; has just separated.
#define INTERLOCK_APART 0
#define INTERLOCK_PARTING 1
#define INTERLOCK_LEFT 2
#define INTERLOCK_SHALLOW 0.05 // share of the reach of a contact: a tenth of a radius

struct InterlockPair {
    uint state;
    uint deepest; // overlap in this step over the reach of the contact, bits of a float; 0 = no awake particle tested it
};

struct InterlockPush {
    uint count; // number of particles; whole work groups
    float recoverySpeed; // [m/s]
    uint pairs; // pairs of bodies
};

// Coefficients of a contact between two surfaces.
struct SurfacePair {
    float friction;       // kinetic
    float restitution;
    float staticFriction; // at least `friction`
};

// A triangle between particles that takes part in contacts.
struct ContactFace {
    uint a, b, c;
    float thickness; // [m]; below 0 = the front of a closed body is opposite to the normal
};
#define EXCLUDED_LINKED 0x80000000u // flag in the last word of a face's row of excluded points, beside the index of the strides

// Largest number of entries of a list: some devices silently end a kernel's loops at 65,535 iterations in all. A
// longer list ends a step like a lack of capacity, and so do more entries per particle than CONTACT_MOST_ROOM.
#define LIST_MOST 2048u
#define CONTACT_MOST_ROOM 1024u

// Range of a list in the pool of its lists; a uvec2 in kernels.
struct ListRange {
    uint first, count;
};

#define FACE_MOST_POINTS 20000 // largest number of points that a face tests itself
#define FACE_MOST_WIDE 50000   // largest number of faces that a point tests itself

struct FaceFindPush {
    uint points, searched; // particles; pairs of small faces; in whole work groups
    uint cells;            // cells of the grid
    float most;    // largest radius + motion of a point in the grid, in a substep or along its heading [m]
    float margin;  // distance beyond the reach up to which a pair is listed [m]
    uint room;     // capacity of the pool, in entries of all lists together
    uint moving;   // faces below this index have a corner that moves
    uint large;    // number of faces that every point is tested with, besides wide ones
    uint loose;    // pairs of small faces that are in no patch; those of patches follow
};

#include "common/patch_layout.h"
#include "common/recoils_layout.h"
// An edge of faces that takes part in contacts with other edges. The grid holds its midpoint.
struct ContactEdge {
    uint a, b;
    uint isMoving; // 1 = one of its ends may move
    float radius;  // radius of the ball around its midpoint that contains it; below 0 in padding [m]
};

struct FacePush {
    uint count;   // number of particles, or edges; whole work groups
    uint surfaces; // number of surfaces; pair (a, b) is element a * surfaces + b of a table
    float recoverySpeed; // recovery speed of overlaps that exist at load [m/s]
    uint moving; // faces below this index have a corner that moves; unused for edges
    uint sheets; // among those, faces below this index have two sides; the others are the surface of closed bodies
    float quick; // motion in a substep up to which nothing can pass a face [m]
};
#include "common/zones_layout.h"
struct StopPush {
    uint count; // points that move
    uint moving, faces; // faces from the first index to before the second are static or driven
};

struct SubstepPush {
    uint count;
    uint isFirst; // 1 in the first substep of a step
};

struct PackedSubstepPush {
    uint count;
    uint isFirst;
    float restLengths[PACKED_GROUPS]; // [m]
    float units[PACKED_GROUPS];       // units of stiffness [N/m]
    float shares[PACKED_GROUPS];      // units of shares [N/m]
};

// Bodies on a regular grid: the invocations of a work group of the march, which is also the number of slots in a run
// where an invocation computes one node; and the fill of a full cell.
#define LATTICE_GROUP 32
#define LATTICE_FULL 15

// The relative volume below which a cell is unfolded, with the whole pressure from 0 on.
#define RECOVERY_START 0.5

// A run of slices of a block of columns, marched by one invocation; or a run of slots, with one node an invocation.
struct LatticeChunk {
    uint origin; // slot of its first node
    uint layers; // number of slices, or of slots in a run; 0 = padding
};

// `split` with the clamp by directions: substeps from one look at the directions of links to the next, fewer before the
// end of a step, and the time in which a clamp returns to that at rest by a factor e.
#define CLAMP_INTERVAL 8
#define CLAMP_MEMORY 2.0 // [s]

// Kinds of link: along an edge, a face diagonal, a body diagonal.
struct LatticePush {
    uint count;
    uint isFirst;
    uint rowStride, sliceStride; // slots from a node to the next in y, in z
    float restLengths[3];        // [m]
    float units[3];              // stiffness for each 1/15 of a cell's fill [N/m]
    float shares[3];             // k~ for each 1/15 of a cell's fill [N/m]
    uint substeps, bodySlots, bodyChunks; // RESIDENT: all substeps of a step at once; count = bodies x group size
    float volumeUnit;            // lambda_v a for each 1/15 of a cell's fill [N/m]
    float volumeShare;           // 2 k~ for each 1/15 of a cell's fill [N/m]
    float recoveryUnit;          // pressure x a for each 1/15 of a cell's fill [N/m]
    float recoveryShare;         // 2 k~ for each 1/15 of a cell's fill [N/m]
};

#include "common/collider_layout.h"
#include "common/cut_layout.h"

struct DampedSubstepPush {
    uint count;
    uint isFirst;
    float dampingTime; // damping coefficient over stiffness [s]
};

struct AttachmentPush {
    uint count;
    float fraction; // part of the step that is over at the end of this substep
};

// A particle that has moved no faster than SLEEP_SPEED for SLEEP_TIME rests, and may sleep.
#define SLEEP_TIME 0.5   // [s]
#define SLEEP_SPEED 0.03 // [m/s]
#define SLEEP_MOST_SPEED 0.1 // [m/s], of large particles (measure_rest_times)
#define SLEEP_DRIVEN -1.0f // replaces the inverse mass of driven particles

// Indices into the arguments of sleep passes: all particles, or one group, at the start of a step; the same in a
// substep; all particles after a finished step; one group after any step with an awake particle.
#define SLEEP_OPENING 0
#define SLEEP_OPENING_ONE 1
#define SLEEP_WAKING 2
#define SLEEP_WAKING_ONE 3
#define SLEEP_RESTING 4
#define SLEEP_CLOSING_ONE 5
#define SLEEP_ARGUMENTS 6

// Group counts of a step's passes while particles sleep: the total of a pass, and its kind.
#define SLEEP_ALL 0    // all groups, while any particle is awake
#define SLEEP_LISTED 1 // the groups with an awake particle
#define SLEEP_MIXED 2  // the same, only while any particle sleeps
#define SLEEP_MIXED_ALL 3
struct SleepPass {
    uint groups, kind;
};

struct SleepState {
    vec4 gravity;  // of the last finished step: as in StepParams
    float h;       // substep length of the last finished step [s]
    uint sleeping; // number of particles asleep at the end of the last step
    uint listed;   // number of groups that run in the next substep
    uint isMixed;  // 1 = some particles are awake and some sleep
    uint wakes;    // 1 = all wake at the end of the next finished step
    uint touched;  // 1 = an awake particle touches a sleeping one
    uint wakesAll; // 1 = all wake in this step
    uint unused0;
};

struct SleepPush {
    uint count;  // number of particles; whole work groups
    uint groups; // number of these groups
    uint attachments, colliders;
    uint driven;   // number of colliders, the last ones, that are balls around driven bodies
    uint passes;   // entries of the list of SleepPass
    uint substeps; // substeps of a step
};

struct DampedIterationPush {
    uint count;
    uint firstSlot;
    uint isFirst;
    float dampingTime; // [s]
};

struct IterationPush {
    uint count;
    uint firstSlot; // first slot of this constraint type in the correction buffer
    uint isFirst;   // 1 in the first iteration of a substep
};

struct ColorPush {
    uint count;      // constraints of the color, padded to whole work groups
    uint first;      // index of the first one in the list
    uint isOpening;  // 1 in the first sweep of a step
    uint isClosing;  // 1 in the last sweep of a substep
    float warmStart; // share of a multiplier that starts the next substep
};

struct BendColorPush {
    uint count;   // bends of the color, padded to whole work groups
    uint first;   // index of the first one in the list
    uint isFirst; // 1 in the first sweep of a substep
};

struct DampColorPush {
    uint count;        // constraints of the color, padded to whole work groups
    uint first;        // index of the first one in the list
    float dampingTime; // damping coefficient over stiffness [s]
};

#include "common/forces_layout.h"
#include "common/field_layout.h"
#include "common/motion_layout.h"
#include "common/carry_layout.h"
#include "common/level_layout.h"
struct SkinPush {
    uint count;
    uint firstVertex; // index of the skin's first vertex in the vertex buffer
};

#ifdef __cplusplus
} // namespace sinew::sim::layout
#endif
#endif
