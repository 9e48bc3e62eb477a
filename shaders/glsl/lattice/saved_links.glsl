// The links of a body that may be cut at the start of a step, from binding 3.
#ifdef TEXELS
layout(binding = 3) uniform usamplerBuffer savedLinks;
#define SAVED(i) texelFetch(savedLinks, int(i)).x
#else
layout(std430, binding = 3) readonly buffer SavedLinks { uint savedLinks[]; };
#define SAVED(i) savedLinks[i]
#endif
