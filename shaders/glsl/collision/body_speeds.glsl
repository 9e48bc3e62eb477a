// The speed against which separations measure the ways of the corners of a sheet: the mean velocity of the sheet in the
// first substep of a step, or 0 if a part of it never moves. Unlike frames it does not depend on when lists were made.
// SPEEDS_BINDING: the first of three buffers.
#include "collision/sheet_marks.h"
layout(std430, binding = SPEEDS_BINDING) readonly buffer Sheets { uint sheets[]; };       // by slot: SHEET_...; 0 = corner of no sheet
layout(std430, binding = SPEEDS_BINDING + 1) readonly buffer BodySums { vec4 bodySums[]; }; // FRAME_SUM_...
layout(std430, binding = SPEEDS_BINDING + 2) readonly buffer Bodies { float bodies[]; };    // by slot: number of the body
layout(constant_id = 1) const bool hasBodies = false; // sums exist

// Speed of the sheet of particle i [m/s].
vec3 sheetSpeedOf(uint i) {
    if (!hasBodies || (sheets[i] & SHEET_HELD) != 0u || bodies[i] < 0.0) return vec3(0.0);
    const uint first = uint(bodies[i]) * FRAME_SUMS;
    return bodySums[first + FRAME_SUM_SPEED].xyz / max(bodySums[first + FRAME_SUM_R].w, 1.0);
}
