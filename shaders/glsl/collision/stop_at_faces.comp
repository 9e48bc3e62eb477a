#version 460
// Keeps particles in front of static and driven faces, one after another in the invocation of the particle, after all
// contacts: contacts divide the mass of a particle, and where bodies are pressed together in one substep a share is
// too small to keep a side. This pass keeps the side on which a substep begins. A particle whose path crosses a face,
// or ends far too near, is put back in front of it. This adds no more velocity than cancels its approach to the face
// in this substep. All other particles stay unchanged to the bit.
// After impact zones it runs once more, and then stops only paths through a face.
#extension GL_GOOGLE_include_directive : require
#define VISITS_SLOTS
#include "common/kernel.glsl"
#include "common/remainder.glsl"
#include "common/triangle.glsl"

#include "collision/near_faces.glsl"
#include "common/fetched.glsl"
FETCHED_UINT(6, Excluded, excludedAt) // first of each face, then points, sorted
FETCHED_VEC4(10, Memory, memoryAt)    // w: side and overlap (contact_memory.glsl)
#define EXCLUDED(k) excludedAt(k)
#define MEMORY(k) memoryAt(k)
layout(std430, binding = 4) readonly buffer Lists { uvec2 lists[]; };
layout(std430, binding = 5) readonly buffer Radii { float radii[]; };       // below 0 = touches no face
layout(std430, binding = 7) buffer Positions { vec4 positions[]; };         // x + thetaH v (remainder.glsl)
layout(std430, binding = 8) buffer Velocities { vec4 velocities[]; };       // w = inverse mass [1/kg]
layout(std140, binding = 9) uniform Step { StepParams step; };
layout(push_constant) uniform Push { StopPush push; };
#define STOPS
#include "forces/forces.glsl"
#include "forces/receive.glsl"
uint stoppedBy; // the face of the last stop
#include "collision/excluded.glsl"
#include "collision/face_stop.glsl"

// Lists hold all that is near the predicted path, so they hold all faces met by a path that ends within the radius of
// the predicted position. For a path that ends farther away all faces are tested.
struct Search {
    bool isListed;
    uint first, end; // elements of the list, or faces
};

bool isNearPredicted(uint i, vec3 x) {
    const vec3 off = x - PREDICTED(i).xyz;
    return dot(off, off) <= radii[i] * radii[i];
}

Search searchFor(uint i, uint firstListed, uint endListed, vec3 x) {
    if (isNearPredicted(i, x)) return Search(true, firstListed, endListed);
    return Search(false, push.moving, push.faces);
}

// The remaining part of an overlap in recovery.
float leftOf(uint element) { return max(0.0, abs(MEMORY(element).w) - 1.0); }

// The most urgent stop on the path from x0 to x1.
Stop stopOf(uint i, Search search, vec3 x0, vec3 x1) {
    Stop first = noStop;
    for (uint s = search.first; s < search.end; ++s) {
        const uint f = search.isListed ? CONTACT(s).x : s;
        const ContactFace face = faceAt(f);
        const float touching = radii[i] + abs(face.thickness), left = search.isListed ? min(leftOf(s), touching) : 0.0; // a rest distance is rounded
        const vec3 seen = search.isListed ? PREDICTED(i).xyz : x1; // a face farther away may be in no list
        const Stop stop = stopAt(face, touching - left, x0, x1, seen);
        if (!(stop.urgency > first.urgency) || isExcluded(f, i)) continue;
        first = stop;
        stoppedBy = f;
    }
    return first;
}

// In a corner of faces a particle put in front of one may be behind the next. A particle without a place moves with
// the last face.
const uint mostStops = 4u;

// The impulse of one stop, stored until it is certain that the particle receives it.
struct Given {
    uint face;
    vec3 change, x; // change of the velocity [m/s]; position [m]
};

// The velocity of face f where it is nearest to x.
vec3 driftOf(uint f, vec3 x) {
    const ContactFace face = faceAt(f);
    const vec3 a = PREDICTED(face.a).xyz;
    const vec3 b = nearestOf(x - a, triangleOf(PREDICTED(face.b).xyz - a, PREDICTED(face.c).xyz - a)).weights;
    return b.x * PREDICTED_VELOCITY(face.a).xyz + b.y * PREDICTED_VELOCITY(face.b).xyz + b.z * PREDICTED_VELOCITY(face.c).xyz;
}

// Recoils: the particle has received the impulses of its stops.
void receiveStops(uint i, Given given[mostStops + 1u], uint count, vec4 velocity) {
    for (uint s = 0u; s < (keepsReceived ? count : 0u); ++s) {
        const uvec2 row = keepsForces ? stopRows[given[s].face] : uvec2(0u);
        const vec3 arm = keepsForces ? given[s].x - places[row.y].xyz : vec3(0.0);
        receiveFixed(given[s].change / velocity.w, driftOf(given[s].face, given[s].x), rowElement(row.x, i) | isOfFace, arm);
    }
    addReceived(i);
    planRecoils(velocity.xyz, receivedSlots);
}

void main() {
    const uint i = itemIndex(push.count);
    if (i == ~0u) return;
    const uint begin = lists[i].x, listEnd = begin + lists[i].y;
    uint first = listEnd;
    for (; first > begin && CONTACT(first - 1u).x >= push.moving; --first) {}
    const vec4 velocity = velocities[i];
    const vec3 x = positions[i].xyz - step.thetaH * velocity.xyz, x0 = PREDICTED(i).xyz - step.h * PREDICTED_VELOCITY(i).xyz;
    if (velocity.w == 0.0 || radii[i] < 0.0 || first == listEnd && isNearPredicted(i, x)) return;
    vec3 end = x, v = velocity.xyz;
    Given given[mostStops + 1u];
    uint givenCount = 0u;
    for (uint stops = 0u; stops <= mostStops; ++stops) {
        const Stop stop = stopOf(i, searchFor(i, first, listEnd, end), x0, end);
        const bool isLast = stops == mostStops;
        if (stop.urgency <= (isLast ? 1.0 : 0.0)) break;
        const vec3 n = stop.n, stopped = isLast ? stop.carried : end + stop.rise * n;
        const vec3 meanwhile = (stopped - x0) / step.h; // the velocity that leads there
        const vec3 slower = v;
        v = isLast ? meanwhile : v + max(0.0, dot(n, meanwhile - v)) * n;
        given[givenCount++] = Given(stoppedBy, v - slower, stopped);
        end = isLast ? stopped : stopped + stop.lift * n;
    }
    if (end == x) return;
    for (uint s = 0u; s < (keepsForces ? givenCount : 0u); ++s) {
        addContactForce(i, given[s].change / velocity.w);
        addStopForce(given[s].face, i, given[s].change / velocity.w, given[s].x);
    }
    receiveStops(i, given, givenCount, vec4(v, velocity.w));
    velocities[i].xyz = v;
    const vec3 change = end - x + step.thetaH * (v - velocity.xyz);
    if (hasRemainders) {
        const uint r = remainderOf(positions.length(), i);
        const Sum sum = exactSum(positions[i].xyz, change + positions[r].xyz);
        positions[i].xyz = sum.rounded;
        positions[r].xyz = sum.remainder;
    } else {
        positions[i].xyz = end + step.thetaH * v;
    }
}
