// Collects what contacts give a particle, in the kernels that find the impulses. Include forces.glsl first.
#include "forces/received.glsl"
#include "forces/recoil_speed.glsl"

vec3 gotDiagonal = vec3(0.0), gotMixed = vec3(0.0);
vec4 gotFixed = vec4(0.0);
uvec4 gotRow = uvec4(0u);

// An impulse of this size along n.
void receiveAlong(vec3 n, float size) {
    if (!keepsReceived) return;
    const vec3 impulse = size * n;
    gotDiagonal += n * impulse;
    gotMixed += n.xxy * impulse.yzz;
}

void receive(vec3 impulse) {
    if (!keepsReceived) return;
    const float size = length3(impulse);
    receiveAlong(impulse / max(size, 1e-30), size);
}

// True if receive_rows has run: some particles have received impulses of faces before.
layout(constant_id = 25) const bool followsRows = false;

// From a thing that never gives way, whose surface moves with `drift`.
void receiveFixed(vec3 impulse, vec3 drift, uint element, vec3 arm) {
    if (!keepsReceived) return;
    receive(impulse);
    gotFixed += vec4(impulse, dot3(impulse, drift));
    if (keepsForces && impulse != vec3(0.0)) gotRow = uvec4(floatBitsToUint(arm), element);
}

// Plans find_recoils for a particle that ends the substep with v.
void planRecoils(vec3 v, uint count) {
    if (keepsReceived && mayRecoil(v)) received[0] = uvec4((count + GROUP_SIZE - 1u) / GROUP_SIZE, 1u, 1u, 0u);
}

// Begins with what faces gave, once.
void takeFromRows(uint i) {
    if (!followsRows) return;
    const uvec4 diagonal = received[sectionElement(0u, i)];
    if (diagonal.w == 0u) return;
    gotDiagonal = uintBitsToFloat(diagonal.xyz);
    gotMixed = uintBitsToFloat(received[sectionElement(1u, i)].xyz);
    gotFixed = uintBitsToFloat(received[sectionElement(2u, i)]);
    if (keepsForces) gotRow = received[sectionElement(3u, i)];
    received[sectionElement(0u, i)].w = 0u;
}

// The first contacts of a substep store, later ones add. `isOfRows`: 1 for takeFromRows(), else 0.
void storeReceived(uint i, uint isOfRows) {
    if (!keepsReceived) return;
    received[sectionElement(0u, i)] = uvec4(floatBitsToUint(gotDiagonal), isOfRows);
    received[sectionElement(1u, i)] = uvec4(floatBitsToUint(gotMixed), 0u);
    received[sectionElement(2u, i)] = floatBitsToUint(gotFixed);
    if (keepsForces && gotFixed.xyz != vec3(0.0)) received[sectionElement(3u, i)] = gotRow;
}

uvec3 sumOf(uvec3 bits, vec3 more) { return floatBitsToUint(uintBitsToFloat(bits) + more); }

void addReceived(uint i) {
    if (!keepsReceived) return;
    received[sectionElement(0u, i)].xyz = sumOf(received[sectionElement(0u, i)].xyz, gotDiagonal);
    received[sectionElement(1u, i)].xyz = sumOf(received[sectionElement(1u, i)].xyz, gotMixed);
    received[sectionElement(2u, i)] = floatBitsToUint(uintBitsToFloat(received[sectionElement(2u, i)]) + gotFixed);
    if (keepsForces && gotFixed.xyz != vec3(0.0)) received[sectionElement(3u, i)] = gotRow;
}
