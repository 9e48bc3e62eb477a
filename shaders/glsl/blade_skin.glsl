// Part of the kernels that find where the blade of a step meets a skin: points of a skin go as the particles do that they go with. Whoever
// includes this has what blade_sweep.glsl needs.

const float skinReach = 2.5; // of what goes with a particle [cells]

bool isNearBlade(uint i) {
    const vec3 now = PLACE(i), then = placeBefore(i);
    return all(lessThanEqual(min(now, then) - skinReach * push.spacing, blade.high.xyz)) &&
           all(greaterThanEqual(max(now, then) + skinReach * push.spacing, blade.low.xyz));
}

// The way from x to y, which go with the particles of i and j.
Ends waysOf(uint i, uint j, vec3 x, vec3 y) { return Ends(x + placeBefore(i) - PLACE(i), y + placeBefore(j) - PLACE(j), x, y); }
