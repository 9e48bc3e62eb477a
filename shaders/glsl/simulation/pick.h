// Data of the kernels that pick: what a ray meets, and what lies in a region. Defined once for C++ (sinew::sim::layout)
// and GLSL.
#ifndef SINEW_PICK_H
#define SINEW_PICK_H

#ifdef __cplusplus
#include "common/layout.h"

namespace sinew::sim::layout {
#endif

#define PICK_CASTERS 4096u // invocations of cast_ray
#define PICK_FAR 3.0e38 // no limit; met nothing

// A vertex of a skin and the particles that hold it.
struct PickVertex {
    uint particles[8]; // NO_PARTICLE = none
    uint anchor;       // the only holder once something is cut; NO_PARTICLE = the same as before
    uint skin;
};

struct PickSkin {
    uint firstParticle, particleCount; // of its body
    uint isClosed;
    uint isSheet; // its triangles are those of the scene: sheet triangles
};

// The nearest item that an invocation has met. Items are, in this order: drawn triangles of skins, sheet triangles,
// particles drawn as balls, triangles of the surface of cuts.
struct PickHit {
    float distance; // along the ray [m]; PICK_FAR or more = none
    uint item;
};

struct PickPush {
    vec4 origin;    // [m]; w: distance at which the visible part of the ray begins
    vec4 direction; // unit length; w: distance at which it ends
    uint triangles, sheetTriangles, particles;
    uint skins;
    uint isOpened; // 1: a section plane hides what lies before the visible part
    uint isMoving; // 1: fixed particles are not picked
    uint ray;      // index
    uint firstHit; // cast_ray: of this dispatch; resolve_pick: of this ray
    uint firstItem;
    uint hits;     // resolve_pick: of this ray
    uint hasCuts;  // 1: there may be a surface of cuts
};

struct PickAnswer {
    vec4 point; // where the ray meets something [m]; w: distance along the ray [m]
    float place[3]; // of the particle [m]
    uint particle;  // NO_PARTICLE = nothing was met
};

struct WithinPush {
    vec4 center;      // of the region [m]; w: what its box grows by [m]
    vec4 halfExtents; // of the box [m]
    uint count;       // particles
    uint room;        // indices that fit
    uint isMoving;    // 1: fixed particles do not count
};

#ifdef __cplusplus
} // namespace sinew::sim::layout
#endif
#endif
