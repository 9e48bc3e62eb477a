#version 460
// Links every moving face, or every edge, that has found pairs to its rows in the lists of others, sorted by owner, so that its
// corners find the impulses of those contacts. Lists the groups of particles with contacts.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "common/kernel.glsl"

layout(push_constant) uniform Push { FaceFindPush push; };
#define PAIRS_BINDING 0
#define ENTRIES_OF_PAIR 1u
#include "collision/listed_pairs.glsl"
layout(std430, binding = 1) buffer Chains { uint chains[]; }; // chains of links
layout(std430, binding = 2) readonly buffer Contacts { ContactCandidate contacts[]; };
layout(std430, binding = 3) readonly buffer Lists { uvec2 lists[]; };
layout(std430, binding = 4) buffer Links { uint links[]; }; // elements of contacts
layout(std430, binding = 5) writeonly buffer LinkLists { uvec2 linkLists[]; };
layout(std430, binding = 6) buffer Bounds { GridBounds bounds; };
layout(std430, binding = 7) readonly buffer Shapes { uvec4 shapes[]; }; // ContactFace or ContactEdge
#include "collision/row_kind.glsl"
layout(std430, binding = 8) buffer Status { StatusWords status; };
#define GROUPS_BINDING 9
#define LISTS_PARTICLES
#include "collision/listed_groups.glsl"

// A point lists its own group in sort_lists.
void listParticles(uint shape) {
    listParticle(shapes[shape].x);
    listParticle(shapes[shape].y);
    if (!areEdges) listParticle(shapes[shape].z);
}

uint shape;
void place(uint link, uint owner) { links[link] = owner; }
void complete(uint link) {
    const uint owner = links[link];
    uint low = lists[owner].x, high = low + lists[owner].y;
    while (low < high) {
        const uint middle = (low + high) / 2u;
        if (contacts[middle].other < shape) low = middle + 1u;
        else high = middle;
    }
    links[link] = min(low, push.room - 1u); // missing only if the step will be undone
}
#include "collision/sort_pairs.glsl"

void main() {
    const uint owners = areEdges ? bounds.owners : 0u, all = max(owners, bounds.linked), k = itemIndex(all);
    if (k < owners) listParticles(ownerAt(k));
    if (k >= bounds.linked) return;
    const uint f = ownerAt(push.points + k), chain = chains[f], length = lengthOf(chain), n = min(length, LIST_MOST);
    if (length > LIST_MOST) atomicMax(status.candidates, CONTACT_MOST_ROOM + 1u); // reported as overflow
    const uvec2 list = uvec2(atomicAdd(bounds.links, n), n);
    listParticles(f);
    shape = f;
    sortChain(chain, list.x, n);
    linkLists[f] = list;
    chains[f] = 0u;
}
