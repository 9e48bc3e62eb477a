// Watches a particle: whether lists are still complete for it, and whether contacts may lie on its way. Most particles never
// touch the shared words. In the names POSITION, VELOCITY, DETECTED, bounds, radii, fast, step of a kernel, and FRAMES_BINDING.
#include "strays.glsl"

void watchFast(uint i, float way, float quiet, float most) {
    atomicMax(bounds.sweeping, 1u);
    if (!isHurrying(radii[i], way, quiet, most)) return;
    const uint place = atomicAdd(bounds.hurrying, 1u);
    if (place < MOST_FAST) fast[place] = i;
}

// `quiet` and `most` as in GridPush.
void watch(uint i, float quiet, float most) {
    if (radii[i] < 0.0) return; // in no list, such as crumbs that fall for ever
    float farthest;
    if (hasStrayed(i, farthest)) atomicMax(bounds.moved, floatBitsToUint(min(farthest, 1e30)));
    const float far = wayOf(step.h, VELOCITY(i).xyz); // as find_contacts and cap_speeds have it
    if (far > quiet) watchFast(i, far, quiet, most);
}
