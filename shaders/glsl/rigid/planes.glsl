// Boundary planes as temporary constraints: C = n . x - offset - contactOffset >= 0, active ones found again in each
// substep. Projected exactly and one after another in the invocation of the particle; a correction c of x adds c / h
// to v.
#include "common/math.glsl"
layout(constant_id = 2) const uint planeCount = 0; // at most 32

// State of a particle during a substep.
struct Motion {
    vec3 x;            // [m]
    vec3 v;            // [m/s]
    vec3 displacement; // since the start of the substep [m]
};

// Keeps a particle in front of a plane; true if it touched. Coulomb friction in position form (Unified Particle
// Physics, 2014): the tangential displacement of this substep is cancelled entirely if the static bound allows, else
// up to friction x depth.
bool projectOntoPlane(PlaneCollider plane, float contactOffset, float h, inout Motion motion) {
    const vec3 n = plane.normalOffset.xyz;
    const float depth = plane.normalOffset.w + contactOffset - dot3(n, motion.x);
    if (depth <= 0.0) return false;
    const vec3 tangential = motion.displacement - dot3(n, motion.displacement) * n;
    const float slip = length3(tangential), most = plane.staticFriction * depth;
    const float friction = slip <= most ? plane.staticFriction : plane.friction;
    const float held = slip > 0.0 ? min(1.0, friction * depth / slip) : 0.0;
    const vec3 correction = depth * n - held * tangential;
    const vec3 x = motion.x + correction, v = motion.v + correction / h, way = motion.displacement + correction;
    motion = Motion(x, v, way);
    return true;
}

// Newton's restitution against the velocity before the substep; impacts slower than restSpeed [m/s] do not rebound,
// or resting contacts would tremble.
vec3 rebound(PlaneCollider plane, float restSpeed, vec3 velocityBefore, vec3 v) {
    const vec3 n = plane.normalOffset.xyz;
    const float before = dot3(n, velocityBefore);
    if (before >= -restSpeed) return vec3(0.0);
    return max(0.0, -plane.restitution * before - dot3(n, v)) * n;
}
