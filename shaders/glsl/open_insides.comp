#version 460
// After a cut: particles of a voxel body with faces take part in contacts from the step on in which a cell beside them is no longer whole.
// An invocation takes the corners of a cell; those of several come to the same.
#extension GL_GOOGLE_include_directive : require
#include "cut.glsl"
#include "link_masks.glsl"

layout(std430, binding = 0) readonly buffer Links { uint links[]; };
layout(std430, binding = 1) readonly buffer Counts { uint listedCounts[]; };
layout(std430, binding = 2) readonly buffer Listed { uint listed[]; };
layout(std430, binding = 3) readonly buffer Particles { uint particles[]; }; // of each slot
layout(std430, binding = 4) readonly buffer Pieces { uint pieces[]; };
layout(std430, binding = 5) readonly buffer Open { float open[]; }; // radii of what can be touched
layout(std430, binding = 6) buffer Radii { float radii[]; };        // below 0 = touches nothing
layout(std430, binding = 7) buffer Bounds { GridBounds bounds; };
#include "listed_slot.glsl"
#include "whole_cell.glsl"

bool isInside(uint node) {
    for (int k = 0; k < 8; ++k)
        if (!isWholeCell(uint(int(node) - offsetOf(cornerOf(k))))) return false;
    return true;
}

void main() {
    const uint lowest = listedSlot();
    if (lowest == NO_SLOT) return;
    for (int k = 0; k < 8; ++k) {
        const uint i = uint(int(lowest) + offsetOf(cornerOf(k))), particle = particles[i];
        if (particle == NO_PARTICLE || open[i] < 0.0 || pieces[particle] == REMOVED_PIECE) continue;
        const float radius = isInside(i) ? -1.0 : open[i];
        if (radius == radii[i]) continue;
        radii[i] = radius;
        if (bounds.moved == 0u) atomicMax(bounds.moved, 1u);
    }
}
