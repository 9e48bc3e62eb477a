#version 460
// Makes the list of every moving face's points, sorted by index: where in a point's list the face is. There its corners find what
// the contact does to them.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "kernel.glsl"

layout(push_constant) uniform Push { FaceFindPush push; };
#define PAIRS_BINDING 0
#define ENTRIES_OF_PAIR 1u
#include "listed_pairs.glsl"
layout(std430, binding = 1) buffer Chains { uint chains[]; }; // of faces
layout(std430, binding = 2) readonly buffer Contacts { ContactCandidate contacts[]; };
layout(std430, binding = 3) readonly buffer Lists { uvec2 lists[]; };
layout(std430, binding = 4) writeonly buffer Links { uint links[]; }; // elements of contacts
layout(std430, binding = 5) writeonly buffer LinkLists { uvec2 linkLists[]; };
layout(std430, binding = 6) writeonly buffer Points { FacePoints points; };
layout(std430, binding = 7) buffer Bounds { GridBounds bounds; };
layout(std430, binding = 8) readonly buffer Faces { ContactFace faces[]; };
layout(std430, binding = 9) buffer Status { StatusWords status; };
#define GROUPS_BINDING 10
#define LISTS_PARTICLES
#include "listed_groups.glsl"

uint face;
void put(uint element, uint point) {
    uint low = lists[point].x, high = low + lists[point].y;
    while (low < high) {
        const uint middle = (low + high) / 2u;
        if (contacts[middle].other < face) low = middle + 1u;
        else high = middle;
    }
    links[element] = min(low, push.room - 1u); // not there only where the step will be undone
}
#include "sort_pairs.glsl"

void main() {
    const uint f = itemIndex(push.moving);
    if (f == 0u) points = FacePoints(0u, 0u, 0u, 0u); // for the next time
    if (f >= push.moving) return;
    const uint chain = chains[f], all = lengthOf(chain), n = min(all, LIST_MOST);
    if (all > LIST_MOST) atomicMax(status.candidates, CONTACT_MOST_ROOM + 1u); // said, not lost
    uvec2 list = uvec2(0u, n);
    if (n > 0u) {
        list.x = atomicAdd(bounds.links, n);
        listParticle(faces[f].a);
        listParticle(faces[f].b);
        listParticle(faces[f].c);
    }
    face = f;
    sortChain(chain, list.x, n);
    linkLists[f] = list;
    chains[f] = 0u;
}
