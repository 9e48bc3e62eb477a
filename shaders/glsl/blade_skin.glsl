// Part of the kernels that find where the blade of a step meets a skin: points of a skin go as the particles do that they go with. Whoever
// includes this has before[], blade and points[], as blade_sweep.glsl wants them, hung[], and in the state that the step begins with
//
//   places[], savedLinks[], partitions[]   of the body
//   pulledPlaces[]                         of its particles for the blade
//   rest[]                                 where those were at rest
#define PLACE(i) pulledPlaces[i].xyz
#include "blade_sweep.glsl"
#define ALIVE(i) savedLinks[i]
#define AT(i) places[i].xyz
#define REST(i) rest[i].xyz
#define TURN(i) gradientAt(i)
#include "gradient.glsl"
#include "skin_place.glsl"

const float skinReach = 2.5; // of what goes with a particle [cells]

bool isNearBlade(uint i) {
    const vec3 now = PLACE(i), then = placeBefore(i);
    return all(lessThanEqual(min(now, then) - skinReach * push.spacing, blade.high.xyz)) &&
           all(greaterThanEqual(max(now, then) + skinReach * push.spacing, blade.low.xyz));
}

// The way from x to y, which go with the particles of i and j.
Ends waysOf(uint i, uint j, vec3 x, vec3 y) { return Ends(x + placeBefore(i) - PLACE(i), y + placeBefore(j) - PLACE(j), x, y); }

// Cells that were whole hang together.
vec3 placeNow(HungVertex vertex) {
    uint held = 255u;
    if (partitions[vertex.cell] != 0u) held = heldWith(vertex.cell, vertex.corner);
    return placeOf(vertex, held);
}
