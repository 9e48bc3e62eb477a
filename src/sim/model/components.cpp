// Union-find with path halving.
#include "sim/model/components.hpp"

#include "sim/model/links.hpp"

#include <algorithm>
#include <numeric>

namespace sinew::sim {

namespace {

// `connects(a, b)`: whether links between these particles count.
template <typename Connects> std::vector<std::uint32_t> unite(const Scene& scene, const Connects& connects) {
    std::vector<std::uint32_t> parent(scene.particles.size());
    std::iota(parent.begin(), parent.end(), 0u);
    const auto root = [&parent](std::uint32_t i) {
        while (parent[i] != i) i = parent[i] = parent[parent[i]];
        return i;
    };
    const auto join = [&](std::uint32_t a, std::uint32_t b) {
        if (!connects(a, b)) return;
        const std::uint32_t first = root(a), second = root(b);
        parent[std::max(first, second)] = std::min(first, second);
    };
    forEachLinkedPair(scene, join);
    for (std::uint32_t i = 0; i < parent.size(); ++i) parent[i] = root(i);
    return parent;
}

} // namespace

std::vector<std::uint32_t> linkedComponents(const Scene& scene, std::span<const float> inverseMass) {
    return unite(
        scene, [&](std::uint32_t a, std::uint32_t b) { return inverseMass[a] != 0 && inverseMass[b] != 0; });
}

std::vector<std::uint32_t> linkedBodies(const Scene& scene) {
    return unite(scene, [](std::uint32_t, std::uint32_t) { return true; });
}

} // namespace sinew::sim
