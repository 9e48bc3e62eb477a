// The part of layout.h, which alone includes it, that is about cuts.
#include "pieces.h"

// Bodies that may be cut. What the host says of a step with a blade: a strip of quads between two poly-lines, and a ray.
// Not for a uniform block: software devices build numbers that branches depend on into kernels, and would do so for every step.
struct BladeHead {
    vec4 low, high;  // box around all that cuts [m]
    vec4 rayFrom;    // w = radius of the ray, 0 = there is none [m]
    vec4 rayTo;
    uint quads;      // of the strip; its points are from 0, to 0, from 1, to 1, ...
    uint isCarried;  // the strip begins where the last ended, wherever the material has gone
    uint unused0, unused1;
};

// How far a blade is moved to one side, so that no particle is just in its way [cells].
#define BLADE_SHIFT_X 0.000947
#define BLADE_SHIFT_Y 0.000168
#define BLADE_SHIFT_Z 0.000274

// What the device finds out in such a step; zeros at its head.
struct CutWork {
    uint farthest; // bits of a float: the longest way of a particle since the last blade [m]
    uint cut;      // links
    uint unused0, unused1;
};

// What is known after it.
struct CutCounts {
    uint links;       // cut since the uncut body; those without stiffness do not count
    uint linksOfStep; // in the newest step with a blade
    uint pieces;
    uint missing;     // SurfaceState::missing
    uint crumbs, crumbParticles; // pieces that were removed, and theirs
    uint crumbMass;   // of those, in 1 / CRUMB_MASS of all that may be cut
    uint unused0;
};
#define CRUMB_MASS 4294967040.0 // the largest float below 2^32

// Where the links that a node owns were cut, of the seven that are edges of Kuhn's tetrahedra, in the order (1,0,0) (0,1,0)
// (1,1,0) (0,0,1) (1,0,1) (0,1,1) (1,1,1): byte k % 4 of word k / 4, in 1/255 of the way from the node to the other end, from 5 to 250.
// It stands from the cut on; of a link that is alive it means nothing.
struct LinkHits {
    uint low, high;
};


struct CutPush {
    uint first, count;           // slots
    uint rowStride, sliceStride; // from a node to the next in y, in z; in a sheet there is no y and rowStride 0
    uint stiffLinks;             // bits of the links that have stiffness
    float spacing;               // [m]
    uint run;                    // which one it is: its lists
};

// Slots that one invocation counts particles in.
#define PIECE_CHUNK 32

// Of a particle that may be cut, where crumbs are removed.
struct CrumbParticle {
    uint mass;  // as CutCounts::crumbMass
    uint whole; // particles of its piece, uncut
};

// Of pieces that are removed: slots of a run, and how many particles a piece keeps for.
struct CrumbPush {
    uint first, count;
    uint least;
};

// A triangle of a skin that is not clipped: its corners, where they stand among the indices, and how many particles they hang on.
struct CrumbTriangle {
    uint corners[3];
    uint place;
    uint first, count; // of the list of those
};

struct PiecesPush {
    uint runs;   // of slots; argument r is for what begins with the slots of run r, runs + r for its count, 2 runs + r for what is made of them
    uint rounds; // of finding pieces
};

// Of a run, in a round.
struct RoundPush {
    uint first, count; // as CutPush has them
    uint rowStride, sliceStride;
    uint stiffLinks;
    uint next, groups; // arguments of the round that follows, and what to write there
};

// The surface of cuts. Slots that one invocation adds up.
#define SURFACE_CHUNK 64

// Of the cell above a slot: points that the slot owns, triangles inside, triangles outside, 8 bits each; which of the cell's outer
// faces are drawn in pieces (cut_outside.glsl).
struct SurfaceCounts {
    uint sizes, pieces;
};

struct SurfaceState {
    uint points, inside, outside; // points, triangles; a triangle outside has three vertices of its own behind the points
    uint missing;                 // room that a surface would need for which there is too little, else 0; it is empty then
};

struct SurfacePush {
    uint chunks; // of slots
    uint room;   // triangles, and as many vertices
    uint runs;   // of slots: arguments 0 .. runs - 1 are for them, those after for SURFACE_VERTICES ...
    uint hung;   // vertices of skins that hang on a lattice
};

// Arguments of what the surface is for, after those of runs.
#define SURFACE_VERTICES 0u // all
#define SURFACE_LISTED 1u   // items that have any of it, in a step that may have changed it
#define SURFACE_HUNG 2u     // vertices of skins that hang, if there is a surface
#define SURFACE_POINTS 3u
#define SURFACE_OUTSIDE 4u // vertices of triangles outside
#define SURFACE_ARGUMENTS 5u

// VkDrawIndexedIndirectCommand.
struct DrawArguments {
    uint indexCount, instanceCount, firstIndex;
    int vertexOffset;
    uint firstInstance;
};

