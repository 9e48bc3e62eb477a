// Part of take_recoils_back: the contacts of a particle, and how much each may take back. Requires the names and buffers of
// that kernel. A pair is a contact if it touches or counts in shares, both have received impulses along its line, and
// one of them from both sides: else a ball that falls between two others could not part them. Both ends of a pair
// compute equal bits.
#include "common/few_contacts.glsl"

// 0 of a particle that is not prepared.
uint degreeOf(uint i) { return degrees[i] & ~RECOIL_LISTED; }

// Impulses of contacts on a particle [N s]: the tensor (received.glsl), and the sum.
struct Receipt { vec3 diagonal, mixed, net; };
Receipt receiptOf(uint i, vec4 velocity) {
    return Receipt(receivedAt(sectionElement(0u, i)).xyz, receivedAt(sectionElement(1u, i)).xyz,
                   velocity.w > 0.0 ? (velocity.xyz - linkedAt(i).xyz) / velocity.w : vec3(0.0));
}

// Impulses along n, and twice the part of them that came from both sides.
vec2 along(Receipt r, vec3 n) {
    const float all = dot3(n * n, r.diagonal) + 2.0 * dot3(n.xxy * n.yzz, r.mixed);
    return vec2(all, max(0.0, all - abs(dot3(n, r.net))));
}

// Reach of a pair; 0 if it keeps a rest distance.
float reachOf(uint slot, float reach) {
    if (!hasRecovery) return reach;
    const float remembered = slips[slot].w;
    return isKept(remembered) ? 0.0 : reach - nearerBy(remembered);
}

// Adds the contact with the candidate in a slot, if it is one.
void addPair(uint i, uint slot, Receipt own, vec3 x, vec4 velocity, inout uint degree) {
    const uvec2 candidate = contactAt(slot);
    const uint j = candidate.x;
    const vec4 touching = touchingAt(j), other = velocities[j];
    const float reach = reachOf(slot, uintBitsToFloat(candidate.y));
    const bool isStill = other.w == 0.0;
    const bool takesPart = isStill || hasFew(touching.w, other.w) && areFew(near[j]);
    if (!areFreeOf(state[i].w, state[j].w) || !takesPart || reach <= 0.0) return;
    const vec3 d = x - touching.xyz, n = d / sqrt(max(dot3(d, d), 1e-30));
    const vec2 here = along(own, n);
    const vec2 there = isStill ? vec2(here.x, 0.0) : along(receiptOf(j, other), n);
    const float most = min(min(here.x, there.x), max(here.y, there.y));
    const float drift = isStill ? dot3(n, other.xyz) : 0.0;
    if (most > 0.0) recoils[RECOIL_CONTACTS * i + degree++] = Recoil(n.x, n.y, n.z, most, isStill ? RECOIL_STILL | j : j, 0u, drift, 0u);
}

// Finds the contacts of particle i, and gives it its share.
void prepare(uint i, bool starts) {
    const vec4 velocity = velocities[i];
    const Receipt own = receiptOf(i, velocity);
    const vec3 x = touchingAt(i).xyz;
    const uint first = lists[i].x;
    uint degree = 0u;
    const uvec2 few = near[i];
    for (uint n = 0u; n < min(countOf(few), RECOIL_CONTACTS - 1u); ++n)
        addPair(i, first + placeOf(few, n), own, x, velocity, degree);
    const vec4 fixedly = receivedAt(sectionElement(2u, i));
    const float size = length3(fixedly.xyz);
    if (size > 0.0 && areFreeOf(state[i].w, state[i].w)) {
        const vec3 n = fixedly.xyz / size;
        recoils[RECOIL_CONTACTS * i + degree++] = Recoil(n.x, n.y, n.z, size, RECOIL_FIXED, 0u, fixedly.w / size, 0u);
    }
    degrees[i] = RECOIL_LISTED | degree;
    const float share = float(degree) * velocity.w;
    even[i] = odd[i] = vec4(velocity.xyz, starts ? share : -share);
}

int packed(float f, float g) { return (int(f) & 0xffff) | int(g) << 16; }
float first(int bits) { return float(bits << 16 >> 16); }
float second(int bits) { return float(bits >> 16); }

vec3 normalOf(Recoil recoil) { return vec3(recoil.nX, recoil.nY, recoil.nZ); }

// The impulse that a contact takes back [N s].
vec3 takenBy(Recoil recoil) { return first(int(recoil.taken)) * RECOIL_UNIT * recoil.most * normalOf(recoil); }

// Lists particle i, once.
void reach(uint i) {
    if ((atomicOr(degrees[i], RECOIL_LISTED) & RECOIL_LISTED) == 0u) members[push.count + atomicAdd(reached, 1u)] = i;
}

void reachPartners(uint i) {
    for (uint c = 0u; c < degreeOf(i); ++c) {
        const uint other = recoils[RECOIL_CONTACTS * i + c].other;
        if ((other & RECOIL_STILL) == 0u) reach(other);
    }
}

// Adds the impulse of a recoil to the row of the last plane or collider that touched the particle.
void addFixedForce(uint i, vec3 impulse) {
    if (!keepsForces || impulse == vec3(0.0)) return;
    const uvec4 row = receivedBits(sectionElement(3u, i));
    const uint element = row.w & ~isOfFace;
    if (element != row.w) addContactForce(i, impulse);
    forces[element].xyz += impulse;
    forces[element + forceSlots].xyz += cross(uintBitsToFloat(row.xyz), impulse);
}
