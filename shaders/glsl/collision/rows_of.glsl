// Visits the rows (row.glsl) of a particle in a fixed order; a kernel defines visit().
layout(std430, binding = 0) readonly buffer Lists { uvec2 lists[]; };          // one per owner: first element, count
#include "common/fetched.glsl"
FETCHED_VEC4(1, Directions, directionAt) // n; above 0 = the row counts
FETCHED_VEC4(2, Weights, weightAt)       // see row.glsl
#define DIRECTION(k) directionAt(k)
#define WEIGHT(k) weightAt(k)
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
    if (!areEdges) visitList(lists[i], 0u);
    for (uint k = corners[i]; k < cornerEnds[i]; ++k) {
        const uint shape = corners[k] / 4u, corner = corners[k] % 4u;
        if (areEdges) visitList(lists[shape], corner);
        const uvec2 linked = linkLists[shape];
        for (uint link = linked.x; link < linked.x + linked.y; ++link) visit(links[link], otherPlace + corner);
    }
}
