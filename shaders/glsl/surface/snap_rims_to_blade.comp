#version 460
// Moves skin vertices that a blade separates from their anchors along the skin onto the surface of the blade, so that
// both rims of the cut are there; the skin beyond belongs to the other side. Links die as a whole, so the skin before a
// slow blade parts before the blade is there. A vertex is therefore tested when its anchor loses its first link of a
// stroke, while the skin is still closed, as if the blade went straight on (planeMeeting). If the blade turns, it
// meets the vertex elsewhere, and that place replaces the first one.
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
layout(std430, binding = 8) readonly buffer Flags { uint flags[]; }; // one per slot
layout(std430, binding = 9) buffer Moved { vec4 moved[]; };
layout(std430, binding = 10) buffer Rims { uint rims[]; };
layout(std430, binding = 11) readonly buffer Status { StatusWords status; };
layout(std430, binding = 12) readonly buffer Counts { uint counts[]; };
layout(std430, binding = 13) readonly buffer Listed { uint listed[]; }; // vertices (list_vertices)
layout(std430, binding = 14) readonly buffer Placed { PlacedVertex placed[]; }; // by vertex (place_vertices)
layout(std430, binding = 15) readonly buffer Planes { vec4 planes[]; };         // planes of the skin

#include "surface/near_skin.glsl"
#include "common/blade_sweep.glsl"
#include "surface/blade_plane.glsl"
#include "surface/around.glsl"

const float mostWay = 1.5;      // [cells]
const float leastVolume = 1e-3; // relative to its rest volume: flatter material gives no rest position
const float leastTangent = 0.2; // part of the blade's normal in the plane of the skin, squared: a blade at a smaller angle shaves along the skin

// The place of a vertex after this step, with its state in w.
vec4 nextPlace(uint v, HungVertex self, vec4 to) {
    const uint i = self.anchor, state = flags[i];
    const PlacedVertex vertex = placed[v];
    vec3 x = vertex.now.xyz;
    Meeting meeting = stripMeeting(Ends(vertex.before.xyz, placeBefore(i), x, PLACE(i)));
    const bool isMet = meeting.at <= 1.0;
    if (isMet && to.w == VERTEX_MOVES) return vec4(0.0); // it came back
    if (!isMet && (state & (SLOT_LOSES | SLOT_LOST)) != SLOT_LOSES) return to; // only the first loss of a stroke counts
    if (!isMet && to.w == VERTEX_MOVES) return vec4(to.xyz, VERTEX_MOVED);
    const mat3 turn = gradientAt(i);
    if (!(abs(determinant(turn)) > leastVolume)) return to;
    if (!isMet) {
        const Around around = aroundOf(i);
        x = placeIn(around, turn, self.rest.xyz);
        meeting = planeMeeting(x, PLACE(i), around.drift);
    }
    const vec3 normal = transpose(turn) * meeting.normal, skin = planes[v].xyz; // at rest
    const float size = length(normal);
    if (!(size > 0.0) || !(meeting.at >= 0.0 && meeting.at <= 1.0)) return to;
    vec3 way = normal - dot(normal, skin) / max(dot(skin, skin), 1e-30) * skin; // in the skin, which may face no way
    if (dot(way, way) < leastTangent * size * size) way = normal;
    way *= meeting.at * dot(meeting.normal, PLACE(i) - x) / dot(normal, way);
    way *= min(1.0, mostWay * push.spacing / max(length(way), 1e-30));
    return vec4(self.rest.xyz + way, !isMet ? VERTEX_AHEAD : (state & (SLOT_LOSES | SLOT_LOST)) != 0u ? VERTEX_MOVED : VERTEX_MOVES);
}

void main() {
    readBlade();
    const uint count = counts[SKIN_LISTS * push.run + SKIN_VERTICES], item = itemIndex(count);
    if (item >= count || blade.quads == 0u || !isFinished(status)) return; // strokes continue over steps without a blade
    const uint v = listed[push.first + item];
    const HungVertex self = hungAt(v);
    vec4 to = moved[v];
    if (to.w >= VERTEX_MOVED && blade.isCarried == 0u) to.w = VERTEX_OLD;
    if (to.w == VERTEX_MOVES && blade.isCarried == 0u) to = vec4(0.0);
    if (to.w != VERTEX_MOVED && to.w != VERTEX_OLD && isNearBlade(self.anchor)) to = nextPlace(v, self, to);
    if (to.w >= VERTEX_MOVED) rims[v] = 1u;
    moved[v] = to;
}
