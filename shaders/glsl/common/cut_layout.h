// The part of layout.h for cuts; only layout.h includes it.
#include "common/pieces.h"

// The blade of a step, from the host: a strip of quads between two poly-lines, and a ray. It is no uniform block:
// software devices compile the values that branches depend on into kernels, and would do so for every step.
struct BladeHead {
    vec4 low, high;  // box around strip and ray [m]
    vec4 rayFrom;    // w = radius of the ray, 0 = no ray [m]
    vec4 rayTo;
    uint quads;      // quads of the strip; its points are start and end position of point 0, of point 1, ...
    uint isCarried;  // the strip starts where that of the step before ended, in the material, wherever that has moved
    float dt;        // length of the step [s]
    uint unused0;
};

// Shift of a blade to one side, so that no particle lies exactly in its path [cells].
#define BLADE_SHIFT_X 0.000947
#define BLADE_SHIFT_Y 0.000168
#define BLADE_SHIFT_Z 0.000274

// Results of a step with a blade, on the device; zeros at its head.
struct CutWork {
    uint farthest; // bits of a float: the longest displacement of a particle since the last blade [m]
    uint cut;      // links
    uint restored; // links of bodies that came or went (Body::isAbsent), which are whole again
    uint isChanged; // 1 = links of such a body may have changed
};

// A node of such a body before the step.
struct ReplacedNode {
    uint links;
    uint hitsLow, hitsHigh; // LinkHits
};

// State of all cuts after a step.
struct CutCounts {
    uint links;       // dead links in total; links without stiffness do not count
    uint linksOfStep; // in the newest step with a blade
    uint pieces;
    uint missing;     // SurfaceState::missing
    uint debris, debrisParticles; // fragments: removed pieces, and their particles
    uint debrisMass;   // mass of fragments, in 1 / DEBRIS_MASS of all that may be cut
    uint isWritten;    // whether the newest of these steps has changed links
};
#define DEBRIS_MASS 4294967040.0 // the largest float below 2^32

// Positions of the cuts on the links that a node owns, for the seven links that are edges of Kuhn's tetrahedra, in
// the order (1,0,0) (0,1,0) (1,1,0) (0,0,1) (1,0,1) (0,1,1) (1,1,1): byte k % 4 of word k / 4, in 1/255 of the way
// from the node to the other end, from 5 to 250. Valid for dead links only.
struct LinkHits {
    uint low, high;
};


struct CutPush {
    uint first, count;           // slots
    uint rowStride, sliceStride; // from a node to the next in y, in z; a sheet has no y: rowStride 0
    uint stiffLinks;             // bits of the links that have stiffness
    float spacing;               // [m]
    uint run;                    // index of the run, which selects its lists
    float linkWork;              // work of cutting a link across an edge of a cell [J]; 0 = none
    float forceScale;            // 1 / unit of the force on the blade [1 / N s]
};

// Slots that one invocation of count_pieces handles.
#define PIECE_CHUNK 32

// A particle that may be cut, where fragments are removed.
struct DebrisParticle {
    uint mass;  // in the unit of CutCounts::debrisMass
    uint whole; // particles of its uncut body
};

// Removal of fragments: the slots of a run, and the least number of particles that a piece must have.
struct DebrisPush {
    uint first, count;
    uint least;
};

// A triangle of an unclipped skin: its corners, its position among the indices, and its list of particles.
struct DebrisTriangle {
    uint corners[3];
    uint place;
    uint first, count; // range of its particles in the list
};

struct PiecesPush {
    uint runs;   // runs of slots; argument r dispatches over the slots of run r, runs + r over its count, 2 runs + r over what is made of them
    uint rounds; // rounds of the search for connected components
};

// A round of finding components in a run.
struct RoundPush {
    uint first, count; // see CutPush
    uint rowStride, sliceStride;
    uint stiffLinks;
    uint next, groups; // indirect argument of the next round, and the group count to write there
};

// The surface of cuts. Slots that one invocation adds up.
#define SURFACE_CHUNK 64

// Counts for the cell above a slot: points that the slot owns, inner triangles, outer triangles, 8 bits each;
// `pieces` marks the cell's outer faces that are drawn in pieces (cut_outside.glsl).
struct SurfaceCounts {
    uint sizes, pieces;
};

struct SurfaceState {
    uint points, inside, outside; // points, triangles; an outer triangle has three vertices of its own after the points
    uint missing;                 // capacity that the surface would need if it does not fit, else 0; it is then empty
};

struct SurfacePush {
    uint chunks; // chunks of slots
    uint room;   // capacity in triangles, and as many vertices
    uint runs;   // runs of slots: arguments 0 .. runs - 1 dispatch over these, the next over SURFACE_VERTICES ...
    uint hung;   // skin vertices bound to a lattice
};

// Dispatch arguments of a surface, after those of runs.
#define SURFACE_VERTICES 0u // all vertices
#define SURFACE_LISTED 1u   // items with a part in it, in a step that may have changed it
#define SURFACE_HUNG 2u     // skin vertices bound to a lattice, if there is a surface
#define SURFACE_POINTS 3u
#define SURFACE_OUTSIDE 4u // vertices of outer triangles
#define SURFACE_ARGUMENTS 5u

