#version 460
// Casts a ray at skins, at the surface of cuts (CUTS) or at balls (BALLS): each invocation finds the nearest of its items
// that the ray meets, and adds to the winding number of each skin around the point where the ray passes a section
// plane. Triangles: Moller and Trumbore 1997.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"
#include "simulation/pick.h"
#include "common/absent.glsl"

layout(push_constant) uniform Push { PickPush push; };

bool isSeen(float t) { return t > 0.0 && t >= push.origin.w && t <= push.direction.w; }

#ifdef BALLS
layout(std430, binding = 0) readonly buffer Positions { vec4 positions[]; };
layout(std430, binding = 1) readonly buffer Radii { float radii[]; }; // less than 0: no ball
layout(std430, binding = 2) readonly buffer Pieces { uint pieces[]; };
layout(std430, binding = 3) writeonly buffer Hits { PickHit hits[]; };

uint itemCount() { return push.particles; }

float meet(uint particle) {
    const float radius = radii[particle];
    const vec3 from = push.origin.xyz - positions[particle].xyz;
    const float along = -dot(from, push.direction.xyz);
    const vec3 apart = from + along * push.direction.xyz;
    const float rest = radius * radius - dot(apart, apart);
    if (radius < 0.0 || pieces[particle] == REMOVED_PIECE || isAbsent(positions[particle].xyz) || !(rest >= 0.0)) return PICK_FAR;
    const float halfWay = sqrt(rest), t = along - halfWay;
    if (push.isOpened != 0u && t <= push.origin.w && along + halfWay > push.origin.w) return push.origin.w;
    return t > push.origin.w && t <= push.direction.w ? t : PICK_FAR;
}
#else
layout(std430, binding = 0) readonly buffer Indices { uint indices[]; };
layout(std430, binding = 1) readonly buffer Vertices { SkinVertex vertices[]; };
layout(std430, binding = 2) buffer Windings { int windings[]; };
layout(std430, binding = 3) writeonly buffer Hits { PickHit hits[]; };

float meetTriangle(uint skin, uint i, uint j, uint k) {
    const vec3 a = vertices[i].position.xyz, ab = vertices[j].position.xyz - a, ac = vertices[k].position.xyz - a;
    const vec3 p = cross(push.direction.xyz, ac);
    const float volume = dot(ab, p);
    const vec3 from = push.origin.xyz - a, q = cross(from, ab);
    const float u = dot(from, p) / volume, v = dot(push.direction.xyz, q) / volume, t = dot(ac, q) / volume;
    if (volume == 0.0 || !(u >= 0.0 && v >= 0.0 && u + v <= 1.0) || !isSeen(t)) return PICK_FAR;
    if (push.isOpened != 0u) atomicAdd(windings[push.ray * push.skins + skin], volume < 0.0 ? 1 : -1);
    return t;
}

#ifdef CUTS
layout(std430, binding = 4) readonly buffer Rest { CutVertex rest[]; };
layout(std430, binding = 5) readonly buffer Counts { SurfaceState counts; };

uint itemCount() { return counts.inside + counts.outside; }

float meet(uint item) {
    const uint a = indices[3u * item];
    return meetTriangle(uint(rest[a].rest.w), a, indices[3u * item + 1u], indices[3u * item + 2u]);
}
#else
layout(std430, binding = 4) readonly buffer SheetIndices { uint sheetIndices[]; };
layout(std430, binding = 5) readonly buffer Holders { PickVertex holders[]; };
layout(std430, binding = 6) readonly buffer Skins { PickSkin skins[]; };
layout(std430, binding = 7) readonly buffer Pieces { uint pieces[]; };

uint itemCount() { return push.triangles + push.sheetTriangles; }

bool isRemoved(uint vertex) { return pieces[holders[vertex].particles[0]] == REMOVED_PIECE; }

// Sheets are met by their whole triangles only.
float meet(uint item) {
    const bool isOfSheet = item >= push.triangles;
    const uint first = 3u * (isOfSheet ? item - push.triangles : item);
    uint at[3];
    for (uint c = 0u; c < 3u; ++c) at[c] = isOfSheet ? sheetIndices[first + c] : indices[first + c];
    const uint skin = holders[at[0]].skin;
    if ((skins[skin].isSheet != 0u) != isOfSheet) return PICK_FAR;
    if (isOfSheet && (isRemoved(at[0]) || isRemoved(at[1]) || isRemoved(at[2]))) return PICK_FAR;
    return meetTriangle(skin, at[0], at[1], at[2]);
}
#endif
#endif

void main() {
    const uint caster = gl_GlobalInvocationID.x, all = itemCount();
    PickHit best = PickHit(PICK_FAR, NO_PARTICLE);
    for (uint item = caster; item < all; item += PICK_CASTERS) {
        const float distance = meet(item);
        if (distance < best.distance) best = PickHit(distance, push.firstItem + item);
    }
    hits[push.firstHit + caster] = best;
}
