// Number of particles of the hash grid in a block of cells, including cells that share slots with its rows. Requires
// the macro START.
uint pointsIn(ivec3 first, ivec3 last, Frame frame) {
    uint sum = 0u;
    for (int z = first.z; z <= last.z; ++z)
        for (int y = first.y; y <= last.y; ++y)
            for (int x = first.x; x <= last.x; x += 3) {
                const uint slot = slotOf(ivec3(x, y, z), frame);
                sum += START(slot + uint(min(last.x - x + 1, 3))) - START(slot);
            }
    return sum;
}
