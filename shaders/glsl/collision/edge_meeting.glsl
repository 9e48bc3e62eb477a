// Whether two edges of different sheets come within reach in a substep, and are so fast that they may pass each other,
// or be made to by others. Pairs that come within reach are in lists whatever the margin: no other may decide anything.
// Requires the names and buffers of find_edge_contacts, and edge_touch.glsl.
#include "collision/meeting_marks.glsl"
bool mayPass = false; // whether some pair is so fast or so deep
uint meets = 0u;      // mark of the pair that was looked at last

bool areTwoSheets(uint i, uint j) { return hasSheets && sheets[i] != 0u && sheets[j] != 0u && sheets[i] != sheets[j]; }

float nearest2(Lines lines) {
    const vec3 d = shortestBetween(lines.ca, lines.ab, lines.cd);
    return dot(d, d);
}

// True if the two come within reach on their way, of which an end moves `way` against one of the other: as comesNear() of
// face_meeting_marks.glsl.
bool comesNear(Lines lines, Lines rates, float reach, float way, bool isAsked) {
    float back = isAsked ? 1.0 : 0.0;
    bool isNear = false;
    for (uint turn = 0u; turn < 16u && back > 0.0 && !isNear; ++turn) {
        const float distance = sqrt(nearest2(Lines(lines.ca - back * rates.ca, lines.ab - back * rates.ab, lines.cd - back * rates.cd)));
        isNear = distance < reach;
        back -= (distance - 0.999 * reach) / way;
    }
    return isNear;
}

// `rates`: displacements in the substep.
void noteMeeting(Lines lines, Lines rates, float reach) {
    const vec3 ac = rates.ca, bc = ac + rates.ab, ad = ac - rates.cd, bd = bc - rates.cd;
    const float way2 = max(max(dot(ac, ac), dot(bc, bc)), max(dot(ad, ad), dot(bd, bd))), reach2 = reach * reach;
    const bool isFast = way2 > push.quick * push.quick;
    const Lines before = Lines(lines.ca - rates.ca, lines.ab - rates.ab, lines.cd - rates.cd);
    const bool hasSwapped = dot(cross(lines.ab, lines.cd), lines.ca) > 0.0 != dot(cross(before.ab, before.cd), before.ca) > 0.0;
    vec2 st;
    const bool isNear = min(nearest2(lines), nearest2(before)) < reach2 || isFast && hasSwapped && hasPassed(lines, rates, st);
    if (!isNear && !comesNear(lines, rates, reach, sqrt(way2), isFast && !isNear)) return;
    meets = meetingMark(way2, reach);
    mayPass = mayPass || isFast;
}