// VkDrawIndexedIndirectCommand.
struct DrawArguments {
    uint indexCount, instanceCount, firstIndex;
    int vertexOffset;
    uint firstInstance;
};

// A vertex of a cut surface: bound to up to four corners, x = sum of share (x_c + F_c (rest - rest_c)).
struct CutVertex {
    vec4 rest;       // [m], in the scene as loaded; w = index of its skin
    vec4 shares;     // 0 = no corner
    uint corners[4]; // slots; on an edge of a bound skin two, then the vertices of that edge that go with them (HungVertex)
    int normal[3];   // at rest, outward from its piece; not normalised
    uint point;      // its point, or SURFACE_PARTICLE and a particle, or SURFACE_SKIN and a vertex of all skins
};
#define SURFACE_PARTICLE 0x80000000u
#define SURFACE_SKIN 0x40000000u // coincides with that vertex, and is bound to nothing
#define SURFACE_RIM 0x20000000u  // beside a point: it lies on an edge or in a triangle of a bound skin
#define SURFACE_NORMAL 1048576.0 // unit of a normal; the normal of a triangle is in squares of the spacing

// Best linear fit of the deformation around a particle: columns of dx / dX.
struct Gradient {
    vec4 x, y, z;
};

// A skin triangle on an outer face of a cell: the cell's slot and bit of SurfaceCounts::pieces, and the triangle.
struct SkinFace {
    uint item; // 16 times the cell, plus the bit: there are fewer than 2^28 cells, each of which has 16 bytes of one buffer
    uint triangle;
    uint whole; // index of the whole triangle that contains it, or NO_WHOLE
    uint padding; // a face is one texel
};
#define NO_WHOLE 0xffffffffu

// A triangle of a skin as it was before it was split.
struct WholeTriangle {
    uint vertices[3]; // indices of HungVertex
};
#define WHOLE_PARTED 1u // state of a whole triangle beside a cut; elsewhere 0

// A vertex that occurs in parts of whole triangles only: its place in one of them.
struct PartVertex {
    uint vertex;     // index of HungVertex
    uint whole;      // index of WholeTriangle
    float shares[2]; // barycentric, of its second and third corner
};

struct WholePush {
    uint count;    // vertices bound to a lattice
    uint vertices; // vertices of all skins, those that may be corners of whole triangles
};

// Skins of meshes are bound to the lattice by prisms: a prism lies between a skin triangle and the anchors of its
// corners, which are corners of one tetrahedron. Word of a slot in the complex of both
// (src/sim/surface/skin_complex): tetrahedra of the cell above it in bits 0 to 5, then ...
#define COMPLEX_FACES 6           // 12 bits: prisms stand on a face that the slot owns (surface_points.glsl)
#define COMPLEX_EDGES 18          // 7 bits: prisms with only two anchors stand on an edge that it owns
#define COMPLEX_HAS_FACES (1u << 25) // the skin coincides with the outer faces of the cell
#define COMPLEX_IS_CELL (1u << 26)   // the cell is filled
#define COMPLEX_HAS_PRISMS (1u << 27) // on some face or edge that the slot owns

// A skin triangle with its base on the lattice. Edge n leads from corner n to the next.
struct SkinPrism {
    uint vertices[3]; // indices of HungVertex
    uint anchors[3];  // slots
    uint beyond[3];   // across edge n: 4 times the neighbouring prism, plus the number of its edge
    uint face;        // slot that owns the face between the anchors; NO_PARTICLE unless there are three
    uint links;       // 4 bits an edge: direction of the link as a corner number, 0 = both ends share an anchor; 8 = towards the start
    uint places;      // face of the slot; from bit 4 on, the index of each corner in it, 2 bits
};

// A vertex of a bound skin.
struct HungVertex {
    vec4 rest;    // [m]; w = index of the skin
    vec4 weights; // in its cell
    vec4 normal;  // at rest, as used for lighting; w = spacing of the grid [m]
    uint vertex;  // index in all skins
    uint cell, anchor; // slots
    uint corner;  // corner of the cell at which the anchor is
};

// The lattice of a skin's body; spacing 0 if the skin is not bound.
struct SkinGrid {
    uint rowStride, sliceStride; // slots from a node to the next in y, in z
    float spacing;               // [m]
    uint unused;
};

struct PrismPush {
    uint first;  // number of surface items before the prisms: slots
    uint count;  // prisms, or bound vertices
    uint prisms; // for partition_prisms: first prism of a body
    uint run;    // for partition_prisms: index of the run, which selects its lists
};

// Lists of a body with a clipped skin: prisms near the blade, prisms near dead links, vertices near the blade, and
// vertices in split cells.
#define SKIN_NEAR 0u
#define SKIN_PARTED 1u
#define SKIN_VERTICES 2u
#define SKIN_SPLIT 3u
#define SKIN_LISTS 4u

// A slot that is an anchor of skin vertices. List entries from `first` on: its prisms, each at the first of its
// corners with this anchor, as 4 times the prism plus that corner; then its vertices.
struct SkinSlot {
    uint slot, first;
    uint corners, vertices; // numbers of these
};

