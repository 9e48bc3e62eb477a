// The anchor slots of skins, and the prisms and vertices bound to each, from bindings 3 and 4.
#ifdef TEXELS
layout(binding = 3) uniform usamplerBuffer slots; // SkinSlot
layout(binding = 4) uniform usamplerBuffer hanging;
SkinSlot slotAt(uint i) {
    const uvec4 words = texelFetch(slots, int(i));
    return SkinSlot(words.x, words.y, words.z, words.w);
}
#define HANGING(k) texelFetch(hanging, int(k)).x
#else
layout(std430, binding = 3) readonly buffer Slots { SkinSlot slots[]; };
layout(std430, binding = 4) readonly buffer Hanging { uint hanging[]; };
SkinSlot slotAt(uint i) { return slots[i]; }
#define HANGING(k) hanging[k]
#endif
