// Shared by the kernels that find pairs of a point and a face: the buffers, and the test. A pair is listed if its
// distance is below the reach, plus a margin, plus the relative motion in this substep: so no pair that meets during
// the substep is missed, however fast, and particles that move together are not listed because of their speed.
#include "common/kernel.glsl"
#include "common/math.glsl"
#include "common/triangle.glsl"
#include "collision/linked_reach.h"

#include "common/fetched.glsl"
FETCHED_VEC4(0, Positions, positionAt)
FETCHED_VEC4(1, Velocities, velocityAt) // w = inverse mass [1/kg]
FETCHED_FLOAT(2, Radii, radiusOf)       // below 0 = touches no face
FETCHED_UINT(8, Excluded, excludedAt)   // first of each face, then points, sorted
#define POSITION(i) positionAt(i)
#define VELOCITY(i) velocityAt(i)
#define RADIUS(i) radiusOf(i)
#define EXCLUDED(k) excludedAt(k)
layout(std430, binding = 3) readonly buffer Faces { ContactFace faces[]; };
layout(std430, binding = 4) buffer PointChains { uint pointChains[]; };
layout(std430, binding = 5) buffer FaceChains { uint faceChains[]; }; // chains of moving faces
layout(std140, binding = 9) uniform Step { StepParams step; };
layout(std430, binding = WEIGHT_BINDING) readonly buffer Masses { float inverseMass[]; }; // also of sleeping particles [1/kg]
layout(push_constant) uniform Push { FaceFindPush push; };
layout(std430, binding = 6) coherent volatile buffer Bounds { GridBounds bounds; };
#define PAIRS_BINDING 7
#define FINDS_PAIRS
#define ENTRIES_OF_PAIR 1u
#include "collision/listed_pairs.glsl"

// A face with its positions and velocities at the end of the substep.
struct Searched {
    uint index;
    ContactFace face;
    vec3 a;
    Triangle triangle;
    vec3 low, high; // box of the corners
    float reach;    // search distance without radius and motion of the point [m]
    float still;    // the same without the motion of the face [m]
    vec3 va, vb, vc; // [m/s]
    vec3 v;          // their mean [m/s]
    float size;      // radius of a ball around the face [m]
    float turning;   // motion of a corner relative to the mean in this substep [m]
    Squares squares;
};

float longestOf(vec3 a, vec3 b, vec3 c) { return sqrt(max(dot(a, a), max(dot(b, b), dot(c, c)))); }

Searched searchedOf(uint f) {
    const ContactFace face = faces[f];
    const vec3 a = POSITION(face.a).xyz, b = POSITION(face.b).xyz, c = POSITION(face.c).xyz;
    const vec3 va = VELOCITY(face.a).xyz, vb = VELOCITY(face.b).xyz, vc = VELOCITY(face.c).xyz;
    const float way = step.h * sqrt(max(dot(va, va), max(dot(vb, vb), dot(vc, vc))));
    const vec3 low = min(a, min(b, c)), high = max(a, max(b, c)), size = high - low;
    const Triangle triangle = triangleOf(b - a, c - a);
    float still = abs(face.thickness) + push.margin;
    if (isSliver(triangle)) still += 1e-3 * length(size); // its edges may be as far apart as that
    const vec3 v = (va + vb + vc) / 3.0;
    return Searched(f, face, a, triangle, low, high, still + way, still, va, vb, vc, v, 0.5 * length(size),
                    step.h * longestOf(va - v, vb - v, vc - v), squaresOf(triangle));
}

#include "collision/excluded.glsl"

// Links between a point and the corners of a face: none; only diagonals, so that the contact distance is
// LINKED_REACH; or links that exclude the contact.
#define BOND_NONE 0u
#define BOND_DIAGONAL 1u
#define BOND_EXCLUDED 2u

