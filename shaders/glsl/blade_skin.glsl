// Part of the kernels that find where the blade of a step meets a skin. Whoever includes this has before[], blade and points[], as
// blade_sweep.glsl wants them, and PLACE(i), of particles for the blade.
#include "near_skin.glsl"
#include "blade_sweep.glsl"
