// Histogram of values over the particles. Requires `spread`, a ValueSpread.

void count(float value) {
    const float decade = floor(log2(max(value, 1e-30)) * 0.30103);
    const float digit = value / exp2(decade / 0.30103);
    const int bin = 3 * (int(decade) + 7) + (digit <= 1.0 ? 0 : digit <= 2.0 ? 1 : digit <= 5.0 ? 2 : 3);
    atomicAdd(spread.counts[clamp(bin, 0, VALUE_BINS - 1)], 1u);
    atomicMax(spread.largest, floatBitsToUint(value)); // bits have the order of floats that are not below 0
}
