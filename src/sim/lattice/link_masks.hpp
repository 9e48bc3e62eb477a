// Bits of the live links of a node: cutting clears them, and kernels for cuttable bodies read them
// (shaders/glsl/lattice/link_masks.glsl has the same bits). Bit b is the link in direction directionOf(b);
// the other end stores the same link in bit 25 - b, and both bits always agree.
#pragma once

#include "sim/lattice/placement.hpp"

#include <optional>

namespace sinew::sim::lattice {

inline constexpr std::uint32_t directionCount = 26;
/// Bits from this one on lead to a higher node, by z, then y, then x: the node owns those links.
inline constexpr std::uint32_t firstOwned = 13;

/// Steps along x, y and z, each -1, 0 or 1, in the order x + 1 + 3 (y + 1) + 9 (z + 1), without (0, 0, 0).
constexpr std::array<int, 3> directionOf(std::uint32_t bit) {
    const int step = static_cast<int>(bit < firstOwned ? bit : bit + 1);
    return {step % 3 - 1, step / 3 % 3 - 1, step / 9 - 1};
}

/// The bit of such a direction; empty if the steps lead to no neighbour.
constexpr std::optional<std::uint32_t> bitOf(const std::array<int, 3>& steps) {
    for (const int step : steps)
        if (step < -1 || step > 1) return std::nullopt;
    const auto place = static_cast<std::uint32_t>(steps[0] + 1 + 3 * (steps[1] + 1) + 9 * (steps[2] + 1));
    if (place == firstOwned) return std::nullopt;
    return place < firstOwned ? place : place - 1;
}

/// Directions of the edges of the six tetrahedra of a cell (Kuhn's subdivision): along axes, the face
/// diagonals whose two steps have equal sign, and (1, 1, 1). All of them are links of the mask, also in
/// bodies without body diagonals, where (1, 1, 1) has no stiffness.
constexpr bool isKuhn(const std::array<int, 3>& direction) {
    bool isUp = false, isDown = false;
    for (const int step : direction) {
        isUp = isUp || step > 0;
        isDown = isDown || step < 0;
    }
    return isUp != isDown;
}

/// Bits of the links that have stiffness.
std::uint32_t stiffLinks(const Grid& grid);

/// Links of a node of an uncut body.
std::uint32_t linksAt(const Grid& grid, const std::array<std::uint32_t, 3>& node);

/// Writes linksAt() of all nodes into `words` by slot; other words stay.
void writeLinks(const Grid& grid, const Box& box, std::span<std::uint32_t> words);

} // namespace sinew::sim::lattice
