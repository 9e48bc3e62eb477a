#version 460
// Checks the patches of sheets that are alone (search_patches.comp): lists are made again as soon as the shape of one does
// not keep its own points from its faces in the substep.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "common/kernel.glsl"

#include "common/fetched.glsl"
FETCHED_VEC4(0, Positions, positionAt)
FETCHED_VEC4(1, Velocities, velocityAt)
#define POSITION(i) positionAt(i)
#define VELOCITY(i) velocityAt(i)
layout(std140, binding = 2) uniform Step { StepParams step; };
layout(std430, binding = 3) readonly buffer Patches { SheetPatch patches[]; };
layout(std430, binding = 4) readonly buffer Alone { uint alone[]; };
layout(std430, binding = 5) buffer Bounds { GridBounds bounds; };
layout(push_constant) uniform Push { GridPush push; };
#include "collision/patch_shape.glsl"

layout(constant_id = 1) const uint parts = 1u; // invocations of a patch, which share the rows of its region

void main() {
    const uint all = parts * push.patches, item = itemIndex(all), k = item / parts;
    if (item >= all || alone[k] == 0u) return;
    const SheetPatch own = patches[k];
    const uint rows = (PATCH_REGION - 1u) / parts;
    if (!keepsApart(own, 1.001 * own.reach, 0.0, item % parts * rows, rows)) atomicMax(bounds.moved, floatBitsToUint(1e-30));
}
