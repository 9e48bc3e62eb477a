// Colliders of bounded shape as temporary constraints: a core box grown by a radius, which is a sphere if the box is
// a point and a capsule if it is a line. All is computed in the frame of the collider, in which it stands still: the
// path of a particle leads from s0, relative to the collider at the start of the substep, to s1, relative to the
// collider at its end. Shapes are convex. So the gap is convex along the path, and Newton's iteration on it
// approaches the surface from outside and never passes it; a particle in front of a tangent plane is outside. The
// result is always such a plane.
#include "rigid/pose.glsl"

layout(constant_id = 2) const uint colliderCount = 1;
layout(constant_id = 3) const bool isMoving = false; // any of them
layout(constant_id = 4) const uint hostColliderCount = 0;    // number of kinematic colliders, which come first and may be absent

// Speed at which a particle inside a collider is moved out [m/s]; the motion adds nothing to its velocity.
const float leavingSpeed = 1.0;

float largest(vec3 v) { return max(abs(v.x), max(abs(v.y), abs(v.z))); }

// A tangent plane of the shape.
struct Surface {
    float gap; // distance of a point above the plane [m]
    vec3 n;    // outward
};

// The tangent plane nearest to s. Inside the core, and at its centre, it is that of the nearest face.
Surface surfaceAt(vec3 core, float radius, vec3 s) {
    const vec3 outward = s - clamp(s, -core, core);
    const float distance = length(outward);
    if (distance > 1e-12) return Surface(distance - radius, outward / distance);
    const vec3 depth = core - abs(s), side = mix(vec3(1.0), vec3(-1.0), lessThan(s, vec3(0.0)));
    if (depth.y <= min(depth.x, depth.z)) return Surface(-depth.y - radius, vec3(0.0, side.y, 0.0));
    return depth.x <= depth.z ? Surface(-depth.x - radius, vec3(side.x, 0.0, 0.0))
                              : Surface(-depth.z - radius, vec3(0.0, 0.0, side.z));
}

// The tangent plane at which the path s0 + t d enters, relative to the end of the path: `gap` is below 0 if the path
// enters. Newton's iterates lie outside, so the plane of each of them is valid; eight are enough for all paths that
// do not graze.
Surface entered(vec3 core, float radius, vec3 s0, vec3 d, Surface start, float noise) {
    Surface at = start;
    float t = 0.0;
    for (uint iterate = 0u; iterate < 8u && at.gap > noise; ++iterate) {
        const float slope = dot(at.n, d);
        t += slope < 0.0 ? at.gap / -slope : 1.0; // a path that leaves the nearest plane never returns
        if (t >= 1.0) return Surface(0.0, at.n);
        at = surfaceAt(core, radius, s0 + t * d);
    }
    return Surface(at.gap + (1.0 - t) * dot(at.n, d), at.n);
}

// The plane that a particle must stay in front of, and its distance above it; a gap of at least 0 is no contact.
Surface contactOf(vec3 core, float radius, vec3 s1, vec3 d, Surface start, float noise) {
    const Surface end = surfaceAt(core, radius, s1);
    if (start.gap + end.gap > length(d)) return end; // cannot have come near
    // A particle that slid along the surface is moved back to it. All others get the plane of the point at which they
    // entered: the plane of an impact.
    const bool isInFront = end.gap - dot(end.n, d) >= -noise; // the path began before the plane nearest to its end
    if (end.gap < 0.0 && start.gap <= noise && isInFront) return end;
    // A particle that starts inside, but for the outer quarter, may leave on the other side.
    const float quarter = 0.25 * (min(core.x, min(core.y, core.z)) + radius);
    if (end.gap >= 0.0 && start.gap < -quarter) return end;
    return entered(core, radius, s1 - d, d, start, noise);
}

// State of a particle during a substep.
struct Movement {
    vec3 x;      // [m]
    vec3 v;      // [m/s]
    vec3 way;    // displacement since the substep began [m]
    vec3 pushed; // the part of it that added no velocity [m]
};

// Keeps a particle out of a collider with pose `before` at the start of the substep and `after` now; true if it
// touched. Coulomb friction in position form, as at planes: the tangential displacement relative to the moving
// surface is cancelled entirely if the static bound allows, else up to kinetic friction x the normal correction.
bool projectOut(Collider collider, float contactOffset, ColliderPose before, ColliderPose after, float h,
                inout Movement movement, out vec3 n, out vec3 surfaceVelocity) {
    const float grown = collider.core.w + contactOffset, radius = max(grown, 0.0);
    const vec3 core = max(collider.core.xyz + min(grown, 0.0), vec3(0.0)), s1 = toLocal(after, movement.x);
    vec3 d = rotated(vec4(-before.rotation.xyz, before.rotation.w), movement.way);
    // a collider that stands still in this substep gives the same bits as one that never moves
    const bool moves = isMoving && (before.position.xyz != after.position.xyz || before.rotation != after.rotation);
    if (moves) d += s1 - toLocal(before, movement.x);
    const Surface start = surfaceAt(core, radius, s1 - d);
    const float noise = 1e-6 * (largest(movement.x) + largest(s1));
    const Surface contact = contactOf(core, radius, s1, d, start, noise);
    const float inside = max(-start.gap, 0.0), leaving = min(inside, leavingSpeed * h);
    const float pressed = max(-contact.gap - inside, 0.0), depth = max(leaving - contact.gap - inside, 0.0);
    if (contact.gap >= 0.0 || depth <= 0.0) return false;
    const vec3 tangential = d - dot(contact.n, d) * contact.n;
    const float slip = length(tangential), most = collider.friction * pressed;
    const float held = slip <= collider.staticFriction * pressed ? 1.0 : min(1.0, most / slip);
    const vec3 correction = rotated(after.rotation, pressed * contact.n - held * tangential);
    n = rotated(after.rotation, contact.n);
    const vec3 pushed = (depth - pressed) * n;
    // A correction that cancels displacement without velocity adds none either: else, of two colliders that both
    // push, one would add velocity.
    const float outward = dot(n, movement.pushed);
    const vec3 undone = clamp(-outward, 0.0, pressed) * n - held * (movement.pushed - outward * n);
    movement.x += correction + pushed;
    movement.way += correction + pushed;
    movement.v += (correction - undone) / h;
    movement.pushed += pushed + undone;
    surfaceVelocity = vec3(0.0);
    if (moves) surfaceVelocity = (movement.x - toWorld(before, toLocal(after, movement.x))) / h;
    return true;
}

// Newton's restitution against the velocity before the substep, relative to the surface; impacts slower than
// restSpeed [m/s] do not rebound, or resting contacts would tremble.
vec3 reboundFrom(Collider collider, float restSpeed, vec3 n, vec3 surfaceVelocity, vec3 velocityBefore, vec3 v) {
    const float before = dot(n, velocityBefore - surfaceVelocity);
    if (before >= -restSpeed) return vec3(0.0);
    return max(0.0, -collider.restitution * before - dot(n, v - surfaceVelocity)) * n;
}
