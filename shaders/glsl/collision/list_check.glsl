// Checks for a particle whether lists are still complete, and whether contacts may lie on its path. Most particles
// never access the shared words. Requires VELOCITY, DETECTED, bounds, radii, fast, step of a kernel, and
// FRAMES_BINDING.
#include "collision/strays.glsl"

void checkFast(uint i, float way, float quiet, float most) {
    if (radii[i] < 0.0) return; // in no list
    atomicMax(bounds.sweeping, 1u);
    if (!isHurrying(radii[i], way, quiet, most)) return;
    const uint place = atomicAdd(bounds.hurrying, 1u);
    if (place < MOST_FAST) fast[place] = i;
}

// `quiet` and `most` as in GridPush.
void checkLists(uint i, vec3 x, vec3 v, float quiet, float most) {
    float farthest;
    if (hasStrayed(i, x, v, farthest)) atomicMax(bounds.moved, floatBitsToUint(clamp(farthest, 1e-30, 1e30)));
    const float far = wayOf(step.h, v); // see find_contacts and clamp_speeds
    if (far > quiet) checkFast(i, far, quiet, most);
}
