#version 460
// Frames of bodies, third pass: fits by least squares the affine motion that takes each body's particles from their
// positions when lists were made to their present ones, and continues at their present rate. Bodies whose boxes,
// swept over the step, come near each other share a frame: only then do differences between their particles follow
// from it. Any frame is correct, for lists are checked against it in every substep (check_pair_lists); one that fits
// keeps the lists valid for longer.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"
#include "common/math.glsl"
#include "collision/body_frames.glsl"

layout(std430, binding = 0) readonly buffer Sums { vec4 sums[]; };
layout(std430, binding = 1) readonly buffer Bodies { FrameBody bodies[]; };
layout(std430, binding = 2) readonly buffer Positions { vec4 positions[]; };
layout(std430, binding = 3) readonly buffer Detected { vec4 detected[]; };
layout(std430, binding = 4) writeonly buffer Frames { BodyFrame frames[FRAME_MOST_BODIES]; };
layout(std430, binding = 5) buffer Bounds { GridBounds bounds; };
layout(std140, binding = 6) uniform Step { StepParams step; };
layout(std430, binding = 7) readonly buffer Headings { vec4 headings[]; };
layout(push_constant) uniform Push { FramePush push; };

shared uint cluster[FRAME_MOST_BODIES];
shared vec4 low[FRAME_MOST_BODIES], high[FRAME_MOST_BODIES];
shared uint changed;

#include "collision/frame_moments.glsl"

// Particles that sleep are not checked, and stay.
bool mustStand(uint b) { return bodies[b].kind == FRAME_STANDS || sums[b * FRAME_SUMS + FRAME_SUM_V].w > 0.0; }

Fit ownFit(uint b) {
    if (mustStand(b)) return standing(originOf(b));
    const Origin origin = originOf(b);
    Moments m = Moments(0.0, vec3(0.0), vec3(0.0), vec3(0.0), mat3(0.0), mat3(0.0), mat3(0.0));
    add(m, b, origin);
    return fitOf(m, origin);
}

Fit clusterFit(uint b) {
    const uint mine = cluster[b];
    const Origin origin = originOf(mine);
    Moments m = Moments(0.0, vec3(0.0), vec3(0.0), vec3(0.0), mat3(0.0), mat3(0.0), mat3(0.0));
    for (uint other = 0u; other < push.bodies; ++other) {
        if (cluster[other] != mine) continue;
        if (mustStand(other)) return standing(origin);
        add(m, other, origin);
    }
    return fitOf(m, origin);
}

// Distance from the frame that headings and leeways may lead to.
float aside() { return push.ahead * push.pace + push.leeway; }

float mostDrift() { return 4.0 * push.margin + 2.0 * aside(); }

// Computes the box that a body's particles may reach in the step.
void sweep(uint b, Fit fit) {
    const uint first = b * FRAME_SUMS;
    const vec3 from = sums[first + FRAME_SUM_LOW].xyz, to = sums[first + FRAME_SUM_HIGH].xyz, middle = 0.5 * (from + to);
    const float dt = float(push.substeps) * step.h, turn = dt * sqrt(squaredNorm(fit.w)), grown = exp(min(turn, 10.0));
    const float radius = 0.5 * length(to - from), arm = radius + length(middle - fit.to);
    const vec3 way = dt * (fit.u + fit.w * (middle - fit.to));
    const float more = (grown - 1.0 - turn) * arm + turn * grown * radius + dt * dt * length(step.gravity.xyz) +
                       grown * (2.0 * push.margin + aside() + mostDrift()) + 0.51 * push.reach;
    const vec3 back = way / float(push.substeps); // positions are those at the end of the first substep
    low[b] = vec4(min(from, min(from - back, from + way)) - more, 0.0);
    high[b] = vec4(max(to, max(to - back, to + way)) + more, 0.0);
}

bool meet(uint a, uint b) {
    return all(lessThanEqual(low[a].xyz, high[b].xyz)) && all(lessThanEqual(low[b].xyz, high[a].xyz));
}

bool isOneCluster() {
    for (uint b = 1u; b < push.bodies; ++b)
        if (cluster[b] != cluster[0]) return false;
    return true;
}

// Labels each body with the lowest body of its cluster: bodies that meet directly or through others. In uniform
// control flow.
void findClusters(uint b) {
    const bool exists = b < push.bodies;
    if (exists) cluster[b] = b;
    barrier();
    for (uint round = 0u; round < push.bodies; ++round) {
        uint least = exists ? cluster[b] : 0u;
        for (uint other = 0u; exists && other < push.bodies; ++other)
            if (cluster[other] < least && meet(b, other)) least = cluster[other];
        if (b == 0u) changed = 0u;
        barrier();
        if (exists && least < cluster[b]) {
            cluster[b] = least;
            changed = 1u;
        }
        barrier();
        if (changed == 0u) break;
        barrier();
    }
}

void main() {
    const uint b = gl_LocalInvocationID.x;
    const bool exists = b < push.bodies;
    if (exists) sweep(b, ownFit(b));
    barrier();
    findClusters(b);
    barrier();
    Fit fit;
    if (exists) {
        fit = clusterFit(b);
        sweep(b, fit);
    }
    if (b == 0u) changed = 0u;
    barrier();
    // With shared frames boxes may be wider. If clusters then meet, all bodies share one frame that stands still.
    for (uint other = 0u; exists && other < push.bodies; ++other)
        if (cluster[other] != cluster[b] && meet(b, other)) changed = 1u;
    barrier();
    if (b == 0u) bounds.drift = changed != 0u || isOneCluster() ? 1e30 : mostDrift();
    if (!exists) return;
    if (changed != 0u) fit = standing(originOf(b));
    const float h = step.h;
    BodyFrame frame;
    // A body that hangs or lies does not fall: a body slower than the speed gained by falling for one step is
    // expected to stay.
    const vec3 fall = float(push.substeps) * h * step.gravity.xyz;
    const bool falls = !fit.stands && dot(fit.u, fit.u) > dot(fall, fall);
    frame.gravity = vec4(falls ? step.gravity.xyz : vec3(0.0), 0.0);
    frame.from = vec4(fit.from, 0.0);
    frame.speed = vec4(fit.u - h * frame.gravity.xyz, 0.0);
    setMap(frame, fit.a - h * fit.w * fit.a, fit.to - h * fit.u); // at the start of the substep
    setRates(frame, fit.w);
    advance(frame, h, push.reach, push.margin, push.pace);
    if ((step.lists & LISTS_REPEATS) != 0u) frame.speed.w *= LISTS_EARLY; // in the first substep
    frames[b] = frame;
}
