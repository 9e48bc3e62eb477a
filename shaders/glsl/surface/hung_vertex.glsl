// The vertices of bound skins, from HUNG_BINDING.
#ifdef TEXELS
layout(binding = HUNG_BINDING) uniform usamplerBuffer hung;
HungVertex hungAt(uint v) {
    const int h = int(4u * v);
    const uvec4 words = texelFetch(hung, h + 3);
    return HungVertex(uintBitsToFloat(texelFetch(hung, h)), uintBitsToFloat(texelFetch(hung, h + 1)), uintBitsToFloat(texelFetch(hung, h + 2)),
                      words.x, words.y, words.z, words.w);
}
#else
layout(std430, binding = HUNG_BINDING) readonly buffer Hung { HungVertex hung[]; };
HungVertex hungAt(uint v) { return hung[v]; }
#endif
