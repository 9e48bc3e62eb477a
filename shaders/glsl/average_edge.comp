#version 460
// Where the material has taken the edge of a blade, second pass: the mean of what the particles around each point say. A point
// that nothing is near goes with the nearest one that something is near; where there is none the edge is where it was.
#extension GL_GOOGLE_include_directive : require
#include "kernel.glsl"

layout(std140, binding = 0) uniform Blade { BladeHead blade; };
layout(std430, binding = 1) buffer Points { vec4 points[]; };
layout(std430, binding = 2) readonly buffer Work { CutWork work; };
layout(std430, binding = 3) readonly buffer EdgeWays { EdgeWay ways[]; };
layout(push_constant) uniform Push { CountPush push; };

vec3 wayOf(int s, int last) {
    for (int off = 0; off <= last; ++off)
        for (int side = -1; side <= 1; side += 2) {
            const int at = s + side * off;
            if (at < 0 || at > last || ways[at].weight <= 0) continue;
            const float unit = max(uintBitsToFloat(work.farthest), 1e-6 * blade.extent);
            return vec3(ways[at].x, ways[at].y, ways[at].z) * (unit * EDGE_WEIGHT / EDGE_WAY / float(ways[at].weight));
        }
    return vec3(0.0);
}

void main() {
    const uint s = itemIndex(push.count), last = blade.quads * blade.parts;
    if (s > last || blade.quads == 0u) return;
    const uint q = min(s / blade.parts, blade.quads - 1u);
    const float share = float(s - q * blade.parts) / float(blade.parts);
    const vec3 start = mix(points[2u * q].xyz, points[2u * q + 2u].xyz, share);
    points[EDGE_BEFORE + s] = vec4(start, 1.0);
    points[EDGE_CARRIED + s] = vec4(start + wayOf(int(s), int(last)), 1.0);
    points[EDGE_AFTER + s] = vec4(mix(points[2u * q + 1u].xyz, points[2u * q + 3u].xyz, share), uintBitsToFloat(work.farthest));
}
