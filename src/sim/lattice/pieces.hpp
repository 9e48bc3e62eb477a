// Connected components of bodies by their links, on the host: for uncut bodies, and to check the device's
// result.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace sinew::sim::lattice {

struct Pieces {
    std::vector<std::uint32_t> labels;      ///< by slot: lowest slot of the piece
    std::vector<std::uint32_t> ofParticles; ///< by particle: name of its piece, or NO_PARTICLE
    std::vector<std::uint32_t> sizes;       ///< by particle: size of the piece that it names, else 0
    std::uint32_t count = 0;                ///< of pieces
};

class PieceFinder {
public:
    explicit PieceFinder(std::size_t slots);

    /// Adds a link from slot `a` to slot `b`.
    void join(std::uint32_t a, std::uint32_t b);

    /// `particles` is indexed by slot, NO_PARTICLE in empty slots.
    Pieces finish(std::span<const std::uint32_t> particles, std::size_t particleCount);

private:
    std::uint32_t lowest(std::uint32_t slot);
    std::vector<std::uint32_t> labels_;
};

} // namespace sinew::sim::lattice
