// Part of find_contacts: paths of particles during a substep, against the frames that near particles share. While few
// particles may meet others on their paths, these are fast; in the SWEPT form only those too fast for cells are.
// Requires the names of that kernel.
vec3 wayOf(uint i) { return step.h * velocities[i].xyz; }
float farOf(uint i) { return hasWays ? ways[i] : wayOf(step.h, velocities[i].xyz); }

uint fastParticles = bounds.fast;
#ifdef SWEPT
#define FIRST_FAST 0u
// Largest radius and way of a particle that is found by cells [m].
float mostInCells = max(push.most, uintBitsToFloat(bounds.drivenWay));
bool isFast(uint i) { return isHurrying(RADIUS(i), farOf(i), push.quiet, mostInCells); }
#else
#define mostInCells push.most
#define FIRST_FAST MOST_FAST
bool isFast(uint i) { return fastParticles > 0u && farOf(i) > push.quiet; }
#endif

// A radius enlarged by the path of a particle, on all of which it may have touched others.
float wideOf(uint i, float radius) {
#ifdef SWEPT
    const float way = farOf(i);
    if (way > push.quiet) return radius + way;
#endif
    return radius;
}

bool wasNear(uint i, uint j, float reach, vec3 d) {
    return nearestSquared(d, wayOf(i) - wayOf(j)) < 1.0001 * reach * reach;
}
