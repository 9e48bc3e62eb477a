#version 460
// Contacts between edges, first pass: where the insides of two edges are nearer than their faces are thick, looking at the
// whole way of the substep; what else of two faces may meet, a corner meets (touch_faces). Two lines that cross have two
// sides of each other, and the two stay on those on which they met, as a point does of a face. Nearly parallel edges and
// those that have gone around each other forget that.
//
//   C = n . (x_1(s) - x_2(t)) - reach,   beta = 1 - s, s, -(1 - t), -t for the four ends.
#extension GL_GOOGLE_include_directive : require
#include "kernel.glsl"
#include "segments.glsl"
#include "edges.glsl"
layout(std430, binding = 4) readonly buffer Predicted { vec4 predicted[]; };
layout(std430, binding = 5) readonly buffer Memory { vec4 memory[]; };          // w: side and overlap, 0 = has not touched
layout(std430, binding = 6) writeonly buffer Directions { vec4 directions[]; }; // n from the other, depth [m]; 0 = none
layout(std430, binding = 7) writeonly buffer Weights { vec4 weights[]; };       // s of the own, of the other edge; remembered
layout(std430, binding = 8) writeonly buffer Sums { float sums[]; };            // of the weights of each end
layout(std140, binding = 9) uniform Step { StepParams step; };
#define MARKS_BINDING 10
#include "keeps_rest.glsl"
#include "recovery.glsl"
#include "edge_touch.glsl"

void main() {
    const uint e = itemIndex(push.count);
    const uvec2 list = lists[e];
    vec2 sum = vec2(0.0);
    for (uint element = list.x; element < list.x + list.y; ++element) {
        const uvec2 candidate = contacts[element];
        const EdgePair pair = pairOf(e, candidate.x);
        const Touch touch = touchOf(pair, uvec2(e, candidate.x), uintBitsToFloat(candidate.y), memory[element].w);
        const vec2 st = pair.isFirst ? touch.st : touch.st.yx;
        directions[element] = vec4(pair.isFirst ? touch.n : -touch.n, touch.depth);
        weights[element] = vec4(st, 0.0, touch.remembered);
        if (touch.depth > 0.0) sum += vec2(1.0 - st.x, st.x);
    }
    sums[2u * e] = sum.x;
    sums[2u * e + 1u] = sum.y;
}
