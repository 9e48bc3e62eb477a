// Colliders of bounded shape as temporary constraints: a core box grown by a radius, which is a sphere where the box is a
// point and a capsule where it is a line. Everything is done in the collider's own frame, in which it stands still: the way
// of a particle leads from s0, seen from where the collider was when the substep began, to s1, seen from where it then is.
// Shapes are convex. So the gap is convex along the way, and Newton's iteration on it comes to the surface from outside and
// never passes it; and a particle in front of a tangent plane is outside. What is found is always such a plane.
#include "pose.glsl"

layout(constant_id = 2) const uint colliderCount = 1;
layout(constant_id = 3) const bool isMoving = false; // any of them
layout(constant_id = 4) const uint pokeCount = 0;    // the first ones, which may be absent

// How fast one that is inside is moved out [m/s]; it is given no speed by that.
const float leavingSpeed = 1.0;

float largest(vec3 v) { return max(abs(v.x), max(abs(v.y), abs(v.z))); }

// A plane that touches the shape.
struct Surface {
    float gap; // of a point above it [m]
    vec3 n;    // outward
};

// The one nearest to s; inside the core, and at its middle, that of the nearest face.
Surface surfaceAt(vec3 core, float radius, vec3 s) {
    const vec3 outward = s - clamp(s, -core, core);
    const float distance = length(outward);
    if (distance > 1e-12) return Surface(distance - radius, outward / distance);
    const vec3 depth = core - abs(s), side = mix(vec3(1.0), vec3(-1.0), lessThan(s, vec3(0.0)));
    if (depth.y <= min(depth.x, depth.z)) return Surface(-depth.y - radius, vec3(0.0, side.y, 0.0));
    return depth.x <= depth.z ? Surface(-depth.x - radius, vec3(side.x, 0.0, 0.0))
                              : Surface(-depth.z - radius, vec3(0.0, 0.0, side.z));
}

// Where the way s0 + t d enters, seen from its end: `gap` is below 0 if it does. Newton's iterates lie outside, so that the
// plane of any of them holds: eight are enough for all ways that do not graze.
Surface entered(vec3 core, float radius, vec3 s0, vec3 d, Surface start, float noise) {
    Surface at = start;
    float t = 0.0;
    for (uint iterate = 0u; iterate < 8u && at.gap > noise; ++iterate) {
        const float slope = dot(at.n, d);
        t += slope < 0.0 ? at.gap / -slope : 1.0; // away from the nearest plane is away for good
        if (t >= 1.0) return Surface(0.0, at.n);
        at = surfaceAt(core, radius, s0 + t * d);
    }
    return Surface(at.gap + (1.0 - t) * dot(at.n, d), at.n);
}

// Which plane a particle must stay in front of, and how far it is above it; a gap of at least 0 is no contact.
Surface contactOf(vec3 core, float radius, vec3 s1, vec3 d, Surface start, float noise) {
    const Surface end = surfaceAt(core, radius, s1);
    if (start.gap + end.gap > length(d)) return end; // cannot have come near
    // What has slid along the surface is put back to it. All else has the plane of where it came in: it is that of an impact.
    const bool isInFront = end.gap - dot(end.n, d) >= -noise; // the way began before the plane nearest to its end
    if (end.gap < 0.0 && start.gap <= noise && isInFront) return end;
    // From within the outer quarter nothing leaves on the other side.
    const float quarter = 0.25 * (min(core.x, min(core.y, core.z)) + radius);
    if (end.gap >= 0.0 && start.gap < -quarter) return end;
    return entered(core, radius, s1 - d, d, start, noise);
}

// Where a particle is in a substep.
struct Movement {
    vec3 x;      // [m]
    vec3 v;      // [m/s]
    vec3 way;    // since the substep began [m]
    vec3 pushed; // part of it that gave no speed [m]
};

// Keeps a particle out of a collider that was at `before` when the substep began and is at `after` now; true if it touched.
// Coulomb friction in position form, as at planes: the tangential way relative to the surface, which moves, is taken back
// whole if the static bound allows, else up to kinetic friction x what the surface pressed.
bool projectOut(Collider collider, float contactOffset, ColliderPose before, ColliderPose after, float h,
                inout Movement movement, out vec3 n, out vec3 surfaceVelocity) {
    const float grown = collider.core.w + contactOffset, radius = max(grown, 0.0);
    const vec3 core = max(collider.core.xyz + min(grown, 0.0), vec3(0.0));
    const vec3 s1 = toLocal(after, movement.x);
    vec3 d = rotated(vec4(-before.rotation.xyz, before.rotation.w), movement.way);
    // what stands still in this substep is to the last bit as where nothing moves
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
    // A correction that takes back a way which gave no speed gives none either: between two colliders each would push, and one of them give a speed.
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

// Newton's restitution against the velocity before the substep, relative to the surface; impacts slower than restSpeed [m/s]
// do not rebound, or resting contacts would tremble.
vec3 reboundFrom(Collider collider, float restSpeed, vec3 n, vec3 surfaceVelocity, vec3 velocityBefore, vec3 v) {
    const float before = dot(n, velocityBefore - surfaceVelocity);
    if (before >= -restSpeed) return vec3(0.0);
    return max(0.0, -collider.restitution * before - dot(n, v - surfaceVelocity)) * n;
}
