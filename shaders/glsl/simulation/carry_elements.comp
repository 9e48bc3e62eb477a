#version 460
// Carries entries of a buffer to another program, in which the elements have other indices: one invocation a word of
// the entries there. Entries of new elements stay. Values that are indices of elements become those of the other
// program; an index of an element that is gone becomes that of the entry itself.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"

layout(std430, binding = 0) readonly buffer Origins { uint origins[]; }; // by element: its index before, or NO_ELEMENT
layout(std430, binding = 1) readonly buffer Targets { uint targets[]; }; // by index before: the index now, or NO_ELEMENT
layout(std430, binding = 2) readonly buffer From { uint from[]; };
layout(std430, binding = 3) writeonly buffer To { uint to[]; };
layout(push_constant) uniform Push { CarryPush push; };

void main() {
    const uint i = itemIndex(push.count);
    if (i >= push.count) return;
    const uint element = i / push.words, origin = origins[element];
    if (origin == NO_ELEMENT) return;
    uint value = from[origin * push.words + i % push.words];
    if (value < push.values) {
        value = targets[value];
        if (value == NO_ELEMENT) value = element;
    }
    to[i] = value;
}
