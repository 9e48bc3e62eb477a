// Graph coloring: partitions distance constraints, and bends, into colors, so that those of one color can be
// solved in parallel and in place: no two of them touch the same moving particle. A pure function of the
// scene; regular bodies get the smallest possible number of colors (8 for a sheet with edges and diagonals,
// 18 for a lattice with 18 neighbours).
#pragma once

#include "sinew/scene.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace sinew::sim {

/// Constraints ordered by color, and within a color by ascending particle, so that neighbouring invocations
/// read neighbouring memory.
struct Coloring {
    std::vector<std::uint32_t> order; ///< indices of the constraints with an end that moves, each once
    std::vector<std::uint32_t> ends;  ///< one past the last entry of each color in `order`; no color is empty
    std::size_t colorCount() const { return ends.size(); }
    std::span<const std::uint32_t> color(std::size_t index) const {
        const std::uint32_t first = index == 0 ? 0 : ends[index - 1];
        return std::span(order).subspan(first, ends[index] - first);
    }
};

/// `inverseMass` [1/kg] has one element a particle; particles with 0 never move and may be shared within a
/// color. Uses at most 2 d - 1 colors, where d is the largest number of constraints on a moving particle.
Coloring colorByParticles(const Scene& scene, std::span<const float> inverseMass);

/// The same for bends: `order` holds their indices.
Coloring colorBends(const Scene& scene, std::span<const float> inverseMass);

} // namespace sinew::sim
