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
layout(std430, binding = 4) readonly buffer Lists { uvec2 lists[]; };
layout(std430, binding = 5) readonly buffer Memory { vec4 memory[]; };       // w: side and overlap, 0 = has not touched
layout(std430, binding = 6) buffer Directions { vec4 directions[]; }; // n, depth [m]; 0 = does not touch; below 0 = see hide
layout(std430, binding = 7) buffer Weights { vec4 weights[]; };       // b, side
layout(std140, binding = 8) uniform Step { StepParams step; };
layout(push_constant) uniform Push { FacePush push; };
#define MARKS_BINDING 9
layout(constant_id = 3) const uint firstInner = ~0u; // faces from there to before push.moving a cut has laid open; ~0 = none can be
#include "keeps_rest.glsl"
#include "recovery.glsl"
#include "hidden_faces.glsl"
#include "face_touch.glsl"
#include "held_behind.glsl"

void write(uint element, Touch touch) {
    directions[element] = vec4(touch.n, touch.depth);
    weights[element] = vec4(touch.b, touch.remembered);
}

void main() {
    const uint i = itemIndex(push.count);
    const uvec2 list = lists[i];
    const uint end = list.x + list.y;
    uint passed = ~0u;
    Touch passing;
    if (keepsRest) findHolders(i, list);
    for (uint element = list.x; element < end; ++element) {
        Touch touch = touchOf(i, list, element, vec3(0.0));
        if (keepsRest) touch = heldTouch(i, element, touch);
        if (touch.isThrough && passed == ~0u) {
            passed = element;
            passing = touch;
        }
        write(element, touch);
    }
    if (passed == ~0u) {
        hide(i, list.x, end);
        return;
    }
    // Below a surface the sides of the faces around are those of the face that was passed: what slides below another face
    // must not be pushed out there.
    for (uint element = list.x; element < end; ++element)
        if (element != passed && areNeighbours(faces[contacts[element].x], passing.face)) write(element, touchOf(i, list, element, passing.n));
}
