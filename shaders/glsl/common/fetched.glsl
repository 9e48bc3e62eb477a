// Buffers that a kernel reads at indices of its own: as texels where usesTexels is true, else with loads. A software
// device gathers a texel of 16 bytes as a whole, where a load takes one scalar access for each component and lane.
// Each macro declares the block with binding n, its texel twin, and a function name(i) that reads element i. ALIASED
// in front of the twin is needed where the buffer is written as well. NO_TEXELS: loads alone.
#ifndef FETCHED
#ifdef NO_TEXELS
const bool usesTexels = false;
#define TEXEL_TWIN(n, sampler, name)
#define FETCHED(n, sampler, type, components, Block, name)                     \
    layout(std430, binding = n) readonly buffer Block { type name##Loads[]; }; \
    type name(uint i) { return name##Loads[i]; }
#else
layout(constant_id = USES_TEXELS_ID) const bool usesTexels = true;
#define TEXEL_TWIN(n, sampler, name) layout(binding = TEXEL_TWINS + (n)) uniform sampler name

#define FETCHED(n, sampler, type, components, Block, name)                        \
    layout(std430, binding = n) readonly buffer Block { type name##Loads[]; };    \
    TEXEL_TWIN(n, sampler, name##Texels);                                         \
    type name(uint i) {                                                           \
        if (usesTexels) return texelFetch(name##Texels, int(i)).components;       \
        return name##Loads[i];                                                    \
    }
#endif
#define FETCHED_VEC4(n, Block, name) FETCHED(n, samplerBuffer, vec4, xyzw, Block, name)
#define FETCHED_FLOAT(n, Block, name) FETCHED(n, samplerBuffer, float, x, Block, name)
#define FETCHED_UVEC4(n, Block, name) FETCHED(n, usamplerBuffer, uvec4, xyzw, Block, name)
#define FETCHED_UVEC2(n, Block, name) FETCHED(n, usamplerBuffer, uvec2, xy, Block, name)
#define FETCHED_UINT(n, Block, name) FETCHED(n, usamplerBuffer, uint, x, Block, name)
#endif
