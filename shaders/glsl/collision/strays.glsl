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
    return frame;
}
layout(constant_id = 4) const bool hasOneBody = false;

// True if the distance exceeds the slack of `frame`, which is the same for all lanes if there is one body. r: position
// when lists were made; w: heading and leeway.
bool hasStrayedFrom(BodyFrame frame, vec3 x, vec3 v, vec3 r, vec4 w, out float farthest) {
    const vec3 stray = x - mapped(frame.map, r + bounds.age * w.xyz);
    const vec3 start = x - step.h * v - mapped(frame.before, r + bounds.ageBefore * w.xyz);
    farthest = sqrt(max(dot3(stray, stray), dot3(start, start)));
    if (frame.speed.w < 0.0) return true;                      // no leeway makes up for a frame that shortens distances
    return !(farthest <= frame.speed.w + LEAST_STRETCH * w.w); // true for NaN too
}

bool hasStrayed(uint i, vec3 x, vec3 v, out float farthest) {
    const vec4 r = DETECTED(i);
    farthest = 0.0;
    if (r.w < 0.0) return false; // FRAME_NONE
    const vec4 w = HEADING(i);
    if (hasOneBody) return hasStrayedFrom(frameAt(0u), x, v, r.xyz, w, farthest);
    return hasStrayedFrom(frameAt(uint(min(r.w, float(FRAME_MOST_BODIES - 1)))), x, v, r.xyz, w, farthest);
}
