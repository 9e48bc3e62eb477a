#version 460
// Writes the group counts of the passes that build the grid, which are 0 while lists are still complete, and of the
// passes that depend on the speed of particles. Advances the frames of bodies to the next substep. A calm step has
// those passes in its first substep only: it is undone if a later one needs them.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"
#include "common/math.glsl"
#include "collision/body_frames.glsl"
#include "collision/touched.h"

layout(std430, binding = 0) buffer Bounds { GridBounds bounds; };
layout(std430, binding = 1) writeonly buffer Arguments { DispatchArguments arguments[]; };
layout(std430, binding = 2) buffer Frames { BodyFrame frames[FRAME_MOST_BODIES]; };
layout(std430, binding = 4) writeonly buffer Touching { DispatchArguments touching[]; }; // groups with contacts
layout(std430, binding = 5) buffer Status { StatusWords status; };
layout(constant_id = 5) const bool listsTouched = false; // else the next three are empty
layout(std430, binding = 6) writeonly buffer TouchedPoints { DispatchArguments touchedPoints[]; };
layout(std430, binding = 7) writeonly buffer TouchedArguments { DispatchArguments touchedArguments[]; };
layout(std430, binding = 8) buffer Touched { uint touched[]; };
layout(constant_id = 6) const bool hasRows = false; // else the next one is empty
layout(std430, binding = 9) writeonly buffer Making { DispatchArguments making[]; }; // search_patches and plan_rows add to them
layout(std140, binding = 3) uniform Step { StepParams step; };
layout(push_constant) uniform Push { GridPush push; };

// Empties the lists of what touches in the substep.
void clearTouched() {
    const DispatchArguments none = DispatchArguments(0u, 1u, 1u, 0u);
    touchedArguments[TOUCHED_PARTICLES] = touchedArguments[TOUCHED_ROWS] = touchedPoints[0] = none;
    for (uint list = 0u; list < TOUCHED_LISTS; ++list) touched[list] = 0u;
    ++touched[TOUCHED_SUBSTEP];
}

uint groupsOf(uint items) { return (items + GROUP_SIZE - 1u) / GROUP_SIZE; }

void plan(uint element, bool runs, uint items) {
    arguments[element] = DispatchArguments(runs ? groupsOf(items) : 0u, 1u, 1u, 0u);
}

// Distance that particles may have strayed when lists are made: unreported particles have strayed by less than half
// of the margin. Headings lead away from the frame of the body as well.
float strayOf(uint moved) { return max(uintBitsToFloat(moved), 0.49 * push.margin) + push.ahead * push.pace + push.leeway; }

bool isCalm() { return push.isLater != 0u && (step.lists & LISTS_CALM) != 0u; }

// Steps after one that lacked lists are undone as well, until that one is repeated.
void noteLists(bool needsPasses) {
    if (push.isLater == 0u) {
        if ((step.lists & LISTS_RESUMES) != 0u) bounds.lacksLists = 0u;
        atomicMax(status.lacksLists, bounds.lacksLists);
    } else if (needsPasses) {
        atomicAdd(status.laterLists, 1u);
        if (isCalm()) atomicMax(status.lacksLists, 1u);
    }
}

void planPasses(bool isBuilt, bool isComplete) {
    atomicMax(status.candidates, bounds.lacking);
    const bool areFew = bounds.sweepers <= MOST_SWEEPERS, isSlowed = bounds.hurrying > MOST_FAST;
    noteLists(!isComplete || isSlowed);
    plan(GRID_PARTICLES, isBuilt, push.items);
    plan(GRID_PARTICLE_CHUNKS, isBuilt, (push.count - 1u) / GRID_CHUNK + 1u);
    plan(GRID_CELL_CHUNKS, isBuilt, push.cells / GRID_CHUNK);
    plan(GRID_ONE_GROUP, isBuilt, 1u);
    if (push.others > 0u) plan(GRID_OTHERS, isBuilt, push.others);
    plan(GRID_PATCHES, isBuilt, push.patches);
    if (hasRows) {
        making[MAKING_FACES] = DispatchArguments(isBuilt ? groupsOf(push.loose) : 0u, 1u, 1u, 0u);
        making[MAKING_OWNERS] = making[MAKING_LINKS] = DispatchArguments(0u, 1u, 1u, 0u);
    }
    plan(GRID_SLOWED, isSlowed, push.count);
    plan(GRID_SWEPT, isBuilt && !areFew, push.items);
    plan(GRID_UNSWEPT, isBuilt && areFew, push.items);
    if (isBuilt) {
        bounds.listed = bounds.listedParticles = 0u; // the passes that make lists count again
        bounds.pairs = bounds.entries = bounds.links = bounds.owners = bounds.linked = 0u;
        bounds.lowX = bounds.lowY = bounds.lowZ = ~0u;
        bounds.highX = bounds.highY = bounds.highZ = 0u;
        bounds.edge = areFew ? push.quietEdge : push.edge;
        bounds.drivenWay = 0u;
        ++bounds.builds;
        bounds.drift -= strayOf(bounds.moved);
    }
    touching[0] = DispatchArguments(groupsOf(bounds.listed), 1u, 1u, 0u);
    touching[1] = DispatchArguments(bounds.listedParticles, 1u, 1u, 0u);
    touching[2] = DispatchArguments(min((bounds.entries + GROUP_SIZE - 1u) / GROUP_SIZE, uint(ROWS_MOST_GROUPS)), 1u, 1u, 0u);
    bounds.isSwept = bounds.sweeping;
    bounds.fast = isSlowed ? 0u : areFew ? bounds.sweepers : bounds.hurrying;
    bounds.moved = bounds.sweeping = bounds.sweepers = bounds.hurrying = 0u;
}

// The time for which particles follow their headings, in the substep that is checked next.
void planHeadings(bool isBuilt) {
    if (isBuilt) {
        bounds.lasted = bounds.age;
        bounds.substep = step.h;
        bounds.horizon = (1.0 + bounds.aheadShare) * push.ahead * step.h;
    }
    bounds.ageBefore = isBuilt ? 0.0 : bounds.age;
    // A longer substep takes no more of a heading than that: any age below the horizon is valid.
    bounds.age = min(bounds.ageBefore + min(step.h, bounds.substep), bounds.horizon);
}

// Bodies far from each other have frames of their own while no particle strays; after that, all frames stand still
// until the next step.
void planFrame(uint b, uint moved, bool stands) {
    BodyFrame frame = frames[b];
    if (moved > 0u) restart(frame, stands);
    advance(frame, step.h, push.reach, push.margin, push.pace);
    frames[b] = frame;
}

void main() {
    const uint b = gl_LocalInvocationID.x;
    const uint strayed = bounds.moved; // check_pair_lists writes only distances that are too large
    const uint moved = isCalm() ? 0u : strayed;
    const bool stands = bounds.drift < strayOf(moved);
    memoryBarrierBuffer();
    barrier();
    if (b == 0u) planPasses(moved > 0u, strayed == 0u);
    if (b == 0u && push.bodies > 0u) planHeadings(moved > 0u);
    if (b == 0u && listsTouched) clearTouched();
    if (b < push.bodies) planFrame(b, moved, stands);
}
