// Visits the rows (row.glsl) of a particle in a fixed order; a kernel defines visit().
layout(std430, binding = 0) readonly buffer Lists { uvec2 lists[]; };          // one per owner: first element, count
#ifdef TEXELS
layout(binding = 1) uniform samplerBuffer directions;
layout(binding = 2) uniform samplerBuffer weights;
#define DIRECTION(k) texelFetch(directions, int(k))
#define WEIGHT(k) texelFetch(weights, int(k))
#else
layout(std430, binding = 1) readonly buffer Directions { vec4 directions[]; }; // n; above 0 = the row counts
layout(std430, binding = 2) readonly buffer Weights { vec4 weights[]; };       // see row.glsl
#define DIRECTION(k) directions[k]
#define WEIGHT(k) weights[k]
#endif
layout(std430, binding = 3) readonly buffer Corners { uint corners[]; };       // first of each particle; then 4 x face, or edge, + corner, or end
layout(std430, binding = 4) readonly buffer Links { uint links[]; };           // one per moving face, or edge: elements in lists of others
layout(std430, binding = 5) readonly buffer LinkLists { uvec2 linkLists[]; };  // ranges in links, of each of these
layout(std430, binding = 6) readonly buffer CornerEnds { uint cornerEnds[]; }; // one per particle: end of its existing entries in `corners`
layout(push_constant) uniform Push { FacePush push; };
#include "collision/row.glsl"

// The particle has this place in the row.
void visit(uint element, uint place);

void visitList(uvec2 list, uint place) {
    for (uint element = list.x; element < list.x + list.y; ++element) visit(element, place);
}

void visitRows(uint i) {
#ifndef EDGES
    visitList(lists[i], 0u);
#endif
    for (uint k = corners[i]; k < cornerEnds[i]; ++k) {
        const uint shape = corners[k] / 4u, corner = corners[k] % 4u;
#ifdef EDGES
        visitList(lists[shape], corner);
#endif
        const uvec2 linked = linkLists[shape];
        for (uint link = linked.x; link < linked.x + linked.y; ++link) visit(links[link], OTHER_PLACE + corner);
    }
}
