#version 460
// Tearing of voxel bodies, first pass: the largest stretch of every cell and its direction.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"

layout(std430, binding = 0) readonly buffer Links { uint links[]; };
layout(std430, binding = 1) readonly buffer Cells { uint cells[]; };   // fill of the cells around each node
layout(std430, binding = 2) readonly buffer Places { vec4 places[]; }; // at the start of the step [m]
layout(std430, binding = 3) writeonly buffer Strains { CellStrain strains[]; };
layout(push_constant) uniform Push { TearPush push; };
#include "cutting/voxel_cells.glsl"
#include "cutting/mixed.glsl"

// The best linear fit to the live links.
mat3 motionOf(uint cell) {
    mat3 sum = mat3(0.0), ways = mat3(0.0);
    for (uint l = 0u; l < stiffLinks; ++l) {
        if (!isAliveIn(cell, l)) continue;
        const ivec2 ends = endsOf(l);
        const vec3 way = vec3(nodeOf(ends.y) - nodeOf(ends.x));
        sum += outerProduct(places[slotOf(cell, ends.y)].xyz - places[slotOf(cell, ends.x)].xyz, way);
        ways += outerProduct(way, way);
    }
    return sum * inverse(ways) / push.spacing; // not singular: the links connect eight corners
}

// The direction of the largest eigenvalue, by the 256th power. If several are equal, a random direction in their span
// instead of one along the grid.
vec3 directionOf(mat3 squares, uint cell) {
    mat3 power = squares;
    for (int n = 0; n < 8; ++n) {
        power /= power[0].x + power[1].y + power[2].z;
        power = power * power;
    }
    const uint number = mixed(cell);
    const vec3 start = vec3(uvec3(number & 1023u, number >> 10 & 1023u, number >> 20 & 1023u)) - 511.5;
    const vec3 direction = power * start;
    const float length2 = dot(direction, direction);
    return length2 > 0.0 ? direction * inversesqrt(length2) : vec3(1.0, 0.0, 0.0);
}

bool isReached(uint cell) {
    bool isAny = false;
    for (uint l = 0u; l < edgeLinks; ++l) isAny = isAny || !isAliveIn(cell, l);
    return isAny;
}

CellStrain strainOf(uint cell) {
    const mat3 motion = motionOf(cell);
    const vec3 direction = directionOf(transpose(motion) * motion, cell);
    const float strain = length(motion * direction) - 1.0;
    return CellStrain(strain, direction.x, direction.y, direction.z, isReached(cell) && strain > push.limit ? 1u : 0u);
}

void main() {
    const uint item = itemIndex(push.count);
    if (item >= push.count) return;
    const uint cell = push.first + item;
    const bool isFilled = cells[cell] >> 28 != 0u; // fill of the cell towards x, y and z
    strains[cell] = isFilled && isWhole(cell) ? strainOf(cell) : CellStrain(-1.0, 1.0, 0.0, 0.0, 0u);
}
