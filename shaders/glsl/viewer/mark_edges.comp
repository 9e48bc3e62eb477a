#version 460
// Marks contacts between edges of faces in the shown state: of the pairs in the solver's contact lists those whose
// interiors are within reach.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"
#include "common/segments.glsl"
#include "viewer/values.h"

layout(std430, binding = 0) readonly buffer Positions { vec4 positions[]; };
layout(std430, binding = 1) readonly buffer BySlot { uint bySlot[]; }; // particle, or NO_PARTICLE
layout(std430, binding = 2) readonly buffer Edges { ContactEdge edges[]; };
layout(std430, binding = 3) readonly buffer Candidates { uvec2 candidates[]; }; // ContactCandidate
layout(std430, binding = 4) readonly buffer Lists { uvec2 lists[]; };
layout(std430, binding = 5) writeonly buffer Marks { ContactMark marks[]; };
layout(std430, binding = 6) buffer Draw { MarkDraw draw; };
layout(std430, binding = 7) readonly buffer Pieces { uint pieces[]; }; // one per particle
layout(push_constant) uniform Push { MarkPush push; };
#include "viewer/marks.glsl"

const float leastSine = 1e-3; // squared, as in find_edge_contacts.comp

bool isWanted(ContactEdge edge) {
    return push.only == NO_PARTICLE || bySlot[edge.a] == push.only || bySlot[edge.b] == push.only;
}

void main() {
    const uint e = itemIndex(push.edges);
    if (e >= push.edges || lists[e].y == 0u || isGone(edges[e].a)) return;
    const vec3 a = placeOf(edges[e].a), ab = placeOf(edges[e].b) - a;
    const uvec2 list = lists[e];
    for (uint element = list.x; element < list.x + list.y; ++element) {
        const uvec2 candidate = candidates[element];
        if (isGone(edges[candidate.x].a) || !isWanted(edges[e]) && !isWanted(edges[candidate.x])) continue;
        const vec3 c = placeOf(edges[candidate.x].a), cd = placeOf(edges[candidate.x].b) - c;
        const Crossing crossing = crossingOf(a - c, ab, cd, leastSine);
        if (!isInside(crossing, 0.0) || abs(crossing.height) > 1.02 * uintBitsToFloat(candidate.y)) continue;
        const vec3 n = crossing.height < 0.0 ? -crossing.n : crossing.n;
        mark(a + crossing.s * ab - 0.5 * abs(crossing.height) * n, n, 2.0);
    }
}
