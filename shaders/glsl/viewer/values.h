// What the kernels of color maps and contact marks read and write, defined once for C++ (sinew::viewer::layout)
// and GLSL.
#ifndef SINEW_VIEWER_VALUES_H
#define SINEW_VIEWER_VALUES_H

#ifdef __cplusplus
#include "viewer/frame.h"

#include <cstdint>
namespace sinew::viewer::layout {
using uint = std::uint32_t;
#endif

// A particle's links: entries first .. first + count - 1 of the list of ValueLink.
struct ValueLinks {
    uint first, count;
    uint slot; // of its word of live links; 0 where none of them can be cut
};

struct ValueLink {
    uint other;       // particle
    float restLength; // [m]
    uint bit;         // of the word; 0 = cannot be cut
};

// A link that is drawn as a line.
struct LineLink {
    uint a, b; // particles
    uint slot; // of the word of live links of a
    uint bit;  // of that word; 0 = cannot be cut
    uint overSlot, overBit; // likewise of the particle between, of a link that leads over one
};

// Of which particles a vertex of a skin has its value; shares sum up to 1.
struct ValueHolders {
    vec4 low, high; // shares
    uint particles[8];
};

#define NO_VALUE (-1.0)

// How values are spread: bin b counts those up to {1, 2, 5}[b % 3] x 10^(b / 3 - 7), and more than bin b - 1.
#define VALUE_BINS 32
struct ValueSpread {
    uint counts[VALUE_BINS];
    uint largest; // bits of a float
    uint unused0, unused1, unused2;
};

struct ValuesPush {
    uint count; // particles or vertices
    uint first; // of the vertices of all skins
};

// Where something touches something: a mark.
struct ContactMark {
    vec4 point;  // [m]
    vec4 normal; // towards the particle that is pushed; w: of a wall 0, of two particles 1, of a face 2
};

// What marks need to know of a particle.
struct MarkParticle {
    uint slot;           // in the solver's state
    float contactOffset; // [m]
    float nearness;      // up to which it is taken for touching what it rests on [m]
};

// A plane, or a collider where it is: a box grown by a radius.
struct MarkWall {
    vec4 core;     // half extents, radius [m]; of a plane its normal and offset
    vec4 position; // w = 1: a plane
    vec4 rotation; // unit quaternion
};

// VkDrawIndexedIndirectCommand, and how many marks there would be if there were room.
struct MarkDraw {
    uint indexCount, instanceCount, firstIndex;
    int vertexOffset;
    uint firstInstance;
    uint found, unused0, unused1;
};

struct MarkPush {
    uint count;   // of particles
    uint walls;
    uint firstWall;
    uint hasPairs, hasFaces; // 1 = there are lists of particles, of faces
    uint room;  // marks
    uint edges; // of faces, that may touch each other; 0 = there are none
    uint only;  // the particle whose contacts are wanted; NO_PARTICLE = all
};

// A cell of a hash grid that holds something.
struct CellMark {
    vec4 low;  // corner; w: edge [m]
    vec4 held; // x: how many are in it, y: how many of other cells are in the same slot of the table
};

// VkDrawIndirectCommand of a grid's cells, and what there is to be said of them.
struct CellDraw {
    uint vertexCount, instanceCount, firstVertex, firstInstance;
    uint sharing; // cells whose slot others are in, too
    uint most;   // in a cell
    uint held;   // in all
    float edge;  // of a cell [m]
};

struct CellPush {
    uint count; // elements that may be sorted
    uint cells; // slots of the table
    float edge; // GridPush::edge [m]
    uint grid;  // among all
    uint first; // mark
};

#ifdef __cplusplus
} // namespace sinew::viewer::layout
#endif
#endif
