// Conditions of recoils: the speed from which they are taken back, and the particles that take part. Requires the name
// `step` of a kernel.

// The slowest recoil of two particles that is taken back [m/s]; `reach` is the distance at which they touch, or less.
// One that would lift a particle by less than RECOIL_LIFT of it is left.
float leastRecoil(float reach) {
    const float g = length3(step.gravity.xyz);
    return max(max(g * step.h, sqrt(2.0 * RECOIL_LIFT * g * reach)), 1e-4 * reach / step.h);
}

// Whether a particle with this velocity may be one of two that part so fast: of two, one is at least half as fast.
layout(constant_id = 24) const float leastReach = 0.0; // of any pair of the scene [m]
bool mayRecoil(vec3 v) { return 2.0 * length3(v) > leastRecoil(leastReach); }

// Whether a particle has few contacts, as its shares count them.
bool hasFew(float contacts, float w) { return contacts <= RECOIL_PAIRS * w; }
