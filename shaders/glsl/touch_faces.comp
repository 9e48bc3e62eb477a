#version 460
// Contacts with faces, first pass: where each point touches each face near it, looking at the whole way of the substep, from
// x - h v to x. A face has two sides. Which one a point is on is where it came from: while the two touch it is remembered,
// so that a point that has sunk through is pushed back out of the side that it sank in from. Where they do not touch,
// nothing is, and what is through and beyond reach is let go: results do not depend on when lists are made.
//
// What a contact does to a particle is weighed by beta, 1 for the point and b for the corners; directions n are unit:
//   C = n . (x - sum_k b_k x_k) - reach,   dC/dx = beta n.
#extension GL_GOOGLE_include_directive : require
#include "kernel.glsl"
#include "triangle.glsl"

layout(std430, binding = 0) readonly buffer Predicted { vec4 predicted[]; };
layout(std430, binding = 1) readonly buffer Velocities { vec4 velocities[]; };
layout(std430, binding = 2) readonly buffer Faces { ContactFace faces[]; };
layout(std430, binding = 3) readonly buffer Contacts { uvec2 contacts[]; }; // ContactCandidate, in one load
layout(std430, binding = 4) readonly buffer Counts { uint counts[]; };
layout(std430, binding = 5) readonly buffer Memory { vec4 memory[]; };       // w: side and overlap, 0 = has not touched
layout(std430, binding = 6) buffer Directions { vec4 directions[]; }; // n, depth [m]; 0 = does not touch; below 0 = see hide
layout(std430, binding = 7) buffer Weights { vec4 weights[]; };       // b, side
layout(std140, binding = 8) uniform Step { StepParams step; };
layout(push_constant) uniform Push { FacePush push; };
#include "recovery.glsl"
#include "hidden_faces.glsl"

struct Touch {
    vec3 n;
    float depth;    // > 0 where they touch [m]
    vec3 b;
    float remembered; // the side, 1 = where the normal points, and the overlap
    bool isThrough; // the point is beyond the face's plane, and came through the face
    ContactFace face;
};

// Whether a point that has passed a plane went through the face in it: on straight ways, where it was in the plane. A face
// that turns was not quite there; what it never was within reach of may be in no list.
bool hasPassed(vec3 ap, vec3 ab, vec3 ac, float reach, out vec3 b) {
    b = weightsOf(ap, triangleOf(ab, ac));
    const bool isInside = min(b.x, min(b.y, b.z)) >= -1e-3; // of two faces at an edge at least one sees it
    b = max(b, vec3(0.0));
    b /= b.x + b.y + b.z;
    const vec3 d = ap - b.y * ab - b.z * ac;
    return isInside && dot(d, d) < reach * reach;
}

// `through`: the side that a neighbouring face is being passed from, as a unit vector; 0 = none.
Touch touchOf(uint i, uint element, vec3 through) {
    const uvec2 candidate = contacts[element];
    const ContactFace face = faces[candidate.x];
    const float reach = uintBitsToFloat(candidate.y), h = step.h;
    const vec3 a = predicted[face.a].xyz, va = velocities[face.a].xyz;
    const vec3 ap = predicted[i].xyz - a, ab = predicted[face.b].xyz - a, ac = predicted[face.c].xyz - a;
    const vec3 vp = velocities[i].xyz - va, vb = velocities[face.b].xyz - va, vc = velocities[face.c].xyz - va;
    const Triangle triangle = triangleOf(ab, ac), before = triangleOf(ab - h * vb, ac - h * vc);
    Touch touch = Touch(vec3(0.0), 0.0, vec3(0.0), 0.0, false, face);
    if (isSliver(triangle)) return touch;
    const Nearest nearest = nearestOf(ap, triangle);
    const vec3 normal = normalize(triangle.normal);
    const float height = dot(normal, ap);
    const float heightBefore = dot(before.normal, ap - h * vp) / max(length(before.normal), 1e-30);
    const bool isForced = dot(through, through) > 0.0;
    float side = isForced ? (dot(normal, through) < 0.0 ? -1.0 : 1.0) : sideOf(memory[element].w);
    const bool hasTouched = side != 0.0;
    if (!hasTouched) side = heightBefore < 0.0 ? -1.0 : 1.0;
    vec3 b = nearest.weights;
    if (side * height < 0.0) {
        if (isForced || hasTouched && side * heightBefore < 0.0) {
            touch.isThrough = dot(nearest.d, nearest.d) < reach * reach; // what is farther may be in no list: let go
        } else {
            vec3 passed;
            const float back = h * height / (height - heightBefore); // since it was in the plane [s]
            touch.isThrough = hasPassed(ap - back * vp, ab - back * vb, ac - back * vc, reach, passed);
            if (touch.isThrough && !nearest.isInside) b = passed;
        }
        if (!touch.isThrough) side = -side; // it went around, or is far beyond
    }
    const float distance = length(nearest.d);
    const bool isAbove = touch.isThrough || nearest.isInside || distance < 1e-15;
    touch.n = isAbove ? side * normal : nearest.d / distance;
    touch.b = b;
    const float overlap = reach - (isAbove ? side * height : distance), approach = -h * dot(touch.n, vp - b.y * vb - b.z * vc);
    const float left = overlapLeft(memory[element].w, overlap, approach, push.recoverySpeed * h);
    touch.depth = max(0.0, overlap - left);
    if (candidate.x >= push.moving) touch.depth = withCorners(touch.depth, b, triangle, reach);
    touch.remembered = rememberedOf(side, touch.depth, left);
    return touch;
}

void write(uint element, Touch touch) {
    directions[element] = vec4(touch.n, touch.depth);
    weights[element] = vec4(touch.b, touch.remembered);
}

bool areNeighbours(ContactFace one, ContactFace other) {
    return isCorner(one.a, other) || isCorner(one.b, other) || isCorner(one.c, other);
}

void main() {
    const uint i = itemIndex(push.count), n = counts[i];
    uint passed = ~0u;
    Touch passing;
    for (uint s = 0u; s < n; ++s) {
        const Touch touch = touchOf(i, s * push.row + i, vec3(0.0));
        if (touch.isThrough && passed == ~0u) {
            passed = s;
            passing = touch;
        }
        write(s * push.row + i, touch);
    }
    if (passed == ~0u) {
        hide(i, n);
        return;
    }
    // Below a surface the sides of the faces around are those of the face that was passed: what slides below another face
    // must not be pushed out there.
    for (uint s = 0u; s < n; ++s) {
        const uint element = s * push.row + i;
        if (s != passed && areNeighbours(faces[contacts[element].x], passing.face)) write(element, touchOf(i, element, passing.n));
    }
}
