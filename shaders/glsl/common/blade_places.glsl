// The blade of a step, and positions of particles at the end and at the start of its motion, from bindings 0 to 2.
// Call readBlade() first.
#include "common/fetched.glsl"
FETCHED_VEC4(0, BladePlaces, placeNow) // by slot
FETCHED_VEC4(1, PlacesBefore, before)
layout(std430, binding = 2) readonly buffer Blade { BladeHead bladeLoads; };
TEXEL_TWIN(2, usamplerBuffer, bladeTexels);
BladeHead blade;
void readBlade() {
    if (usesTexels) {
        const uvec4 words = texelFetch(bladeTexels, 4);
        blade = BladeHead(uintBitsToFloat(texelFetch(bladeTexels, 0)), uintBitsToFloat(texelFetch(bladeTexels, 1)), uintBitsToFloat(texelFetch(bladeTexels, 2)),
                          uintBitsToFloat(texelFetch(bladeTexels, 3)), words.x, words.y, uintBitsToFloat(words.z), 0u);
    } else {
        blade = bladeLoads;
    }
}
#define PLACE(i) placeNow(i).xyz
#define BEFORE(i) before(i)

// Position of a slot's particle at the start of the motion of the blade.
vec3 placeBefore(uint i) {
    if (blade.isCarried == 0u) return PLACE(i);
    const vec4 then = BEFORE(i);
    return then.w > 0.0 ? then.xyz : PLACE(i);
}
