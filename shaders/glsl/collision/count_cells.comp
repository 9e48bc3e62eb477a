#version 460
// Counting sort, first pass: counts the particles of each slot of the table, and stores each particle's rank in its
// slot. Also stores the positions and bodies of particles: lists stay complete until particles have moved from there
// by more than the slack.
#extension GL_GOOGLE_include_directive : require
#define MAY_RUN_LISTED
#include "common/kernel.glsl"
#include "collision/hash_grid.glsl"

#include "common/fetched.glsl"
FETCHED_VEC4(0, Positions, positionAt)
FETCHED_FLOAT(1, Radii, radiusOf)
#define POSITION(i) positionAt(i)
#define RADIUS(i) radiusOf(i)
layout(std140, binding = 2) uniform Bounds { GridBounds bounds; };
layout(std430, binding = 3) buffer Counts { uint counts[]; };
layout(std430, binding = 4) writeonly buffer Places { uvec2 places[]; }; // slot and rank of each particle
layout(std430, binding = 5) writeonly buffer Detected { vec4 detected[]; };
layout(std430, binding = 6) readonly buffer Bodies { float bodies[]; }; // one per particle; below 0 = of a body without contacts
layout(std430, binding = 7) readonly buffer Watched { float watched[]; }; // below 0 = neither it nor its faces and edges can touch anything
layout(constant_id = 1) const bool hasHeadings = false;
layout(std430, binding = 8) buffer Headings { vec4 headings[]; };
layout(std430, binding = 9) readonly buffer Velocities { vec4 velocities[]; };
layout(std430, binding = 10) readonly buffer Frames { BodyFrame frames[FRAME_MOST_BODIES]; };
layout(std140, binding = 11) uniform Step { StepParams step; };
layout(std430, binding = 12) buffer Points { uint apart[]; }; // FACE_POINTS_...
layout(push_constant) uniform Push { GridPush push; };
#include "collision/body_frames.glsl"
#include "collision/headings.glsl"
#include "collision/count_motion.glsl"
#include "collision/motion_of.glsl"

vec4 headingOf(uint i, vec3 x) {
    const uint b = uint(clamp(bodies[i], 0.0, float(FRAME_MOST_BODIES - 1)));
    const vec3 heading = headingOf(frames[b], x, velocities[i].xyz, step.h, push.pace / step.h);
    return vec4(heading, leewayOf(heading, headings[i].xyz, bounds, push.margin, push.leeway));
}

void main() {
    const uint i = itemIndex(push.count);
    const vec4 x = POSITION(i);
    const Frame frame = frameOf(bounds, push.cells);
    detected[i] = vec4(x.xyz, watched[i] < 0.0 ? FRAME_NONE : bodies[i]);
    if (hasHeadings) {
        const vec4 heading = headingOf(i, x.xyz);
        headings[i] = heading;
        countMotion(i, RADIUS(i) >= 0.0, motionOf(velocities[i].xyz, heading, bounds.horizon), 0.5 * push.margin);
    }
    uvec2 place = uvec2(~0u);
    if (isInGrid(RADIUS(i), push.most)) {
        place.x = slotOf(cellOf(x.xyz, frame), frame);
        place.y = atomicAdd(counts[place.x], 1u);
    }
    places[i] = place;
}
