// The hash grid: cells of a uniform grid in a table of a power of two, found from the particles themselves (methods: J).
// A cell's slot is linear in its coordinates, x + strideY y + strideZ z, so that three neighbours in x lie side by side and
// the 27 cells around a particle are nine ranges. Where the box around all particles and a rim have at most as many cells
// as the table, strides make it dense: no two cells share a slot. Else strides spread rows over the table (the additive
// recurrence of the plastic number), and whoever reads a range compares the row of what it finds, so that two rows that
// share slots never give a particle twice. Built on integer atomics alone. Inside a cell particles stand in any order: who
// depends on an order sorts what it finds.

// Integers in the order of the floats they stand for.
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

// Cells a little larger than `edge`: rounding of (x - low) perLength must not put two particles that are `edge` apart
// two cells apart, however large the box is.
Frame frameOf(GridBounds bounds, uint cells, float edge) {
    Frame frame;
    frame.low = vec3(valueOf(bounds.lowX), valueOf(bounds.lowY), valueOf(bounds.lowZ));
    const vec3 extent = vec3(valueOf(bounds.highX), valueOf(bounds.highY), valueOf(bounds.highZ)) - frame.low;
    const float longest = max(extent.x, max(extent.y, extent.z));
    frame.perLength = 1.0 / (1.015625 * edge + longest / 1048576.0);
    frame.mask = cells - 1u;
    const vec3 size = floor(extent * frame.perLength) + 3.0; // with an empty cell at every end: nobody finds others there
    const bool isDense = size.x * size.y * size.z <= float(cells);
    frame.strideY = isDense ? uint(size.x) : uint(0.75487767 * float(cells)) | 1u;
    frame.strideZ = isDense ? uint(size.x) * uint(size.y) : uint(0.56984029 * float(cells)) | 1u;
    return frame;
}

ivec3 cellOf(vec3 x, Frame frame) { return ivec3(floor((x - frame.low) * frame.perLength)); }

uint slotOf(ivec3 cell, Frame frame) {
    return uint(cell.x) + uint(cell.y) * frame.strideY + uint(cell.z) * frame.strideZ & frame.mask;
}

// A radius below 0 marks a slot of the state that holds no particle.
bool isInGrid(float radius, float most) { return radius >= 0.0 && radius <= most; }

// Whether a particle of the grid moves so far in a substep that the cells around its end do not hold all that it may have
// met: it is then searched one by one, like a large one. Way x substep length; `quiet` as in GridPush.
bool isHurrying(float radius, float way, float quiet, float most) {
    return isInGrid(radius, most) && way > quiet && radius + way > most;
}
