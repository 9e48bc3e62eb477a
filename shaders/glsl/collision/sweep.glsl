// Part of find_contacts: paths of particles during a substep, which count in the SWEPT form only. Requires the names
// of that kernel.
#ifdef SWEPT
vec3 wayOf(uint i) { return step.h * velocities[i].xyz; }
bool isFast(uint i) { return isHurrying(RADIUS(i), wayOf(step.h, velocities[i].xyz), push.quiet, push.most); }
// A radius enlarged by the path of a particle, on all of which it may have touched others.
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
