// Counts a point in its class of motions. `unit`: see motion_classes.glsl; isPoint: false in padding. Requires the name
// apart.
#include "collision/motion_classes.glsl"

void countMotion(uint item, bool isPoint, float motion, float unit) {
    if (item == 0u) apart[FACE_POINTS_UNIT] = floatBitsToUint(unit);
    const uint k = motionClass(motion, unit);
    if (isPoint && k < MOTION_CLASSES) atomicAdd(apart[FACE_POINTS_CLASS + k], 1u);
}
