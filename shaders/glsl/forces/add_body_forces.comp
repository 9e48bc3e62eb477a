#version 460
// Second pass of the forces on bodies: adds up the sums of a body's parts, in order. Moments are about the centre of
// mass; those of a body that never moves are about the mean place of its particles. Forces on static faces have rows
// of their own; a hold counts with the opposite sign. An undone step gives zeros.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"

layout(std430, binding = 0) readonly buffer Parts { BodyForcePart parts[]; };
layout(std430, binding = 1) readonly buffer Ranges { ForceRange ranges[]; };
layout(std430, binding = 2) readonly buffer Positions { vec4 positions[]; }; // one per particle
layout(std430, binding = 3) readonly buffer Status { StatusWords status; };
layout(std430, binding = 4) buffer Sums { ForceSum sums[]; };
layout(push_constant) uniform Push { ForcePush push; };

vec3 centerOf(ForceRange range) {
    vec4 massMoment = vec4(0.0), places = vec4(0.0);
    for (uint p = range.firstPart; p < range.firstPart + range.parts; ++p) {
        massMoment += parts[p].massMoment;
        places += parts[p].places;
    }
    return massMoment.w > 0.0 ? massMoment.xyz / massMoment.w : places.xyz / places.w;
}

void main() {
    const uint b = itemIndex(push.count);
    if (b >= push.count) return;
    const ForceRange range = ranges[b];
    const bool isCounted = isFinished(status);
    const vec3 center = centerOf(range), origin = positions[range.origin].xyz;
    for (uint kind = 0u; kind < FORCE_KINDS; ++kind) {
        vec3 impulse = vec3(0.0), moment = vec3(0.0);
        for (uint p = range.firstPart; p < range.firstPart + range.parts; ++p) {
            impulse += parts[p].sums[kind].impulse.xyz;
            moment += parts[p].sums[kind].torque.xyz;
        }
        moment -= cross(center, impulse);
        const float sign = kind == FORCE_CONTACTS ? 1.0 : kind == FORCE_HOLDS ? -1.0 : 0.0;
        for (uint s = range.firstStop; sign != 0.0 && s < range.firstStop + range.stops; ++s) {
            const ForceSum stopped = sums[push.firstRow + s];
            impulse += sign * stopped.impulse.xyz;
            moment += sign * (stopped.torque.xyz + cross(positions[range.stopOrigin].xyz - origin - center, stopped.impulse.xyz));
        }
        if (!isCounted) impulse = moment = vec3(0.0);
        sums[FORCE_KINDS * b + kind] = ForceSum(vec4(impulse, 0.0), vec4(moment, 0.0));
    }
}
