// Initially a link is alive if any cell that can contain it is filled.
#include "sim/lattice/link_masks.hpp"

#include <cstdlib>

namespace sinew::sim::lattice {

namespace {

std::uint32_t axesOf(const std::array<int, 3>& direction) {
    return static_cast<std::uint32_t>(std::abs(direction[0]) + std::abs(direction[1]) +
                                      std::abs(direction[2]));
}

// Nibbles of fillAround of the cells that contain the link in a direction.
constexpr std::uint32_t cellsBeside(const std::array<int, 3>& direction) {
    std::uint32_t cells = 0;
    for (std::uint32_t k = 0; k < 8; ++k) {
        bool isBeside = true;
        for (std::uint32_t axis = 0; axis < 3; ++axis)
            isBeside = isBeside && direction[axis] != ((k >> axis & 1) != 0 ? -1 : 1);
        if (isBeside) cells |= 0xfu << 4 * k;
    }
    return cells;
}

bool isLinked(const Grid& grid, const std::array<int, 3>& direction) {
    if (isSheet(grid) && direction[1] != 0) return false;
    return axesOf(direction) <= grid.kinds || isKuhn(direction);
}

} // namespace

std::uint32_t stiffLinks(const Grid& grid) {
    std::uint32_t links = 0;
    for (std::uint32_t bit = 0; bit < directionCount; ++bit)
        if (axesOf(directionOf(bit)) <= grid.kinds) links |= 1u << bit;
    return links;
}

std::uint32_t linksAt(const Grid& grid, const std::array<std::uint32_t, 3>& node) {
    const std::uint32_t around = fillAround(grid, node);
    std::uint32_t word = 0;
    for (std::uint32_t bit = 0; bit < directionCount; ++bit) {
        const auto direction = directionOf(bit);
        if (isLinked(grid, direction) && (around & cellsBeside(direction)) != 0) word |= 1u << bit;
    }
    return word;
}

void writeLinks(const Grid& grid, const Box& box, std::span<std::uint32_t> words) {
    for (const std::uint32_t node : grid.node) {
        const auto at = coordinates(grid, node);
        words[box.slot(at[0], at[1], at[2])] = linksAt(grid, at);
    }
}

} // namespace sinew::sim::lattice
