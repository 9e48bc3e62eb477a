// Motion of the material around a slot, for kernels of skins beside cuts: defines the macros of nearby.glsl and
// skin_place.glsl, from bindings 1 to 6.
#include "common/fetched.glsl"
FETCHED_UINT(1, Links, linksAt)
FETCHED_VEC4(2, Rest, restPlace)
FETCHED_UINT(3, Particles, particleAt)  // one per slot
FETCHED_VEC4(4, Positions, positionAt)  // one per particle
layout(std430, binding = 5) readonly buffer Gradients { Gradient gradients[]; };
TEXEL_TWIN(5, samplerBuffer, gradientTexels);
FETCHED_UINT(6, Near, nearAt)
#define LINKS(i) linksAt(i)
#define HOME(i) restPlace(i).xyz
#define PARTICLE(i) particleAt(i)
#define POSITION(p) positionAt(p)
#define NEAR(i) nearAt(i)
mat3 turnOf(uint i) {
    const int g = int(3u * i);
    if (usesTexels) return mat3(texelFetch(gradientTexels, g).xyz, texelFetch(gradientTexels, g + 1).xyz, texelFetch(gradientTexels, g + 2).xyz);
    return mat3(gradients[i].x.xyz, gradients[i].y.xyz, gradients[i].z.xyz);
}
#define TURN(i) turnOf(i)
#define AT(i) POSITION(PARTICLE(i)).xyz
