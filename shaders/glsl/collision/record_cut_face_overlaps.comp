#version 460
// Runs in the first substep after a cut, after the lists were rebuilt: points within reach of a face that this step
// has opened separate from it at a limited speed, like overlaps at the load of a scene, whether links or only
// contacts between particles held them so near. The same applies to points of a body that may be cut and the body's
// own faces: a point joined to a face by diagonals alone touched it at a part of the distance (linked_reach.h), and
// touches it at the whole distance once they are dead.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"
#include "common/triangle.glsl"

#include "collision/near_faces.glsl"
layout(std430, binding = 4) readonly buffer Lists { uvec2 lists[]; };
layout(std430, binding = 5) buffer Memory { vec4 memory[]; }; // w: side and overlap, 0 = has not touched
layout(std140, binding = 6) uniform Step { StepParams step; };
layout(std430, binding = 7) readonly buffer Opened { uint opened[]; }; // by face, from update_solid_faces
layout(push_constant) uniform Push { FacePush push; };
#define MARKS_BINDING 8
#include "collision/linked_marks.glsl"
#include "collision/face_meeting.glsl"
#include "collision/linked_reach.h"

// Overlap at the start of the substep; 0 behind the face [m].
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
        const uvec2 candidate = CONTACT(element);
        const bool isOwn = areParted(i, faceAt(candidate.x).a);
        if (!isOwn && (memory[element].w != 0.0 || opened[candidate.x] == 0u)) continue;
        const Meeting m = meetingOf(i, candidate);
        if (isSliver(m.triangle)) continue;
        const float overlap = overlapBefore(m);
        // A pair that touched before did so at LINKED_REACH, or rests on the face at its whole distance, and must
        // stay at rest.
        if (memory[element].w != 0.0 && overlap < (1.0 - LINKED_REACH) * m.reach) continue;
        if (overlap > max(0.0, abs(memory[element].w) - 1.0)) memory[element].w = m.front * (1.0 + overlap);
    }
}
