#version 460
// Chooses, of the particles that hold what the ray has met, the one nearest to the point. One work group. If the
// ray enters a closed skin at a section plane (its winding number there is not 0), all particles of the body hold it.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"
#include "simulation/pick.h"

layout(std430, binding = 0) readonly buffer Indices { uint indices[]; };
layout(std430, binding = 1) readonly buffer Holders { PickVertex holders[]; };
layout(std430, binding = 2) readonly buffer SheetIndices { uint sheetIndices[]; };
layout(std430, binding = 3) readonly buffer Counts { SurfaceState counts; };
layout(std430, binding = 4) readonly buffer CutIndices { uint cutIndices[]; };
layout(std430, binding = 5) readonly buffer CutRest { CutVertex cutRest[]; };
layout(std430, binding = 6) readonly buffer Particles { uint particles[]; }; // by slot
layout(std430, binding = 7) readonly buffer Positions { vec4 positions[]; };
layout(std430, binding = 8) readonly buffer InverseMasses { float inverseMasses[]; };
layout(std430, binding = 9) readonly buffer Pieces { uint pieces[]; };
layout(std430, binding = 10) readonly buffer Skins { PickSkin skins[]; };
layout(std430, binding = 11) readonly buffer Windings { int windings[]; };
layout(std430, binding = 12) readonly buffer Hits { PickHit hits[]; };
layout(std430, binding = 13) writeonly buffer Answers { PickAnswer answers[]; };
layout(push_constant) uniform Push { PickPush push; };

shared float distances[GROUP_SIZE];
shared uint items[GROUP_SIZE];

// The smallest distance of all lanes and its item; of equal ones the first item.
PickHit nearestOf(float distance, uint item) {
    const uint lane = gl_LocalInvocationID.x;
    barrier();
    distances[lane] = distance;
    items[lane] = item;
    for (uint other = GROUP_SIZE / 2u; other > 0u; other /= 2u) {
        barrier();
        if (lane >= other) continue;
        const uint far = lane + other;
        if (distances[far] < distances[lane] || (distances[far] == distances[lane] && items[far] < items[lane])) {
            distances[lane] = distances[far];
            items[lane] = items[far];
        }
    }
    barrier();
    return PickHit(distances[0], items[0]);
}

// The last closed skin that the ray enters at the section plane, counted from 1; 0 = none.
uint enteredSkin() {
    if (push.isOpened == 0u || push.origin.w >= PICK_FAR) return 0u;
    uint last = 0u;
    for (uint s = gl_LocalInvocationID.x; s < push.skins; s += GROUP_SIZE)
        if (windings[push.ray * push.skins + s] != 0 && skins[s].isClosed != 0u) last = s + 1u;
    return last;
}

// The n-th of up to eight holders of a skin vertex, or NO_PARTICLE.
uint holderOf(uint vertex, uint n, bool isCut) {
    if (isCut && holders[vertex].anchor != NO_PARTICLE) return n == 0u ? holders[vertex].anchor : NO_PARTICLE;
    return holders[vertex].particles[n];
}

// The same for a vertex of the surface of cuts.
uint holderOfCut(uint vertex, uint n) {
    const uint point = cutRest[vertex].point;
    if ((point & SURFACE_PARTICLE) != 0u) return n == 0u ? point ^ SURFACE_PARTICLE : NO_PARTICLE;
    if ((point & SURFACE_SKIN) != 0u) return holderOf(point ^ SURFACE_SKIN, n, true);
    const uint on = point & (SURFACE_RIM - 1u), most = (point & SURFACE_RIM) != 0u ? 2u : 4u;
    return n < most && cutRest[on].shares[n & 3u] > 0.0 ? particles[cutRest[on].corners[n & 3u]] : NO_PARTICLE;
}

// The c-th of up to 24 holders of an item.
uint holderOfItem(uint item, uint c, uint cuts) {
    if (item < push.triangles) return holderOf(indices[3u * item + c / 8u], c & 7u, cuts > 0u);
    item -= push.triangles;
    if (item < push.sheetTriangles) return holderOf(sheetIndices[3u * item + c / 8u], c & 7u, cuts > 0u);
    item -= push.sheetTriangles;
    if (item < push.particles) return c == 0u ? item : NO_PARTICLE;
    item -= push.particles;
    return holderOfCut(cutIndices[3u * item + c / 8u], c & 7u);
}

void main() {
    const uint lane = gl_LocalInvocationID.x, cuts = push.hasCuts == 0u ? 0u : counts.inside + counts.outside;
    PickHit own = PickHit(PICK_FAR, NO_PARTICLE);
    for (uint i = lane; i < push.hits; i += GROUP_SIZE) {
        const PickHit hit = hits[push.firstHit + i];
        if (hit.distance < own.distance || (hit.distance == own.distance && hit.item < own.item)) own = hit;
    }
    PickHit met = nearestOf(own.distance, own.item);
    const uint entered = NO_PARTICLE - nearestOf(0.0, NO_PARTICLE - enteredSkin()).item;
    if (entered > 0u) met.distance = push.origin.w;
    const vec3 point = push.origin.xyz + met.distance * push.direction.xyz;
    const uint count = entered > 0u ? skins[entered - 1u].particleCount : met.distance < PICK_FAR ? 24u : 0u;
    PickHit best = PickHit(PICK_FAR, NO_PARTICLE);
    for (uint c = lane; c < count; c += GROUP_SIZE) {
        const uint particle =
            entered > 0u ? skins[entered - 1u].firstParticle + c : holderOfItem(met.item, c, cuts);
        if (particle == NO_PARTICLE || pieces[particle] == REMOVED_PIECE) continue;
        if (push.isMoving != 0u && inverseMasses[particle] == 0.0) continue;
        const vec3 apart = positions[particle].xyz - point;
        if (dot(apart, apart) < best.distance) best = PickHit(dot(apart, apart), particle);
    }
    best = nearestOf(best.distance, best.item);
    if (lane > 0u) return;
    const vec3 place = best.item == NO_PARTICLE ? vec3(0.0) : positions[best.item].xyz;
    answers[push.ray] = PickAnswer(vec4(point, met.distance), float[3](place.x, place.y, place.z), best.item);
}
