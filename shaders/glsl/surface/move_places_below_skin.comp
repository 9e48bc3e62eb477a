#version 460
// Positions of particles for tests against a blade: an anchor of a mesh's skin that lies outside of the skin is moved
// to just below it (src/sim/surface/skin_complex), with the deformation around it. During a stroke the offset stays
// the same: cutting changes the gradient, and a link must not jump over the blade.
#extension GL_GOOGLE_include_directive : require
#include "common/cut.glsl"
#include "lattice/link_masks.glsl"

layout(std430, binding = 0) readonly buffer Links { uint links[]; };
layout(std430, binding = 1) readonly buffer Rest { vec4 rest[]; };
layout(std430, binding = 2) readonly buffer PulledRest { vec4 pulledRest[]; };
layout(std430, binding = 3) readonly buffer Places { vec4 places[]; };
layout(std430, binding = 4) writeonly buffer PulledPlaces { vec4 pulledPlaces[]; };
layout(std430, binding = 5) readonly buffer PlacesBefore { vec4 before[]; }; // w = 0: no blade yet
layout(std430, binding = 6) buffer Work { CutWork work; };
layout(std430, binding = 7) readonly buffer Blade { BladeHead blade; };
layout(std430, binding = 8) buffer Pulls { vec4 pulls[]; }; // pulls of the stroke; w = 0: not yet set

#define ALIVE(i) links[i]
#define AT(i) places[i].xyz
#define REST(i) rest[i].xyz
#include "surface/gradient.glsl"

void main() {
    const uint item = itemIndex(push.count);
    if (item >= push.count) return;
    const uint i = push.first + item;
    const vec3 pull = pulledRest[i].xyz - rest[i].xyz;
    vec3 x = places[i].xyz;
    if (pull != vec3(0.0)) {
        const bool isNew = blade.isCarried == 0u && (blade.quads > 0u || blade.rayFrom.w > 0.0);
        if (isNew || pulls[i].w == 0.0) pulls[i] = vec4(gradientAt(i) * pull, 1.0);
        x += pulls[i].xyz;
    }
    pulledPlaces[i] = vec4(x, 1.0);
    const uint way = before[i].w > 0.0 ? floatBitsToUint(distance(x, before[i].xyz)) : 0u;
    if (way > work.farthest) atomicMax(work.farthest, way);
}
