// Part of the kernels that find where the blade of a step meets a skin. Whoever includes this has before[], blade and points[], as
// blade_sweep.glsl wants them, and pulledPlaces[], of particles for the blade.
#define PLACE(i) pulledPlaces[i].xyz
#include "blade_sweep.glsl"