layout(constant_id = 1) const bool hasLinks = false; // a body may be cut
layout(std430, binding = LINKS_BINDING) readonly buffer Links { uint links[]; }; // live links of each lattice node
#include "lattice/link_masks.glsl"
#include "lattice/link_ways.glsl"

// Finds the links between a point and a face. The row of a body that may be cut ends with the position of its strides
// in the table, where a further entry says whether diagonal links permit contacts.
uint bondOf(Searched face, uint i) {
    if (isExcluded(face.index, i)) return BOND_EXCLUDED;
    if (!hasLinks) return BOND_NONE;
    const uint end = EXCLUDED(face.index + 1u), last = end > EXCLUDED(face.index) ? EXCLUDED(end - 1u) : 0u;
    if ((last & EXCLUDED_LINKED) == 0u) return BOND_NONE;
    const uint strides = last & ~EXCLUDED_LINKED, rowStride = EXCLUDED(strides), sliceStride = EXCLUDED(strides + 1u);
    uint alive = 0u;
    [[dont_unroll]] for (uint c = 0u; c < 3u; ++c) {
        const uint corner = c == 0u ? face.face.a : c == 1u ? face.face.b : face.face.c;
        alive |= links[corner] & linksTo(int(i) - int(corner), rowStride, sliceStride);
    }
    if (alive == 0u) return BOND_NONE;
    return (alive & EDGE_LINKS) != 0u || EXCLUDED(strides + 2u) == 0u ? BOND_EXCLUDED : BOND_DIAGONAL;
}

// True if x is within `reach` of the face's box; `reach` includes radius and motion of the point.
bool isInBox(Searched face, vec3 x, float reach) {
    const vec3 d = max(max(face.low - x, x - face.high), vec3(0.0));
    return dot(d, d) < reach * reach;
}

// True if a fast point, seen from the centre of a face, stays outside of the ball around the face during the whole
// substep: without this test a body of small faces would be listed completely with it. Its motion in the next substep
// is within the margin, or lists are rebuilt.
bool isBesideWay(Searched face, uint i, vec3 x) {
    const vec3 way = step.h * (VELOCITY(i).xyz - face.v), d = 0.5 * (face.low + face.high) - x;
    const float length2 = dot(way, way);
    if (length2 < face.size * face.size) return false;
    const vec3 apart = d + clamp(-dot(d, way) / length2, 0.0, 1.0) * way;
    const float reach = 1.001 * (face.size + face.still + face.turning + RADIUS(i));
    return dot(apart, apart) > reach * reach;
}

// True if a pair must be listed; the caller tests for excluded pairs. `less`: amount by which the reach of this pair
// is shorter [m].
bool isNear(Searched face, uint i, vec3 x, float less) {
    const uint f = face.index;
    if (i == face.face.a || i == face.face.b || i == face.face.c) return false;
    if (f >= push.moving && inverseMass[i] == 0.0) return false; // neither ever moves
    if (isBesideWay(face, i, x)) return false;
    const vec3 v = VELOCITY(i).xyz, d = nearestOf(x - face.a, face.triangle, face.squares).d;
    const float reach = face.still + RADIUS(i) + step.h * longestOf(v - face.va, v - face.vb, v - face.vc) - less;
    return dot(d, d) < reach * reach;
}

// Lists a pair that passes isNear().
void listUnlessExcluded(Searched face, uint i) {
    const uint bond = bondOf(face, i), f = face.index;
    if (bond == BOND_EXCLUDED) return;
    const float less = (1.0 - LINKED_REACH) * (RADIUS(i) + abs(face.face.thickness));
    if (bond == BOND_DIAGONAL && !isNear(face, i, POSITION(i).xyz, less)) return;
    const uint pair = newPair();
    if (pair == noPair) return;
    const uint next = atomicExchange(pointChains[i], 2u * pair + 1u);
    const uint nextOfFace = f < push.moving ? atomicExchange(faceChains[f], 2u * pair + 2u) : 0u;
    pairs[pair] = uvec4(i, 2u * f + bond, next, nextOfFace);
}
