// Data of the kernels of color maps and contact marks, defined once for C++ (sinew::viewer::layout) and GLSL.
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
    uint slot; // slot of its word of live links; 0 if none of them can be cut
};

struct ValueLink {
    uint other;       // particle
    float restLength; // [m]
    uint bit;         // bit in the word; 0 = cannot be cut
};

// A link that is drawn as a line.
struct LineLink {
    uint a, b; // particles
    uint slot; // slot of the word of live links of a
    uint bit;  // bit in that word; 0 = cannot be cut
    uint overSlot, overBit; // the same for the particle in the middle, if the link spans one
};

// Particles that determine the value of a skin vertex; shares sum up to 1.
struct ValueHolders {
    vec4 low, high; // shares
    uint particles[8];
};

#define NO_VALUE (-1.0)

// Histogram of values: bin b counts those up to {1, 2, 5}[b % 3] x 10^(b / 3 - 7), and more than bin b - 1.
#define VALUE_BINS 32
struct ValueSpread {
    uint counts[VALUE_BINS];
    uint largest; // bits of a float
    uint unused0, unused1, unused2;
};

struct ValuesPush {
    uint count; // particles or vertices
    uint first; // first vertex, among those of all skins
};

// A contact mark.
struct ContactMark {
    vec4 point;  // [m]
    vec4 normal; // towards the particle that is pushed; w: 0 for a wall, 1 for two particles, 2 for a face
};

// The values of a particle that marks use.
struct MarkParticle {
    uint slot;           // in the solver's state
    float contactOffset; // [m]
    float nearness;      // distance up to which it counts as touching what it rests on [m]
};

// A plane, or a collider at its pose: a box grown by a radius.
struct MarkWall {
    vec4 core;     // half extents, radius [m]; for a plane its normal and offset
    vec4 position; // w = 1: a plane
    vec4 rotation; // unit quaternion
};

// VkDrawIndexedIndirectCommand, and the number of marks found, including those that did not fit.
struct MarkDraw {
    uint indexCount, instanceCount, firstIndex;
    int vertexOffset;
    uint firstInstance;
    uint found, unused0, unused1;
};

struct MarkPush {
    uint count;   // number of particles
    uint walls;
    uint firstWall;
    uint hasPairs, hasFaces; // 1 = there are lists of particles, of faces
    uint room;  // capacity in marks
    uint edges; // number of edges of faces that may touch each other; 0 = there are none
    uint only;  // the particle whose contacts are wanted; NO_PARTICLE = all
};

// An occupied cell of a hash grid.
struct CellMark {
    vec4 low;  // lowest corner; w: edge length [m]
    vec4 held; // x: number of particles in it, y: number in other cells with the same slot of the table
};

// VkDrawIndirectCommand of a grid's cells, and statistics of them.
struct CellDraw {
    uint vertexCount, instanceCount, firstVertex, firstInstance;
    uint sharing; // cells whose slot is shared with others
    uint most;   // most particles in one cell
    uint held;   // particles in all cells
    float edge;  // edge of a cell [m]
};

struct CellPush {
    uint count; // elements that may be sorted
    uint cells; // slots of the table
    uint grid;  // index among all grids
    uint first; // index of the first mark
};

#ifdef __cplusplus
} // namespace sinew::viewer::layout
#endif
#endif
