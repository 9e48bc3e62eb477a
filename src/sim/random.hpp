// Random numbers that are the same with every standard library: its distributions differ, its generator does
// not.
#pragma once

#include <cstdint>
#include <random>

namespace sinew::sim {

class Random {
public:
    explicit Random(std::uint32_t seed) : bits_(seed) {}
    /// Evenly from -1 to 1.
    double symmetric() { return (static_cast<double>(bits_()) + 0.5) / 2147483648.0 - 1; }

private:
    std::mt19937 bits_;
};

} // namespace sinew::sim
