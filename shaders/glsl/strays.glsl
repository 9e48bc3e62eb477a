// How far a particle may be, or have been when the substep began, from where it is expected [m]. In the names POSITION, VELOCITY and
// DETECTED of a kernel; DETECTED is where it was when lists were made, w: its body.
#include "body_frames.glsl"

layout(std140, binding = FRAMES_BINDING) uniform Frames { BodyFrame frames[FRAME_MOST_BODIES]; };
layout(constant_id = 4) const bool hasOneBody = false;

// No more than those of `frame`; it is the same for all lanes where there is one body.
bool hasStrayedFrom(BodyFrame frame, vec3 x, vec3 v, vec3 r, out float farthest) {
    const vec3 stray = x - mapped(frame.map, r), start = x - step.h * v - mapped(frame.before, r);
    farthest = sqrt(max(dot3(stray, stray), dot3(start, start)));
    return !(farthest <= frame.speed.w); // as is what is no number
}

bool hasStrayed(uint i, vec3 x, vec3 v, out float farthest) {
    const vec4 r = DETECTED(i);
    farthest = 0.0;
    if (r.w < 0.0) return false; // FRAME_NONE
    if (hasOneBody) return hasStrayedFrom(frames[0], x, v, r.xyz, farthest);
    return hasStrayedFrom(frames[uint(min(r.w, float(FRAME_MOST_BODIES - 1)))], x, v, r.xyz, farthest);
}
