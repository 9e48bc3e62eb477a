#version 460
// Where the material has taken the edge of a blade since the last step of its stroke, first pass: every particle near the edge says where
// what is around it has gone, to the two nearest points. Sums are of whole numbers, so their order changes nothing.
#extension GL_GOOGLE_include_directive : require
#include "cut.glsl"
#include "link_masks.glsl"

layout(std430, binding = 0) readonly buffer Places { vec4 places[]; };
layout(std430, binding = 1) readonly buffer PlacesBefore { vec4 before[]; }; // w = 0: no blade yet
layout(std430, binding = 2) readonly buffer SavedLinks { uint savedLinks[]; };
layout(std140, binding = 3) uniform Blade { BladeHead blade; };
layout(std430, binding = 4) readonly buffer Points { vec4 points[]; };
layout(std430, binding = 5) readonly buffer Work { CutWork work; };
layout(std430, binding = 6) buffer EdgeWays { EdgeWay ways[]; };

#define PLACE(i) places[i].xyz
#include "turn_around.glsl"

const float reachCells = 2.0;

// What the particle says of a point of the edge, which was at `from`.
void add(uint i, uint point, float weight, vec3 from, mat3 turn, float unit) {
    const vec3 way = (PLACE(i) + turn * (from - before[i].xyz) - from) / unit;
    const float whole = round(EDGE_WEIGHT * weight); // in both sums alike
    const ivec3 sum = ivec3(round(whole / EDGE_WEIGHT * clamp(way, -8.0, 8.0) * EDGE_WAY));
    atomicAdd(ways[point].weight, int(whole));
    atomicAdd(ways[point].x, sum.x);
    atomicAdd(ways[point].y, sum.y);
    atomicAdd(ways[point].z, sum.z);
}

void main() {
    const uint item = itemIndex(push.count);
    if (item >= push.count || blade.isCarried == 0u) return;
    const uint i = push.first + item;
    if (savedLinks[i] == 0u || !(before[i].w > 0.0)) return;
    const vec3 x = before[i].xyz;
    const float reach = reachCells * push.spacing, unit = max(uintBitsToFloat(work.farthest), 1e-6 * blade.extent);
    mat3 turn = mat3(0.0);
    for (uint q = 0u; q < blade.quads; ++q) {
        const vec3 from = points[2u * q].xyz, edge = points[2u * q + 2u].xyz - from;
        const float share = clamp(dot(x - from, edge) / max(dot(edge, edge), 1e-30), 0.0, 1.0);
        const vec3 away = from + share * edge - x;
        const float near = 1.0 - dot(away, away) / (reach * reach);
        if (!(near > 0.0)) continue;
        if (turn == mat3(0.0)) turn = turnAround(i);
        const float parts = float(blade.parts), at = share * parts, low = min(floor(at), parts - 1.0);
        const uint point = q * blade.parts + uint(low);
        add(i, point, near * near * (1.0 - (at - low)), from + low / parts * edge, turn, unit);
        add(i, point + 1u, near * near * (at - low), from + (low + 1.0) / parts * edge, turn, unit);
    }
}
