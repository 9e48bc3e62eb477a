// Part of the kernels that find where the blade of a step meets a skin: points of a skin go as the particles do that they go with. Whoever
// includes this has before[], blade and points[], as blade_sweep.glsl wants them, and pulledPlaces[], of particles for the blade.
#define PLACE(i) pulledPlaces[i].xyz
#include "blade_sweep.glsl"

// The way from x to y, which go with the particles of i and j.
Ends waysOf(uint i, uint j, vec3 x, vec3 y) { return Ends(x + placeBefore(i) - PLACE(i), y + placeBefore(j) - PLACE(j), x, y); }
