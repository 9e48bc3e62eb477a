#version 460
// Contacts with faces, first pass: narrow phase of each point with each face near it, over the whole path of the
// substep, from x - h v to x. A face has two sides. A point is on the side that it came from: while the two touch the
// side is remembered, so that a point that has sunk through is pushed back out of the side on which it entered. A
// pair that does not touch has no memory, and a point that is through and beyond reach is released: results do not
// depend on when lists are made. Corners of sheets are kept on the sides of sheets on which they begin a substep
// (keep_apart.comp).
//
// Impulses of a contact on its particles are weighted by beta, 1 for the point and b for the corners; directions n
// are unit:
//   C = n . (x - sum_k b_k x_k) - reach,   dC/dx = beta n.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "common/kernel.glsl"
#include "common/triangle.glsl"

#include "collision/near_faces.glsl"
layout(std430, binding = 4) readonly buffer Lists { uvec2 lists[]; };
#include "common/fetched.glsl"
FETCHED_VEC4(5, Memory, memoryAt) // w: side and overlap, 0 = no contact so far
#define MEMORY(k) memoryAt(k)
layout(std430, binding = 6) buffer Directions { vec4 directions[]; }; // n, depth [m]; 0 = does not touch; below 0 = see hide
layout(std430, binding = 7) buffer Weights { vec4 weights[]; };       // b; w: side and overlap
layout(std140, binding = 8) uniform Step { StepParams step; };
layout(push_constant) uniform Push { FacePush push; };
#define MARKS_BINDING 9
layout(constant_id = 5) const bool hasZones = false; // the scene has impact zones; else bindings 10 and 11 are empty
layout(constant_id = 3) const uint firstInner = ~0u; // faces from there to before push.moving can be opened by a cut; ~0 = there are none
#include "collision/keeps_rest.glsl"
#include "collision/recovery.glsl"
#include "collision/hidden_faces.glsl"
bool mayPass = false; // whether the point is so fast or so deep that it may pass a face
uint meets = 0u;      // mark of the pair that was looked at last (meeting_marks.glsl)
#define SHEETS_BINDING 12
#include "collision/one_sheet.glsl"
#include "collision/meeting_marks.glsl"
#include "collision/face_touch.glsl"
layout(std430, binding = 10) buffer Finding { DispatchArguments finding[]; }; // of the search for points that pass
layout(std430, binding = 11) writeonly buffer Meets { uint meeting[]; }; // by element, see meeting_marks.glsl
#include "collision/held_behind.glsl"
#define TOUCHED_BINDING 13
#define FIRST_TOUCHED TOUCHED_PARTICLES
#define TOUCHED_LIST TOUCHED_POINTS
#include "collision/touched.h"
#include "collision/touched.glsl"

void write(uint element, Touch touch) {
    directions[element] = vec4(touch.n, touch.depth);
    weights[element] = vec4(touch.b, touch.remembered);
    if (hasZones) meeting[element] = meets;
}

// Elements to look at again after `passed`, as bits: of those from `from` to `end`, at most 32.
uint besides(uint from, uint end, uint passed, ContactFace face) {
    uint bits = 0u;
    for (uint element = from; element < end; ++element)
        bits |= uint(element != passed && areNeighbours(faceAt(CONTACT(element).x), face)) << element - from;
    return bits;
}

// Lists what the next passes visit. Other rows change nothing.
void listRows(uint i, uvec2 list) {
    for (uint element = list.x; element < list.x + list.y; ++element) {
        const bool touches = directions[element].w != 0.0;
        if (!touches && weights[element].w == 0.0 && MEMORY(element) == vec4(0.0)) continue;
        listTouched(TOUCHED_ROWS, element);
        if (!touches) continue;
        const uint face = CONTACT(element).x;
        ContactFace corners = ContactFace(i, i, i, 0.0);
        if (face < push.moving) corners = faceAt(face);
        listTouchedParticles(i, corners.a, corners.b, corners.c);
    }
}

void findContacts(uint i, uvec2 list) {
    const uint end = list.x + list.y;
    uint passed = ~0u;
    Touch passing;
    vec3 through = vec3(0.0);
    if (keepsRest) findHolders(i, list);
    // The second time, below a surface: the sides of the faces around are those of the face that was passed. What slides below another face
    // must not be pushed out there. One copy of touchOf() serves both times: the kernel is half as large.
    [[dont_unroll]] for (uint time = 0u; time < 2u; ++time) {
        for (uint from = list.x; from < end; from += 32u) {
            const uint last = min(from + 32u, end);
            uint left = time == 0u ? ~0u >> from + 32u - last : 0u;
            left |= besides(from, time == 0u ? from : last, passed, passing.face);
            for (; left != 0u; left &= left - 1u) {
                const uint element = from + uint(findLSB(left));
                Touch touch = touchOf(i, list, element, through);
                if (keepsRest && time == 0u) touch = heldTouch(i, element, touch);
                if (touch.isThrough && passed == ~0u) {
                    passed = element;
                    passing = touch;
                }
                write(element, touch);
            }
        }
        if (passed == ~0u) break;
        through = passing.n;
    }
    if (passed == ~0u) hide(i, list.x, end);
}

void main() {
    const uint i = touchedItem();
    if (i == ~0u) return;
    const uvec2 list = lists[i];
    findContacts(i, list);
    listRows(i, list);
    if (hasZones && mayPass) finding[0].groupsX = finding[ZONE_GROUPS].groupsX;
}