// A vertex of a cut surface: hangs on up to four corners, x = sum of share (x_c + F_c (rest - rest_c)).
struct CutVertex {
    vec4 rest;       // [m], where the body was when the scene was loaded; w = index of its skin
    vec4 shares;     // 0 for no corner
    uint corners[4]; // slots; on an edge of a skin that hangs two, and then the ends of the edge (HungVertex) that go with them
    int normal[3];   // at rest, outward from its piece; of any length
    uint point;      // the point that it is at, or SURFACE_PARTICLE and a particle, or SURFACE_SKIN and a vertex of all skins
};
#define SURFACE_PARTICLE 0x80000000u
#define SURFACE_SKIN 0x40000000u // it is where that vertex is, and hangs on nothing
#define SURFACE_RIM 0x20000000u  // beside a point: it lies on an edge or in a triangle of a skin that hangs
#define SURFACE_NORMAL 1048576.0 // unit of a normal; that of a triangle in squares of the spacing

// Best linear motion of what is around a particle: columns of dx / dX.
struct Gradient {
    vec4 x, y, z;
};

// A triangle of a skin that is an outer face of a cell: the cell's slot and bit of SurfaceCounts::pieces, and the triangle.
struct SkinFace {
    uint item; // 16 times the cell, and the bit: there are fewer than 2^28 cells, each of which has 16 bytes of one buffer
    uint triangle;
    uint mixed; // the triangle in a mixed skin
    uint whole; // the whole triangle that it is a part of, or NO_WHOLE
};
#define NO_WHOLE 0xffffffffu

// A triangle of a skin as it was before it was split. A mixed skin has these away from cuts, and their parts beside cuts; where
// the two meet, it has both.
struct WholeTriangle {
    uint vertices[3]; // HungVertex
    uint mixed;       // the triangle in the mixed skin
};
#define WHOLE_ALONE 0u
#define WHOLE_MIXED 1u  // with its parts
#define WHOLE_PARTED 2u // its parts alone

// A vertex that only parts of whole triangles have: where it lies in one of them.
struct PartVertex {
    uint vertex;     // HungVertex
    uint whole;      // WholeTriangle
    float shares[2]; // barycentric, of its second and third corner
};

// Words with a bit for each of MIXED_WORD triangles of a mixed skin, which begins with a whole one.
struct MixedWords {
    uint first, count;
};
#define MIXED_WORD 32u

// What drawing a mixed skin takes of a vertex, in bits.
#define VERTEX_PLACED 1u   // its place
#define VERTEX_SHOWN 2u    // and its normal as one of parts: that of its triangles,
#define VERTEX_OF_PARTS 4u // or, as only parts have it, that between the corners of a whole one (light_parts)

struct WholePush {
    uint count;    // vertices that hang
    uint vertices; // of all skins, those that may be corners of whole triangles
};

// Skins of meshes hang on the lattice by prisms: between a triangle of the skin and the particles that its corners go with, which
// are corners of one tetrahedron. What a slot has of the complex of both (src/sim/surface/skin_complex): tetrahedra of the cell above
// it in bits 0 to 5, then ...
#define COMPLEX_FACES 6           // 12 bits: whether prisms stand on a face that the slot owns (surface_points.glsl)
#define COMPLEX_EDGES 18          // 7 bits: whether prisms with only two particles stand on an edge that it owns
#define COMPLEX_HAS_FACES (1u << 25) // the skin is the outer faces of the cell
#define COMPLEX_IS_CELL (1u << 26)   // the cell is filled
#define COMPLEX_HAS_PRISMS (1u << 27) // on some face or edge that the slot owns

// A triangle of a skin with what it stands on. Edge n leads from corner n to the next.
struct SkinPrism {
    uint vertices[3]; // HungVertex
    uint anchors[3];  // slots
    uint beyond[3];   // across edge n: 4 times the other prism, and which of its edges
    uint face;        // the slot that owns the face between the anchors; NO_PARTICLE where they are not three
    uint links;       // 4 bits an edge: the direction of the link as a corner, 0 = both ends go with one particle; 8 = to the start
    uint places;      // which of the slot's faces, and from bit 4 on the place of each corner in it, 2 bits
};

// A vertex of such a skin.
struct HungVertex {
    vec4 rest;    // [m]; w = index of the skin
    vec4 weights; // in its cell; w = links of its anchor, uncut
    vec4 normal;  // at rest, as it is lit; w = spacing of the grid [m]
    uint vertex;  // of all skins
    uint cell, anchor; // slots
    uint corner;  // of the cell, that the anchor is
};

// The lattice of the body that a skin is of; no spacing where the skin does not hang.
struct SkinGrid {
    uint rowStride, sliceStride; // slots from a node to the next in y, in z
    float spacing;               // [m]
    uint unused;
};

struct PrismPush {
    uint first;  // items of the surface before prisms: slots
    uint count;  // prisms, or vertices that hang
    uint prisms; // for part_prisms: the first of a body
    uint run;    // likewise: its lists
};

