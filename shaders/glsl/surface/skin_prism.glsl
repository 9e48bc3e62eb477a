// The prisms of a skin, from PRISM_BINDING.
#include "common/fetched.glsl"
layout(std430, binding = PRISM_BINDING) readonly buffer Prisms { SkinPrism prisms[]; };
TEXEL_TWIN(PRISM_BINDING, usamplerBuffer, prismTexels);
SkinPrism prismAt(uint i) {
    if (!usesTexels) return prisms[i];
    const int p = int(3u * i);
    const uvec4 a = texelFetch(prismTexels, p), b = texelFetch(prismTexels, p + 1), c = texelFetch(prismTexels, p + 2);
    return SkinPrism(uint[3](a.x, a.y, a.z), uint[3](a.w, b.x, b.y), uint[3](b.z, b.w, c.x), c.y, c.z, c.w);
}
