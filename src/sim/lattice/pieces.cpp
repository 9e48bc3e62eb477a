// Union-find towards the lower slot, with path halving.
#include "sim/lattice/pieces.hpp"

#include "common/layout.h"

#include <numeric>

namespace sinew::sim::lattice {

PieceFinder::PieceFinder(std::size_t slots) : labels_(slots) {
    std::iota(labels_.begin(), labels_.end(), 0u);
}

std::uint32_t PieceFinder::lowest(std::uint32_t slot) {
    while (labels_[slot] != slot) slot = labels_[slot] = labels_[labels_[slot]];
    return slot;
}

void PieceFinder::join(std::uint32_t a, std::uint32_t b) {
    a = lowest(a);
    b = lowest(b);
    labels_[a < b ? b : a] = a < b ? a : b;
}

Pieces PieceFinder::finish(std::span<const std::uint32_t> particles, std::size_t particleCount) {
    Pieces pieces{.labels = std::vector<std::uint32_t>(labels_.size()),
                  .ofParticles = std::vector<std::uint32_t>(particleCount, NO_PARTICLE),
                  .sizes = std::vector<std::uint32_t>(particleCount)};
    for (std::uint32_t slot = 0; slot < labels_.size(); ++slot) {
        const std::uint32_t first = pieces.labels[slot] = lowest(slot);
        if (particles[slot] == NO_PARTICLE) continue;
        pieces.ofParticles[particles[slot]] = particles[first];
        pieces.count += first == slot ? 1 : 0;
        ++pieces.sizes[particles[first]];
    }
    return pieces;
}

} // namespace sinew::sim::lattice
