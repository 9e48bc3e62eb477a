// How far a particle may be, or have been when the substep began, from where it is expected [m]. In the names POSITION, VELOCITY and
// DETECTED of a kernel; DETECTED is where it was when lists were made.
#include "body_frames.glsl"

layout(std430, binding = FRAMES_BINDING) readonly buffer Frames { BodyFrame frames[]; };
layout(std430, binding = FRAMES_BINDING + 1) readonly buffer Bodies { uint bodies[]; }; // of each particle; FRAME_NONE = touches nothing

bool hasStrayed(uint i, out float farthest) {
    const uint body = bodies[i];
    farthest = 0.0;
    if (body == FRAME_NONE) return false;
    const BodyFrame frame = frames[body];
    const vec3 x = POSITION(i).xyz, r = DETECTED(i).xyz;
    const vec3 stray = x - expectedAt(frame.now, frame.from, r), way = step.h * (VELOCITY(i).xyz - placeIn(frame.rates));
    farthest = sqrt(dot3(stray, stray)) + sqrt(dot3(way, way)); // advance() says why
    return !(farthest <= frame.from.w); // as is what is no number
}
