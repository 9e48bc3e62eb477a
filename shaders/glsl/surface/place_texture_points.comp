#version 460
// Texture coordinates of the corners of bound skin triangles. A vertex that has moved to a blade has those of the
// place of the skin where it is now: the search starts beside its first place, crosses edges towards the new one, and
// does not cross a seam, so that no triangle lies on both sides of one.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "common/kernel.glsl"
#include "common/texture_layout.h"
#include "common/triangle.glsl"

layout(std430, binding = 0) readonly buffer Textured { TexturedPrism textured[]; };
layout(std430, binding = 1) readonly buffer Wholes { TexturedWhole wholes[]; };
layout(std430, binding = 2) readonly buffer Prisms { SkinPrism prisms[]; };
#define HUNG_BINDING 3
#include "surface/hung_vertex.glsl"
#define MOVED_BINDING 4
#include "surface/moved_vertex.glsl"
layout(std430, binding = 5) writeonly buffer Coordinates { vec2 coordinates[]; }; // by index of all skins
layout(push_constant) uniform Push { CountPush push; };

const uint mostSteps = 64u; // triangles that a way of 1.5 cells crosses

vec2 pointAt(float at[6], vec3 weights) {
    return weights.x * vec2(at[0], at[1]) + weights.y * vec2(at[2], at[3]) + weights.z * vec2(at[4], at[5]);
}

// The edge to cross towards a point, the one that it is farthest beyond; 3 if there is none.
uint wayOut(TexturedWhole whole, vec3 weights, uint before) {
    uint way = 3u;
    float least = 0.0;
    [[dont_unroll]] for (uint n = 0u; n < 3u; ++n) {
        const float weight = weights[(n + 2u) % 3u];
        if (!(weight < least) || whole.beyond[n] == NO_TEXTURE || whole.beyond[n] == before) continue;
        least = weight;
        way = n;
    }
    return way;
}

// The texture point of the nearest place on the triangles along the way; `found` if none of them has an area.
vec2 pointNear(uint home, vec3 place, vec2 found) {
    uint next = home, before = NO_TEXTURE;
    float nearest = 1e30;
    [[dont_unroll]] for (uint k = 0u; k < mostSteps; ++k) {
        const TexturedWhole whole = wholes[next];
        const vec3 a = hungAt(whole.vertices[0]).rest.xyz;
        const Triangle triangle = triangleOf(hungAt(whole.vertices[1]).rest.xyz - a, hungAt(whole.vertices[2]).rest.xyz - a);
        const Nearest here = nearestOf(place - a, triangle);
        if (dot(here.d, here.d) < nearest) {
            nearest = dot(here.d, here.d);
            found = pointAt(whole.at, here.weights);
        }
        const uint way = wayOut(whole, weightsOf(place - a, triangle), before);
        if (way == 3u) break;
        before = next;
        next = whole.beyond[way];
    }
    return found;
}

void main() {
    const uint i = itemIndex(push.count);
    if (i >= push.count) return;
    const TexturedPrism self = textured[i];
    if (self.triangle == NO_TEXTURE) return;
    [[dont_unroll]] for (uint n = 0u; n < 3u; ++n) {
        const vec4 to = MOVED(prisms[i].vertices[n]);
        const vec2 first = vec2(self.at[2u * n], self.at[2u * n + 1u]);
        coordinates[3u * self.triangle + n] = to.w >= VERTEX_MOVED ? pointNear(self.homes[n], to.xyz, first) : first;
    }
}
