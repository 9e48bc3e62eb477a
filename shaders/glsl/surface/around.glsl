// Part of the kernels that place the rims of a cut. Requires before_cut.glsl.

// The material around a particle: the best affine motion of it and its neighbours on both sides of the blade.
struct Around {
    vec3 rest, now; // means
    vec3 drift;     // mean motion in this step
};

Around aroundOf(uint i) {
    Around mean = Around(REST(i), AT(i), PLACE(i) - placeBefore(i));
    for (uint alive = SAVED(i); alive != 0u; alive &= alive - 1u) {
        const uint j = uint(int(i) + offsetOf(directionOf(findLSB(alive))));
        mean.rest += REST(j);
        mean.now += AT(j);
        mean.drift += PLACE(j) - placeBefore(j);
    }
    const float share = 1.0 / float(1 + bitCount(SAVED(i)));
    return Around(share * mean.rest, share * mean.now, share * mean.drift);
}

// The place of the material now that is at `rest` at rest. `turn` is the gradient at the particle.
vec3 placeIn(Around around, mat3 turn, vec3 rest) { return around.now + turn * (rest - around.rest); }
