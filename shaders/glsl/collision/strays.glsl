// Distance of a particle, now and at the start of the substep, from its expected position [m]. Requires POSITION,
// VELOCITY, DETECTED and bounds of a kernel, with hasHeadings also HEADING; DETECTED is the position when lists were
// made, w: its body.
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
    frame.gravity = texelFetch(frameTexels, first + 11);
    return frame;
}
layout(constant_id = 4) const bool hasOneBody = false;

// The body of a particle that is in no list yet; any, where only strays count.
#ifndef UNLISTED_BODY
#define UNLISTED_BODY(i, r) 0.0
#endif

// How a particle moves against its frame.
struct Stray {
    float farthest; // from its expected position; 0 before the first lists [m]
    vec3 way;       // in the substep [m]
    float turn;     // change of the linear part of the frame in the substep
};

// With a larger change, as where bodies fly at each other, the frame says too little about the motion of particles.
#define MOST_TURN 0.1

// True if the distance exceeds the slack of `frame`, which is the same for all lanes if there is one body. r: position
// when lists were made; w: heading and leeway.
bool hasStrayedFrom(BodyFrame frame, vec3 x, vec3 v, vec3 r, vec4 w, out Stray s) {
    const bool isListed = abs(r.x) < 1e17; // else the frame begins with this substep (hash_grid.cpp)
    const vec3 from = isListed ? r : x - vec3(frame.map[0].w, frame.map[1].w, frame.map[2].w);
    const vec3 stray = x - mapped(frame.map, from + bounds.age * w.xyz);
    const vec3 start = x - step.h * v - mapped(frame.before, from + bounds.ageBefore * w.xyz);
    const float farthest = isListed ? sqrt(max(dot3(stray, stray), dot3(start, start))) : 0.0;
    const bool shortens = frame.speed.w < 0.0, isShared = !shortens && frame.gravity.w < MOST_TURN;
    s = Stray(farthest, isShared ? stray - start : step.h * v, isShared ? frame.gravity.w : 0.0);
    if (shortens || !isListed) return true;                      // no leeway makes up for a frame that shortens distances
    return !(s.farthest <= frame.speed.w + LEAST_STRETCH * w.w); // true for NaN too
}

bool hasStrayed(uint i, vec3 x, vec3 v, out Stray s) {
    const vec4 r = DETECTED(i);
    s = Stray(0.0, vec3(0.0), 0.0);
    if (r.w < 0.0) return false; // FRAME_NONE
    const vec4 w = HEADING(i);
    if (hasOneBody) return hasStrayedFrom(frameAt(0u), x, v, r.xyz, w, s);
    const float body = abs(r.x) < 1e17 ? r.w : UNLISTED_BODY(i, r);
    return hasStrayedFrom(frameAt(uint(clamp(body, 0.0, float(FRAME_MOST_BODIES - 1)))), x, v, r.xyz, w, s);
}
