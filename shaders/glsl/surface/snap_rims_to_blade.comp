#version 460
// Moves skin vertices that a blade has separated from their anchors: once the anchor has lost a link, such a vertex
// moves along the skin to the place where the blade passed, so that both rims of the cut are there; the skin beyond
// belongs to the other side.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "common/cut.glsl"
#include "lattice/link_masks.glsl"
#include "lattice/kuhn.glsl"
#include "common/blade_hit.glsl"

#include "common/blade_places.glsl"
#include "surface/before_cut.glsl"
#define HUNG_BINDING 6
#include "surface/hung_vertex.glsl"
#define POINTS_BINDING 7
#include "common/blade_points.glsl"
layout(std430, binding = 8) readonly buffer Links { uint links[]; };
layout(std430, binding = 9) buffer Moved { vec4 moved[]; };
layout(std430, binding = 10) buffer Rims { uint rims[]; };
layout(std430, binding = 11) readonly buffer Status { StatusWords status; };
layout(std430, binding = 12) readonly buffer Counts { uint counts[]; };
layout(std430, binding = 13) readonly buffer Listed { uint listed[]; }; // vertices (list_vertices)
layout(std430, binding = 14) readonly buffer Placed { PlacedVertex placed[]; }; // by vertex (place_vertices)
layout(std430, binding = 15) readonly buffer Planes { vec4 planes[]; };         // planes of the skin

#include "surface/near_skin.glsl"
#include "common/blade_sweep.glsl"

const float mostWay = 1.5;      // [cells]
const float leastVolume = 1e-3; // relative to its rest volume: flatter material gives no rest position
const float leastTangent = 0.2; // part of the blade's normal in the plane of the skin, squared: a blade at a smaller angle shaves along the skin

// The rest position to which the blade between the vertex and its anchor moves the vertex; w = 0 if it does not.
vec4 behindBlade(HungVertex self, PlacedVertex vertex, vec3 plane) {
    const uint i = self.anchor;
    const vec3 x = vertex.now.xyz;
    const Meeting meeting = stripMeeting(Ends(vertex.before.xyz, placeBefore(i), x, PLACE(i)));
    const float size = length(meeting.normal);
    if (meeting.at > 1.0 || !(size > 0.0)) return vec4(0.0);
    const mat3 turn = gradientAt(i);
    if (!(abs(determinant(turn)) > leastVolume)) return vec4(0.0);
    const vec3 n = meeting.normal / size;
    const vec3 skin = cofactor(turn) * plane; // zero if its triangles are folded upon each other
    const float area = dot(skin, skin);
    vec3 way = area > 0.0 ? n - dot(n, skin) / area * skin : n;
    if (dot(way, way) < leastTangent) way = n;
    way *= dot(n, meeting.at * (PLACE(i) - x)) / dot(n, way);
    way *= min(1.0, mostWay * push.spacing / max(length(way), 1e-30));
    return vec4(self.rest.xyz + inverse(turn) * way, VERTEX_MOVES);
}

void main() {
    readBlade();
    const uint count = counts[SKIN_LISTS * push.run + SKIN_VERTICES], item = itemIndex(count);
    if (item >= count || blade.quads == 0u || !isFinished(status)) return; // strokes continue over steps without a blade
    const uint v = listed[push.first + item];
    const HungVertex self = hungAt(v);
    vec4 to = moved[v];
    const bool isNear = isNearBlade(self.anchor);
    if (to.w == VERTEX_MOVED || !isNear && to.w == 0.0) return;
    if (blade.isCarried == 0u) to = vec4(0.0);
    if (isNear && (rims[v] == 0u || blade.isCarried != 0u)) { // at an older cut, the first step of a stroke does not move the rim
        const vec4 behind = behindBlade(self, placed[v], planes[v].xyz);
        if (behind.w > 0.0) to = to.w == 0.0 ? behind : vec4(0.0); // else the vertex came back
    }
    if (to.w > 0.0 && bitCount(links[self.anchor]) < int(self.weights.w)) {
        to.w = VERTEX_MOVED;
        rims[v] = 1u;
    }
    moved[v] = to;
}
