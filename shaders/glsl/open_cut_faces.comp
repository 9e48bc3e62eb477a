#version 460
// In the first substep after a cut, when contacts are listed anew: points that are nearer than touching to a face that this step has
// opened part from it at a limited speed, as overlaps do that a scene is loaded with. Links may have held them so near, or particles alone.
// So do points of a body that may be cut from its own faces: one that diagonals alone joined to a face touched it at a part of the distance
// (linked_reach.h), and touches it at all of it once they are dead.
#extension GL_GOOGLE_include_directive : require
#include "kernel.glsl"
#include "triangle.glsl"

layout(std430, binding = 0) readonly buffer Predicted { vec4 predicted[]; };
layout(std430, binding = 1) readonly buffer Velocities { vec4 velocities[]; };
layout(std430, binding = 2) readonly buffer Faces { ContactFace faces[]; };
layout(std430, binding = 3) readonly buffer Contacts { uvec2 contacts[]; }; // ContactCandidate, in one load
layout(std430, binding = 4) readonly buffer Lists { uvec2 lists[]; };
layout(std430, binding = 5) buffer Memory { vec4 memory[]; }; // w: side and overlap, 0 = has not touched
layout(std140, binding = 6) uniform Step { StepParams step; };
layout(std430, binding = 7) readonly buffer Opened { uint opened[]; }; // by face, as part_solid_faces has it
layout(push_constant) uniform Push { FacePush push; };
#define MARKS_BINDING 8
#include "linked_marks.glsl"
#include "face_meeting.glsl"
#include "linked_reach.h"

// When the substep began; 0 behind the face [m].
float overlapBefore(Meeting m) {
    const float h = step.h;
    if (m.front * m.height < 0.0 || m.front * m.heightBefore < 0.0) return 0.0;
    const Nearest nearest = nearestOf(m.ap - h * m.vp, triangleOf(m.ab - h * m.vb, m.ac - h * m.vc));
    return m.reach - length(nearest.d);
}

void main() {
    const uint i = itemIndex(push.count);
    const uvec2 list = lists[i];
    for (uint element = list.x; element < list.x + list.y; ++element) {
        const uvec2 candidate = contacts[element];
        const bool isOwn = areParted(i, faces[candidate.x].a);
        if (!isOwn && (memory[element].w != 0.0 || opened[candidate.x] == 0u)) continue;
        const Meeting m = meetingOf(i, candidate);
        if (isSliver(m.triangle)) continue;
        const float overlap = overlapBefore(m);
        // A pair that touched already did so at LINKED_REACH, or else rests on the face at its whole distance, and is to go on resting.
        if (memory[element].w != 0.0 && overlap < (1.0 - LINKED_REACH) * m.reach) continue;
        if (overlap > max(0.0, abs(memory[element].w) - 1.0)) memory[element].w = m.front * (1.0 + overlap);
    }
}
