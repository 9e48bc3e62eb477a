// Whether a point and a face come within reach in a substep, and are so fast or so deep that they may pass each other, for
// impact zones. Requires face_meeting.glsl, meeting_marks.glsl, and the names mayPass and meets of a kernel.

// True if the two come within reach on their way; false without a search unless `isAsked`. The search goes on by as much
// as the two can have come nearer, so it never leads beyond the first touch. It may miss two that only slide along.
bool comesNear(Meeting m, bool isAsked) {
    const Passage p = passageOf(m);
    const float way = sqrt(wayOf2(p));
    float back = isAsked ? 1.0 : 0.0;
    bool isNear = false;
    for (uint turn = 0u; turn < 16u && back > 0.0 && !isNear; ++turn) {
        const float distance = length(nearestAt(p, back).d);
        isNear = distance < m.reach;
        back -= (distance - 0.999 * m.reach) / way;
    }
    return isNear;
}

// Notes whether a pair comes within reach, and whether it is so fast that it may pass, or be made to by others. Pairs that
// come within reach are in lists whatever the margin: no other may decide anything.
void noteMeeting(Meeting m) {
    const vec3 one = m.vp - m.vb, other = m.vp - m.vc;
    const float way2 = step.h * step.h * max(dot(m.vp, m.vp), max(dot(one, one), dot(other, other)));
    const bool isFast = way2 > push.quick * push.quick;
    vec3 b, start = nearestBefore(m).d;
    const bool isNear = isWithinReach(m) || dot(start, start) < m.reach * m.reach || m.height * m.heightBefore < 0.0 && wentThrough(m, b);
    if (!isNear && !comesNear(m, isFast && !isNear)) return; // also past a rim
    meets = meetingMark(way2, m.reach);
    mayPass = mayPass || isFast;
}