struct SkinSlotsPush {
    uint first, count;     // range of anchor slots
    uint prisms, vertices; // first of the body
    float spacing;         // [m]
    uint run;              // index of the run, which selects its lists
};

// State bits of an anchor slot: the blade was near it in this stroke; it belongs to a listed prism; its vertices were
// listed in the last step with a blade; and in this stroke; its particle lost links in this step; and in an earlier one
// of this stroke.
#define SLOT_MET 1u
#define SLOT_ASKED 2u
#define SLOT_LISTED 4u
#define SLOT_OF_STROKE 8u
#define SLOT_LOSES 16u
#define SLOT_LOST 32u

// Position of a vertex in this step with a blade, and in the last one; it moves straight between them, so that tests
// against the blade see a continuous path. now.w = 0: it was not near the blade in the last one. before.w = 0: it was
// not near in the step before this one, or a stroke begins.
struct PlacedVertex {
    vec4 before, now; // [m]
};

// Values of w in the place at rest of a vertex beside a cut. VERTEX_MOVES = the blade has passed between it and its
// anchor, and it moves there once the anchor loses a link. From VERTEX_MOVED on it has moved: VERTEX_AHEAD = to where
// the blade will pass if it goes straight on, VERTEX_OLD = by an earlier stroke.
#define VERTEX_MOVES 1.0
#define VERTEX_MOVED 2.0
#define VERTEX_AHEAD 3.0
#define VERTEX_OLD 4.0

// Pieces of a sheet's skin beside cuts (surface/sheet_pieces.hpp). A triangle of such a skin is half of the cell
// above a slot: corners a, c = a + z, d = a + x + z, or a, d, b = a + x.
struct SheetTriangle {
    uint slot; // slot of corner a
    uint kind; // bit 0: the second half; bit 1: opposite orientation
};

// Pieces of a triangle, 0 for a whole one; after the scan, offsets of the pieces.
struct SheetCounts {
    uint triangles, vertices;
};

struct SheetState {
    uint triangles, vertices;
    uint missing; // capacity in triangles that all pieces would need if they do not fit, else 0; there are then none
};

// A vertex of a piece: x_a + x f_x + z f_z, where f are the tangents of the sheet at a; with a share above 0 it lies
// between a and b.
struct SheetVertex {
    uint a, b;   // slots
    float share; // weight of b
    float x, z;  // offset from a at rest [cells]
    float turn;  // sign of the normal: 1 = orientation of the halves, else -1
};

struct SheetPush {
    uint triangles;               // triangles of the skin
    uint firstIndex;              // first index of the skin
    uint firstPiece, room;        // index; capacity in triangles
    uint firstVertex, vertexRoom; // after the vertices of all skins
    uint firstSlot;               // first slot of the sheet
    uint sliceStride;             // slots from a node to the next in z
    uint skin;
    uint isFirst; // this skin reports missing capacity
};

struct SheetSkinPush {
    vec4 right, down; // from a node to the next in x, in z, at rest in the scene [m]
    uint firstVertex, vertexRoom;
    uint sliceStride;
    uint unused0;
};

// A contact face that is half of a cell of a sheet, and its place in the search list.
struct CutFace {
    uint slot, kind; // see SheetTriangle
    uint place, face;
    uint isLarge; // it is in the list of large faces
};

// A contact face that is half of a square between four nodes of a voxel body, between two cells.
struct CutSolidFace {
    uint low;       // lowest corner of the square, and of the cell above it [slot]
    uint below;     // offset down to the lowest corner of the cell below it [slots]
    uint isFrontUp; // 1: its front, by the order of its corners, is towards the cell above
    uint place, face;
    uint isLarge;
};

// A contact edge that is a link of a sheet.
struct CutEdge {
    uint slot, way; // slot of its lower end; offset to the other end [slots]
    uint edge;
};

struct CutFacesPush {
    uint count;
    uint sliceStride;
    uint rowStride; // 0 for a sheet
};

// A link or bend in a list of `split`, and the one or two mask links that it spans.
struct CutTie {
    uint element;
    float stiffness;    // [N/m], uncut
    uint first, second; // slots that own them
    uint bits;          // mask bits of the first; << 8: of the second
};

// A tether between particles that are linked in the uncut body.
struct CutTether {
    uint tether;
    uint particle, anchor; // slots
    float reach;           // in the uncut body [m]
};
#define NO_REACH 1e30 // [m]

// Tearing. Strain of the cell above a slot: the greatest stretch - 1, below 0 for no cell, and its direction in the
// grid; y is 0 in sheets.
struct CellStrain {
    float strain, x, y, z;
    uint isReached; // reached by a cut, and beyond the limit; voxel bodies only
};

struct TearCount {
    uint count; // number of candidate cells
};

struct TearPush {
    uint first, count; // slots
    uint rowStride, sliceStride; // from a node to the next in y, 0 in sheets; in z
    float spacing; // [m]
    float limit;   // strain beyond which a cell tears
    uint most;     // cells that may tear in a step
};
