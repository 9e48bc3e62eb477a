// Distance of a particle, now and at the start of the substep, from its expected position [m]. Requires POSITION,
// VELOCITY and DETECTED of a kernel; DETECTED is the position when lists were made, w: its body.
#include "collision/body_frames.glsl"

#include "common/fetched.glsl"
layout(std430, binding = FRAMES_BINDING) readonly buffer Frames { BodyFrame frames[FRAME_MOST_BODIES]; };
TEXEL_TWIN(FRAMES_BINDING, samplerBuffer, frameTexels);
BodyFrame frameAt(uint b) {
    if (!usesTexels) return frames[b];
    BodyFrame frame;
    const int first = 12 * int(b);
    for (int row = 0; row < 3; ++row) {
        frame.map[row] = texelFetch(frameTexels, first + row);
        frame.before[row] = texelFetch(frameTexels, first + 3 + row);
    }
    frame.speed = texelFetch(frameTexels, first + 6);
    return frame;
}
layout(constant_id = 4) const bool hasOneBody = false;

// True if the distance exceeds the slack of `frame`, which is the same for all lanes if there is one body.
bool hasStrayedFrom(BodyFrame frame, vec3 x, vec3 v, vec3 r, out float farthest) {
    const vec3 stray = x - mapped(frame.map, r), start = x - step.h * v - mapped(frame.before, r);
    farthest = sqrt(max(dot3(stray, stray), dot3(start, start)));
    return !(farthest <= frame.speed.w); // true for NaN too
}

bool hasStrayed(uint i, vec3 x, vec3 v, out float farthest) {
    const vec4 r = DETECTED(i);
    farthest = 0.0;
    if (r.w < 0.0) return false; // FRAME_NONE
    if (hasOneBody) return hasStrayedFrom(frameAt(0u), x, v, r.xyz, farthest);
    return hasStrayedFrom(frameAt(uint(min(r.w, float(FRAME_MOST_BODIES - 1)))), x, v, r.xyz, farthest);
}
