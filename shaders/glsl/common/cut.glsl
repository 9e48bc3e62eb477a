// Part of the kernels that cut: their push constants, and the slot of an item.
#include "common/kernel.glsl"
#ifndef CUT_PUSH
#define CUT_PUSH CutPush
#endif
layout(push_constant) uniform Push { CUT_PUSH push; };

// Weight of an uncut body, in the unit in which pieces are weighed.
#define WHOLE_PIECE 1073741824.0

// Slot offset from a node to its neighbour; `direction` is one step at most in x, y and z.
int offsetOf(ivec3 direction) {
    return direction.x + direction.y * int(push.rowStride) + direction.z * int(push.sliceStride);
}
