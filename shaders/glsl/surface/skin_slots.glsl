// The anchor slots of skins, and the prisms and vertices bound to each, from bindings 3 and 4.
#include "common/fetched.glsl"
FETCHED_UVEC4(3, Slots, slotWords) // SkinSlot
FETCHED_UINT(4, Hanging, hanging)
SkinSlot slotAt(uint i) {
    const uvec4 words = slotWords(i);
    return SkinSlot(words.x, words.y, words.z, words.w);
}
#define HANGING(k) hanging(k)
