// Random numbers that are equal with every standard library: its generator is specified exactly, its
// distributions are not.
#pragma once

#include <cstdint>
#include <random>

namespace sinew::sim {

class Random {
public:
    explicit Random(std::uint32_t seed) : bits_(seed) {}
    /// Uniform from -1 to 1.
    double symmetric() { return (static_cast<double>(bits_()) + 0.5) / 2147483648.0 - 1; }

private:
    std::mt19937 bits_;
};

} // namespace sinew::sim
