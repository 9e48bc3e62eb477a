#version 460
// Tearing, first pass: the largest stretch of every cell of a sheet and its direction, from the best linear fit to
// its live links. Unlike the strain of a link it is a property of the material and does not depend on the orientation
// of the grid.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"

layout(std430, binding = 0) readonly buffer Links { uint links[]; };
layout(std430, binding = 1) readonly buffer Cells { uint cells[]; };   // fill of the cells around each node
layout(std430, binding = 2) readonly buffer Places { vec4 places[]; }; // at the start of the step [m]
layout(std430, binding = 3) writeonly buffer Strains { CellStrain strains[]; };
layout(push_constant) uniform Push { TearPush push; };
#include "cutting/sheet_cells.glsl"
#include "cutting/mixed.glsl"

CellStrain strainOf(uint cell) {
    vec3 x = vec3(0.0), z = vec3(0.0);
    float xx = 0.0, xz = 0.0, zz = 0.0;
    for (uint l = 0u; l < cellLinks; ++l) {
        if (!isAliveIn(cell, l)) continue;
        const ivec2 ends = endsOf(l);
        const vec2 way = vec2(nodeOf(ends.y) - nodeOf(ends.x));
        const vec3 d = places[slotOf(cell, ends.y)].xyz - places[slotOf(cell, ends.x)].xyz;
        x += way.x * d;
        z += way.y * d;
        xx += way.x * way.x;
        xz += way.x * way.y;
        zz += way.y * way.y;
    }
    const float size = (xx * zz - xz * xz) * push.spacing; // not 0: the links connect four corners
    const vec3 fx = (zz * x - xz * z) / size, fz = (xx * z - xz * x) / size;
    const float a = dot(fx, fx), b = dot(fx, fz), c = dot(fz, fz), half_ = 0.5 * (a - c), radius = sqrt(half_ * half_ + b * b);
    const bool isAlike = radius < 1e-5 * (a + c); // equal in all directions: then a random one, instead of one along the grid
    const float angle = isAlike ? radians(180.0) * float(mixed(cell)) / 4294967296.0 : 0.5 * atan(b, half_);
    return CellStrain(sqrt(0.5 * (a + c) + radius) - 1.0, cos(angle), 0.0, sin(angle), 0u);
}

void main() {
    const uint item = itemIndex(push.count);
    if (item >= push.count) return;
    const uint cell = push.first + item;
    const bool isFilled = (cells[cell] >> 20 & 15u) != 0u; // fill of the cell towards x and z; cells of sheets lie below their nodes in y
    strains[cell] = isFilled && isWhole(cell) ? strainOf(cell) : CellStrain(-1.0, 1.0, 0.0, 0.0, 0u);
}
