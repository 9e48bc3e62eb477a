// The hash grid: cells of a uniform grid in a table whose size is a power of two, fitted to the particles. A cell's
// slot is linear in its coordinates, x + strideY y + strideZ z, so that three neighbours in x are adjacent and the 27
// cells around a particle are nine ranges. If the box around all particles and a rim have at most as many cells as
// the table, strides make it dense: no two cells share a slot. Else strides spread rows over the table (the additive
// recurrence of the plastic number), and a reader of a range compares the row of each particle that it finds, so that
// two rows that share slots never give a particle twice. Built with integer atomics alone. The order of particles in
// a cell varies: a reader that depends on an order sorts.

#include "common/math.glsl"

// Maps a float to an integer with the same order.
uint keyOf(float value) {
    const uint bits = floatBitsToUint(value);
    return (bits & 0x80000000u) != 0u ? ~bits : bits | 0x80000000u;
}
float valueOf(uint key) {
    return uintBitsToFloat((key & 0x80000000u) != 0u ? key & 0x7fffffffu : ~key);
}

struct Frame {
    vec3 low;         // corner of cell (0, 0, 0) [m]
    float perLength;  // cells per metre
    uint strideY, strideZ, mask;
};

// Cells are slightly larger than bounds.edge: rounding of (x - low) perLength must not put two particles that are
// bounds.edge apart two cells apart, however large the box is.
Frame frameOf(GridBounds bounds, uint cells) {
    Frame frame;
    frame.low = vec3(valueOf(bounds.lowX), valueOf(bounds.lowY), valueOf(bounds.lowZ));
    const vec3 extent = vec3(valueOf(bounds.highX), valueOf(bounds.highY), valueOf(bounds.highZ)) - frame.low;
    const float longest = max(extent.x, max(extent.y, extent.z));
    const float edge = bounds.edge + 2.0 * uintBitsToFloat(bounds.drivenWay);
    const float perLength = 1.0 / (1.015625 * edge + longest / 1048576.0);
    frame.perLength = perLength;
    frame.mask = cells - 1u;
    const vec3 size = floor(extent * perLength) + 3.0; // with an empty cell at every end, so that searches beyond the box find nothing
    const float all = size.x * size.y * size.z;
    const bool isDense = all <= float(cells);
    const float spreadY = 0.75487767 * float(cells), spreadZ = 0.56984029 * float(cells);
    frame.strideY = isDense ? uint(size.x) : uint(spreadY) | 1u;
    frame.strideZ = isDense ? uint(size.x) * uint(size.y) : uint(spreadZ) | 1u;
    return frame;
}

ivec3 cellOf(vec3 x, Frame frame) {
    const vec3 place = (x - frame.low) * frame.perLength;
    return ivec3(floor(place));
}

uint slotOf(ivec3 cell, Frame frame) {
    return uint(cell.x) + uint(cell.y) * frame.strideY + uint(cell.z) * frame.strideZ & frame.mask;
}

// A radius below 0 marks a slot of the state that holds no particle.
bool isInGrid(float radius, float most) { return radius >= 0.0 && radius <= most; }

// Distance covered at velocity v in a substep of length h.
float wayOf(float h, vec3 v) {
    return length3(h * v);
}

// True if a particle of the grid moves so far in a substep that the cells around its end position may lack particles
// that it met: it is then searched one by one, like a large one. `way` is velocity x substep length; `quiet` as in
// GridPush.
bool isHurrying(float radius, float way, float quiet, float most) {
    const float size = radius + way;
    return isInGrid(radius, most) && way > quiet && size > most;
}
