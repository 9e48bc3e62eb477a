// How find_contacts regards the ways of particles in a substep: not at all but for SWEPT. In the names of that kernel.
#ifdef SWEPT
vec3 wayOf(uint i) { return step.h * velocities[i].xyz; }
bool isFast(uint i) { return isHurrying(RADIUS(i), wayOf(step.h, velocities[i].xyz), push.quiet, push.most); }
// How far from its end a particle may have touched: counts like a larger radius.
float wideOf(uint i, float radius) {
    const float way = wayOf(step.h, velocities[i].xyz);
    return way > push.quiet ? radius + way : radius;
}
bool wasNear(uint i, uint j, float reach, vec3 d) {
    return nearestSquared(d, wayOf(i) - wayOf(j)) < 1.0001 * reach * reach;
}
#else
bool isFast(uint i) { return false; }
float wideOf(uint i, float radius) { return radius; }
bool wasNear(uint i, uint j, float reach, vec3 d) { return false; }
#endif
