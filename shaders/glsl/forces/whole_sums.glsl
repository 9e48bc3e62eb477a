// Sums of impulses and moments as whole numbers of 64 bits (ColliderForce), which are the same in any order. The including
// kernel defines WHOLE_SUMS_BINDING.
layout(std430, binding = WHOLE_SUMS_BINDING) buffer WholeSums { ColliderForce wholeSums[]; };

// Adds a value, in units of the sums, to the whole number whose low word is `word` of sum s.
void addWhole(uint s, uint word, float scaled) {
    const float size = abs(scaled);
    uint high = uint(size / 4294967296.0), low = uint(size - 4294967296.0 * float(high));
    if (scaled < 0.0) {
        low = ~low + 1u;
        high = ~high + (low == 0u ? 1u : 0u);
    }
    const uint carry = atomicAdd(wholeSums[s].words[word], low) > ~low ? 1u : 0u;
    atomicAdd(wholeSums[s].words[word + 1u], high + carry);
}