// Lists of a body whose skin is clipped: prisms near the blade, prisms near links that died, vertices near the blade, and those in
// parted cells.
#define SKIN_NEAR 0u
#define SKIN_PARTED 1u
#define SKIN_VERTICES 2u
#define SKIN_SPLIT 3u
#define SKIN_LISTS 4u

// A slot that a skin goes with. From `first` on what hangs there is listed: prisms, each once, with the first of their corners that does, as
// 4 times the prism and which corner; then vertices.
struct SkinSlot {
    uint slot, first;
    uint corners, vertices; // how many
};

struct SkinSlotsPush {
    uint first, count;     // such slots
    uint prisms, vertices; // the body's first
    float spacing;         // [m]
    uint run;              // its lists
};

// Of such a slot. In this stroke the blade was near it; it is of a prism that is listed; its vertices were, in the last step with a blade;
// and in this stroke.
#define SLOT_MET 1u
#define SLOT_ASKED 2u
#define SLOT_LISTED 4u
#define SLOT_OF_STROKE 8u

// Where a step with a blade finds a vertex, and where the last one did, from where it goes straight: what the blade has to do with it is then asked
// of one way without leaps. now.w = 0: it was not near the last one.
struct PlacedVertex {
    vec4 before, now; // [m]
};

// Of such a vertex that is on the wrong side of a blade, as w of where that lets it be at rest: it moves there once its anchor
// has lost a link; it has.
#define VERTEX_MOVES 1.0
#define VERTEX_MOVED 2.0

// What the skin of a sheet falls into beside cuts (surface/sheet_pieces.hpp). A triangle of such a skin is half of the cell above a slot:
// of the corners a, c = a + z, d = a + x + z, or of a, d, b = a + x.
struct SheetTriangle {
    uint slot; // of a
    uint kind; // bit 0: the second half; bit 1: its corners run the other way
};

// Of the pieces of a triangle, 0 where it is whole; then where they begin.
struct SheetCounts {
    uint triangles, vertices;
};

struct SheetState {
    uint triangles, vertices;
    uint missing; // room in triangles that all pieces would need, where that is more than there is; there are none then
};

// A vertex of a piece: x_a + x f_x + z f_z, f the tangents of the sheet at a; with a share it lies between a and b.
struct SheetVertex {
    uint a, b;   // slots
    float share; // of b
    float x, z;  // from a at rest [cells]
    float turn;  // of the normal: 1 as the corners of halves run, else -1
};

struct SheetPush {
    uint triangles;               // of the skin
    uint firstIndex;              // likewise
    uint firstPiece, room;        // index, triangles
    uint firstVertex, vertexRoom; // behind those of all skins
    uint firstSlot;               // of the sheet
    uint sliceStride;             // slots from a node to the next in z
    uint skin;
    uint isFirst; // to say what there is no room for
};

struct SheetSkinPush {
    vec4 right, down; // from a node to the next in x, in z, where the scene has them [m]
    uint firstVertex, vertexRoom;
    uint sliceStride;
};

// A contact face that is half of a cell of a sheet, and its place in the list that it is searched by.
struct CutFace {
    uint slot, kind; // as of a SheetTriangle
    uint place, face;
    uint isLarge; // of the list of large ones
};

// A contact face that is half of a square between four nodes of a voxel body. It lies between two cells.
struct CutSolidFace {
    uint low;       // lowest corner of the square, which is that of the cell above it [slot]
    uint below;     // that many slots lower is the lowest corner of the cell below it
    uint isFrontUp; // 1: the order of its corners makes the side of the cell above its front
    uint place, face;
    uint isLarge;
};

// A contact edge that is a link of a sheet.
struct CutEdge {
    uint slot, way; // of its lower end; slots to the other
    uint edge;
};

struct CutFacesPush {
    uint count;
    uint sliceStride;
    uint rowStride; // 0 in a sheet
};

// A link or bend in a list of `split`, and the one or two links of the masks that it leads over.
struct CutTie {
    uint element;
    float stiffness;    // [N/m], uncut
    uint first, second; // slots that own them
    uint bits;          // of the first, and << 8 of the second
};

// A tether between particles that were linked, uncut.
struct CutTether {
    uint tether;
    uint particle, anchor; // slots
    float reach;           // uncut [m]
};
#define NO_REACH 1e30 // [m]

// Tearing. Of the cell above a slot: the greatest stretch - 1, below 0 for no cell, and its direction in the grid; y is 0 in sheets.
struct CellStrain {
    float strain, x, y, z;
    uint isReached; // by a cut, and beyond the limit; of bodies of voxels
};

struct TearCount {
    uint count; // of cells that might tear
};

struct TearPush {
    uint first, count; // slots
    uint rowStride, sliceStride; // from a node to the next in y, 0 in sheets; in z
    float spacing; // [m]
    float limit;   // of the strain
    uint most;     // cells that tear in a step
};
