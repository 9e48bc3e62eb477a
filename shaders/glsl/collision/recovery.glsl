// The part of contact memory with faces and between edges that is one number: the side of the pair, and the overlap
// that remains of the one it had when the scene was loaded: side x (1 + overlap). 0 = they do not touch.
#include "common/rest_slack.h"

float sideOf(float remembered) { return sign(remembered); }

// Remaining overlap after a substep. The pair touches at the reach minus this, so it separates at the speed of
// recovery, `part` a substep. In the first step of a simulation an overlap counts as one of the load; `approach` is
// the relative approach in this substep.
float overlapLeft(float remembered, float overlap, float approach, float part) {
    float left = 0.0;
    if (remembered != 0.0) left = abs(remembered) - 1.0;
    else if (step.hPrevious == 0.0 && overlap - approach > part) left = overlap - approach;
    return max(0.0, min(left - part, overlap));
}

// Remaining overlap of a pair that keeps its rest distance: all of its overlap at the start of the first substep,
// until it separates. `before`: overlap at the start of the substep.
float overlapKept(float remembered, float overlap, float before, float reach) {
    const float slack = REST_SLACK * reach;
    float left = 0.0;
    if (remembered != 0.0) left = abs(remembered) - 1.0;
    else if (isAtLoad()) left = max(0.0, before + slack);
    return overlap > -slack ? left : 0.0;
}

// Remaining overlap of a pair that came out from behind a face: `kept` of it stays, the rest recovers.
float overlapLetOut(float remembered, float overlap, float kept, float part, float reach) {
    const float before = remembered != 0.0 ? abs(remembered) - 1.0 : overlap;
    return overlap > -REST_SLACK * reach ? max(min(before - part, overlap), kept) : 0.0;
}

// Distance at which a pair with this memory touches [m].
float restOf(float reach, float remembered) { return reach - (abs(remembered) - 1.0); }

// Memory of a pair that keeps its rest distance, rounded up: a pair that has not moved must not touch.
float rememberedKept(float side, float depth, float left) {
    if (left <= 0.0) return depth > 0.0 ? side : 0.0;
    const float sum = 1.0 + left;
    return side * (sum - 1.0 < left ? uintBitsToFloat(floatBitsToUint(sum) + 1u) : sum);
}

float rememberedOf(float side, float depth, float left) { return depth > 0.0 || left > 0.0 ? side * (1.0 + left) : 0.0; }
