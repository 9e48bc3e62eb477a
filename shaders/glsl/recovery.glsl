// What contacts with faces and between edges remember beside how far they have slid, in one number: the side on which the
// two are, and how much they still overlap of what they did when the scene was loaded (contacts: 3): side x (1 + overlap).
// 0 = they do not touch.
#include "rest_slack.h"

float sideOf(float remembered) { return sign(remembered); }

// As much as remains is taken for touching, so that the two part at the speed with which they recover, `part` a substep. In
// the first step of a simulation what overlaps did so before; `approach` is what it has come nearer by in this substep.
float overlapLeft(float remembered, float overlap, float approach, float part) {
    float left = 0.0;
    if (remembered != 0.0) left = abs(remembered) - 1.0;
    else if (step.hPrevious == 0.0 && overlap - approach > part) left = overlap - approach;
    return max(0.0, min(left - part, overlap));
}

// A pair that keeps its rest distance keeps all that it overlapped by when the first substep began, until it parts. `before`: by how much
// it overlapped when the substep began.
float overlapKept(float remembered, float overlap, float before, float reach) {
    const float slack = REST_SLACK * reach;
    float left = 0.0;
    if (remembered != 0.0) left = abs(remembered) - 1.0;
    else if (isAtLoad()) left = max(0.0, before + slack);
    return overlap > -slack ? left : 0.0;
}

// The overlap left of a pair that came out from behind a face: `kept` of it stays, all else parts.
float overlapLetOut(float remembered, float overlap, float kept, float part, float reach) {
    const float before = remembered != 0.0 ? abs(remembered) - 1.0 : overlap;
    return overlap > -REST_SLACK * reach ? max(min(before - part, overlap), kept) : 0.0;
}

// Distance at which a pair with that memory touches [m].
float restOf(float reach, float remembered) { return reach - (abs(remembered) - 1.0); }

// Memory of such a pair, rounded up: one that has not moved must not touch.
float rememberedKept(float side, float depth, float left) {
    if (left <= 0.0) return depth > 0.0 ? side : 0.0;
    const float sum = 1.0 + left;
    return side * (sum - 1.0 < left ? uintBitsToFloat(floatBitsToUint(sum) + 1u) : sum);
}

float rememberedOf(float side, float depth, float left) { return depth > 0.0 || left > 0.0 ? side * (1.0 + left) : 0.0; }
