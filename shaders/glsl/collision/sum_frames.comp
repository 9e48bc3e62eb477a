#version 460
// Frames of bodies, first pass: sums over a chunk of a body's particles (FRAME_SUMS in layout.h).
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"

layout(std430, binding = 0) readonly buffer Positions { vec4 positions[]; };
layout(std430, binding = 1) readonly buffer Velocities { vec4 velocities[]; };
layout(std430, binding = 2) readonly buffer Detected { vec4 detected[]; }; // positions when lists were made
layout(std430, binding = 3) readonly buffer Chunks { FrameChunk chunks[]; };
layout(std430, binding = 4) readonly buffer Members { uint members[]; };
layout(std430, binding = 5) readonly buffer Radii { float radii[]; }; // below 0 = removed from contacts
layout(std430, binding = 6) writeonly buffer Partial { vec4 partial[]; };
layout(std430, binding = 7) readonly buffer Headings { vec4 headings[]; };
layout(std430, binding = 8) readonly buffer Bounds { GridBounds bounds; };
layout(constant_id = 2) const bool sleeps = false;
layout(std430, binding = 9) readonly buffer Weights { float weights[]; }; // inverse mass, also of sleeping particles [1/kg]
layout(constant_id = 3) const bool checksGroups = false;
layout(std430, binding = 10) readonly buffer Groups { uint groups[]; }; // work groups that check their particles
layout(push_constant) uniform Push { FramePush push; };
#include "sleep/sleep.glsl"
#include "collision/expected.glsl"

// Position that the frame maps; without valid lists, the present position.
vec3 referenceOf(uint i) {
    const vec3 r = detected[i].xyz;
    return abs(r.x) < 1e17 ? alongHeading(r, i) : positions[i].xyz;
}

// Velocity of the frame at a particle, which follows its heading until the horizon.
vec3 sharedVelocityOf(uint i) {
    const vec3 v = velocities[i].xyz;
    return hasHeadings && abs(detected[i].x) < 1e17 && bounds.age < bounds.horizon ? v - headings[i].xyz : v;
}

// True if nothing checks whether the particle is where the frame expects it: it sleeps, or it is fixed, or driven and at
// rest, in a work group that does not run.
bool isUnchecked(uint i) {
    return sleeps && isAsleep(weights[i], velocities[i]) || checksGroups && groups[i / GROUP_SIZE] == 0u;
}

void main() {
    const uint c = itemIndex(push.chunks);
    if (c >= push.chunks) return;
    const FrameChunk chunk = chunks[c];
    const vec3 x0 = positions[chunk.origin].xyz, r0 = referenceOf(chunk.origin);
    vec3 sumR = vec3(0.0), sumX = vec3(0.0), sumV = vec3(0.0), speed = vec3(0.0), low = vec3(1e30), high = vec3(-1e30);
    float count = 0.0, sleepers = 0.0;
    mat3 rr = mat3(0.0), dr = mat3(0.0), vr = mat3(0.0);
    for (uint k = chunk.first; k < chunk.first + chunk.count; ++k) {
        const uint i = members[k];
        if (radii[i] < 0.0) continue;
        const vec3 at = positions[i].xyz, x = at - x0, r = referenceOf(i) - r0, v = sharedVelocityOf(i);
        count += 1.0;
        sumR += r;
        sumX += x;
        sumV += v;
        speed += velocities[i].xyz;
        if (isUnchecked(i)) sleepers += 1.0;
        rr += outerProduct(r, r);
        dr += outerProduct(x - r, r);
        vr += outerProduct(v, r);
        low = min(low, at);
        high = max(high, at);
    }
    const uint first = c * FRAME_SUMS;
    partial[first + FRAME_SUM_R] = vec4(sumR, count);
    partial[first + FRAME_SUM_X] = vec4(sumX, 0.0);
    partial[first + FRAME_SUM_V] = vec4(sumV, sleepers);
    for (uint k = 0u; k < 3u; ++k) {
        partial[first + FRAME_SUM_RR + k] = vec4(rr[k], 0.0);
        partial[first + FRAME_SUM_DR + k] = vec4(dr[k], 0.0);
        partial[first + FRAME_SUM_VR + k] = vec4(vr[k], 0.0);
    }
    partial[first + FRAME_SUM_SPEED] = vec4(speed, 0.0);
    partial[first + FRAME_SUM_LOW] = vec4(low, 0.0);
    partial[first + FRAME_SUM_HIGH] = vec4(high, 0.0);
}
