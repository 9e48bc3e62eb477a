// First-fit coloring of bends, direction after direction: a row or column of cloth needs three alternating
// colors, so that a sheet needs six, as many as an inner particle has bends. If directions need more colors,
// the order of the scene is used.
#include "sim/model/coloring.hpp"

#include <algorithm>
#include <array>
#include <map>

namespace sinew::sim {

namespace {

using Order = std::vector<std::uint32_t>; // of bends

std::array<std::uint32_t, 3> particlesOf(const BendConstraint& bend) {
    return {bend.a, bend.b, bend.c};
}

struct Colors {
    std::vector<std::uint32_t> of; // by entry of the order
    std::uint32_t count = 0;
};

// The lowest color, not below `base`, that no moving particle of a bend has; each direction starts with a new
// base.
Colors firstFit(const Scene& scene, std::span<const float> inverseMass, const Order& order,
                std::span<const std::uint32_t> directions) {
    std::vector<std::vector<bool>> taken(scene.particles.size()); // by particle and color
    std::vector<std::uint32_t> lowest(scene.particles.size(),
                                      0); // all colors from base to below it are taken
    Colors colors;
    std::uint32_t base = 0;
    for (std::size_t entry = 0; entry < order.size(); ++entry) {
        if (entry > 0 && directions[entry] != directions[entry - 1])
            lowest.assign(lowest.size(), base = colors.count);
        const auto particles = particlesOf(scene.bends[order[entry]]);
        const auto isTaken = [&](std::uint32_t color) {
            return std::ranges::any_of(particles, [&](std::uint32_t i) {
                return inverseMass[i] > 0 && color < taken[i].size() && taken[i][color];
            });
        };
        std::uint32_t color = base;
        for (const std::uint32_t i : particles)
            if (inverseMass[i] > 0) color = std::max(color, lowest[i]);
        while (isTaken(color)) ++color;
        for (const std::uint32_t i : particles) {
            if (taken[i].size() <= color) taken[i].resize(color + 1);
            taken[i][color] = true;
            while (lowest[i] < taken[i].size() && taken[i][lowest[i]]) ++lowest[i];
        }
        colors.of.push_back(color);
        colors.count = std::max(colors.count, color + 1);
    }
    return colors;
}

Coloring toColoring(const Order& order, const Colors& colors) {
    Coloring result;
    std::vector<Order> members(colors.count);
    for (std::size_t entry = 0; entry < order.size(); ++entry)
        members[colors.of[entry]].push_back(order[entry]);
    for (const Order& color : members) {
        result.order.insert(result.order.end(), color.begin(), color.end());
        result.ends.push_back(static_cast<std::uint32_t>(result.order.size()));
    }
    return result;
}

} // namespace

Coloring colorBends(const Scene& scene, std::span<const float> inverseMass) {
    Order inScene;
    std::map<std::array<std::uint32_t, 2>, Order> byDirection; // steps of the indices, modulo 2^32
    for (std::uint32_t k = 0; k < scene.bends.size(); ++k) {
        const BendConstraint& bend = scene.bends[k];
        if (inverseMass[bend.a] + inverseMass[bend.b] + inverseMass[bend.c] == 0) continue;
        inScene.push_back(k);
        byDirection[{bend.b - bend.a, bend.c - bend.b}].push_back(k);
    }
    Order sorted;
    std::vector<std::uint32_t> directions;
    for (const auto& [step, bends] : byDirection) {
        sorted.insert(sorted.end(), bends.begin(), bends.end());
        directions.resize(sorted.size(), bends.front());
    }
    const Colors plain = firstFit(scene, inverseMass, inScene, std::vector<std::uint32_t>(inScene.size(), 0));
    constexpr std::size_t mostBendDirections = 16; // more directions mean that there is no grid
    if (byDirection.size() > mostBendDirections) return toColoring(inScene, plain);
    const Colors directed = firstFit(scene, inverseMass, sorted, directions);
    return directed.count <= plain.count ? toColoring(sorted, directed) : toColoring(inScene, plain);
}

} // namespace sinew::sim
