// Shared by the kernels that find pairs of a point and a face: the buffers, and the test. A pair is listed if its
// distance is below the reach, plus a margin, plus the approach in this substep or along headings: so no pair that meets
// then is missed, however fast, and particles that move together are not listed because of their speed.
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
#define FINDS_ROWS
#define ENTRIES_OF_PAIR 1u
#include "collision/listed_pairs.glsl"
FETCHED_VEC4(HEADINGS_BINDING, Headings, headingAt)
layout(constant_id = 2) const bool hasHeadings = false;
vec4 headingOrNone(uint i) { return hasHeadings ? headingAt(i) : vec4(0.0); }
#define HEADING(i) headingOrNone(i).xyz
#define LEEWAY(i) headingOrNone(i).w
float horizon = bounds.horizon; // [s]

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
    vec3 wa, wb, wc; // headings [m/s]
    vec3 w;          // their mean [m/s]
    float ahead;     // longest way of a corner along its heading [m]
    float bending;   // the same relative to the mean [m]
    float size;      // radius of a ball around the face [m]
    float turning;   // motion of a corner relative to the mean in this substep [m]
    Squares squares;
};

float longestOf(vec3 a, vec3 b, vec3 c) { return sqrt(max(dot(a, a), max(dot(b, b), dot(c, c)))); }

#include "collision/motion_of.glsl"
vec3 meanOf(vec3 a, vec3 b, vec3 c) { return (a + b + c) / 3.0; }
float motionOf(uint i) { return motionOf(VELOCITY(i).xyz, headingOrNone(i), horizon); }

Searched searchedOf(uint f) {
    const ContactFace face = faces[f];
    const vec3 a = POSITION(face.a).xyz, b = POSITION(face.b).xyz, c = POSITION(face.c).xyz;
    const vec3 va = VELOCITY(face.a).xyz, vb = VELOCITY(face.b).xyz, vc = VELOCITY(face.c).xyz;
    const vec3 wa = HEADING(face.a), wb = HEADING(face.b), wc = HEADING(face.c);
    const float ahead = horizon * longestOf(wa, wb, wc), way = max(step.h * longestOf(va, vb, vc), ahead);
    const vec3 low = min(a, min(b, c)), high = max(a, max(b, c)), size = high - low;
    const Triangle triangle = triangleOf(b - a, c - a);
    const float leeway = max(LEEWAY(face.a), max(LEEWAY(face.b), LEEWAY(face.c)));
    float still = abs(face.thickness) + push.margin + leeway;
    if (isSliver(triangle)) still += 1e-3 * length(size); // its edges may be as far apart as that
    const vec3 v = meanOf(va, vb, vc), w = meanOf(wa, wb, wc);
    return Searched(f, face, a, triangle, low, high, still + way, still, va, vb, vc, v, wa, wb, wc, w, ahead,
                    horizon * longestOf(wa - w, wb - w, wc - w), 0.5 * length(size), step.h * longestOf(va - v, vb - v, vc - v), squaresOf(triangle));
}

#include "collision/face_bonds.glsl"

#include "collision/in_box.glsl"
// `reach` includes radius and motion of the point.
bool isInBox(Searched face, vec3 x, float reach) { return isInBox(face.low, face.high, x, reach); }

// True if a plane square to the line from the face's center to x keeps the two more than `reach` apart.
bool isBeyondPlane(Searched face, vec3 x, float reach) {
    const vec3 a = x - face.a, b = a - face.triangle.ab, c = a - face.triangle.ac, d = a + b + c;
    return min(dot(d, a), min(dot(d, b), dot(d, c))) > 1.001 * reach * length(d);
}

// Distance by which a point may approach the face, in this substep or along headings [m].
float mostApproach(Searched face, uint i) {
    return max(step.h * length(VELOCITY(i).xyz - face.v) + face.turning, horizon * length(HEADING(i) - face.w) + face.bending);
}

// True if a fast point, seen from the centre of a face, stays outside of the ball around the face during the whole
// substep: without this test a body of small faces would be listed completely with it. Its motion after that is along
// its heading and within the margin, or lists are rebuilt.
bool isBesideWay(Searched face, uint i, vec3 x) {
    const vec3 way = step.h * (VELOCITY(i).xyz - face.v), d = 0.5 * (face.low + face.high) - x;
    const float length2 = dot(way, way);
    if (length2 < face.size * face.size) return false;
    const vec3 apart = d + clamp(-dot(d, way) / length2, 0.0, 1.0) * way;
    const float reach = 1.001 * (face.size + face.still + face.turning + face.ahead + horizon * length(HEADING(i)) + RADIUS(i) + LEEWAY(i));
    return dot(apart, apart) > reach * reach;
}

// Distance by which a point and a face, which are d apart, may approach in this substep or along their headings. The
// normal of a plane between them, square to d, separates them at both ends of both ways, and so in between.
float approachOf(Searched face, uint i, vec3 d) {
    const vec3 n = d / max(length(d), 1e-30);
    const float v = dot(n, VELOCITY(i).xyz), w = dot(n, HEADING(i));
    const float back = v - min(dot(n, face.va), min(dot(n, face.vb), dot(n, face.vc)));
    const float on = max(dot(n, face.wa), max(dot(n, face.wb), dot(n, face.wc))) - w;
    return 1.001 * max(0.0, max(step.h * back, horizon * on));
}

bool isCorner(Searched face, uint i) { return i == face.face.a || i == face.face.b || i == face.face.c; }

// True if a pair must be listed; the caller tests for excluded pairs. `less`: amount by which the reach of this pair
// is shorter [m].
bool isNear(Searched face, uint i, vec3 x, float less) {
    const uint f = face.index;
    if (isCorner(face, i)) return false;
    if (f >= push.moving && inverseMass[i] == 0.0) return false; // neither ever moves
    if (isBesideWay(face, i, x)) return false;
    const vec3 d = nearestOf(x - face.a, face.triangle, face.squares).d;
    const float reach = face.still + RADIUS(i) + LEEWAY(i) + approachOf(face, i, d) - less;
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
    const bool isLinked = f < push.moving;
    const uint nextOfFace = isLinked ? atomicExchange(faceChains[f], 2u * pair + 2u) : 0u;
    listOwners(i, next, f, isLinked ? nextOfFace : ~0u);
    pairs[pair] = uvec4(i, 2u * f + bond, next, nextOfFace);
}
