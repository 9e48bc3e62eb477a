// The prisms of a skin, from PRISM_BINDING.
#ifdef TEXELS
layout(binding = PRISM_BINDING) uniform usamplerBuffer prisms;
SkinPrism prismAt(uint i) {
    const uvec4 a = texelFetch(prisms, int(3u * i)), b = texelFetch(prisms, int(3u * i + 1u)), c = texelFetch(prisms, int(3u * i + 2u));
    return SkinPrism(uint[3](a.x, a.y, a.z), uint[3](a.w, b.x, b.y), uint[3](b.z, b.w, c.x), c.y, c.z, c.w);
}
#else
layout(std430, binding = PRISM_BINDING) readonly buffer Prisms { SkinPrism prisms[]; };
SkinPrism prismAt(uint i) { return prisms[i]; }
#endif
