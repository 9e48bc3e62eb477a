// The vertices of bound skins, from HUNG_BINDING.
#include "common/fetched.glsl"
layout(std430, binding = HUNG_BINDING) readonly buffer Hung { HungVertex hung[]; };
TEXEL_TWIN(HUNG_BINDING, usamplerBuffer, hungTexels);
HungVertex hungAt(uint v) {
    if (!usesTexels) return hung[v];
    const int h = int(4u * v);
    const uvec4 words = texelFetch(hungTexels, h + 3);
    return HungVertex(uintBitsToFloat(texelFetch(hungTexels, h)), uintBitsToFloat(texelFetch(hungTexels, h + 1)), uintBitsToFloat(texelFetch(hungTexels, h + 2)),
                      words.x, words.y, words.z, words.w);
}
