// Pairs of particles of linked bodies that may not touch, from the scene at rest. Bodies are assumed to start
// at rest; other initial positions are used as they are.
#include "sim/collision/contact_lists.hpp"
#include "sim/model/links.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>

namespace sinew::sim::collision::contact_lists {

namespace {

using Pair = std::array<std::uint32_t, 2>;

std::vector<Pair> linkedPairs(const Scene& scene) {
    std::vector<Pair> pairs;
    forEachLinkedPair(scene, [&](std::uint32_t a, std::uint32_t b) { pairs.push_back({a, b}); });
    return pairs;
}

using Cell = std::array<std::int64_t, 3>;

double distance(const Vec3& a, const Vec3& b) {
    return std::hypot(double{a.x} - double{b.x}, double{a.y} - double{b.y}, double{a.z} - double{b.z});
}

// Pairs of one body with a distance below 1.05 times contact distance; body by body, so that a large particle
// of one does not enlarge the cells of another.
class NearPairs {
public:
    NearPairs(const Scene& scene, std::span<const float> radii) : scene_(scene), radii_(radii) {}

    void add(std::span<const std::uint32_t> body, std::vector<Pair>& pairs) const {
        double edge = 0;
        for (const std::uint32_t i : body) edge = std::max(edge, nearness * 2 * double{radii_[i]});
        if (edge <= 0) return;
        std::map<Cell, std::vector<std::uint32_t>> cells;
        for (const std::uint32_t i : body)
            if (radii_[i] >= 0) cells[cellOf(i, edge)].push_back(i);
        for (const auto& [cell, members] : cells)
            for (std::int64_t n = 0; n < 27; ++n) {
                const auto found =
                    cells.find({cell[0] + n % 3 - 1, cell[1] + n / 3 % 3 - 1, cell[2] + n / 9 - 1});
                if (found != cells.end()) addNear(members, found->second, pairs);
            }
    }

private:
    static constexpr double nearness = 1.05;

    Cell cellOf(std::uint32_t i, double edge) const {
        const Vec3& x = scene_.particles[i].position;
        const auto index = [edge](float value) {
            return static_cast<std::int64_t>(std::floor(double{value} / edge));
        };
        return {index(x.x), index(x.y), index(x.z)};
    }

    void addNear(std::span<const std::uint32_t> first, std::span<const std::uint32_t> second,
                 std::vector<Pair>& pairs) const {
        for (const std::uint32_t i : first)
            for (const std::uint32_t j : second)
                if (i < j && distance(scene_.particles[i].position, scene_.particles[j].position) <
                                 nearness * (double{radii_[i]} + double{radii_[j]}))
                    pairs.push_back({i, j});
    }

    const Scene& scene_;
    std::span<const float> radii_;
};

Exclusions listed(std::vector<Pair> pairs, const StateLayout& layout) {
    for (Pair& pair : pairs) {
        const auto [first, second] = std::minmax(layout.slot[pair[0]], layout.slot[pair[1]]);
        pair = {first, second};
    }
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    Exclusions result(layout.count + 1);
    std::size_t next = 0;
    for (std::uint32_t i = 0; i <= layout.count; ++i) {
        while (next < pairs.size() && pairs[next][0] < i) ++next;
        result[i] = static_cast<std::uint32_t>(layout.count + 1 + next);
    }
    for (const Pair& pair : pairs) result.push_back(pair[1]);
    return result;
}

} // namespace

std::vector<std::uint32_t> linkedMarks(const SceneModel& model) {
    const Scene& scene = model.scene;
    const StateLayout& layout = model.layout;
    std::vector<std::uint32_t> marks(layout.count, 0);
    const std::vector<std::uint32_t>& bodies = model.linkedBodies();
    for (std::size_t i = 0; i < bodies.size(); ++i)
        marks[layout.slot[i]] = 4 * bodies[i] + (scene.particles[i].keepsRest ? 1 : 0);
    for (const Grid& grid : scene.grids)
        for (std::uint32_t i = 0; grid.isCuttable && i < grid.node.size(); ++i)
            marks[layout.slot[grid.firstParticle + i]] |= 2;
    return marks;
}

Exclusions excludedPairs(const Scene& scene, std::span<const std::uint32_t> bodies,
                         std::span<const float> radii, const StateLayout& layout) {
    std::vector<Pair> pairs = linkedPairs(scene);
    if (pairs.empty()) return {};
    std::vector<std::uint32_t> order(bodies.size());
    std::iota(order.begin(), order.end(), 0u);
    std::stable_sort(order.begin(), order.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return bodies[a] < bodies[b]; });
    const NearPairs nearPairs(scene, radii);
    for (std::size_t first = 0; first < order.size();) {
        std::size_t end = first + 1;
        while (end < order.size() && bodies[order[end]] == bodies[order[first]]) ++end;
        if (end - first > 1) nearPairs.add(std::span(order).subspan(first, end - first), pairs);
        first = end;
    }
    std::erase_if(pairs, [&](const Pair& p) { return radii[p[0]] < 0 || radii[p[1]] < 0; });
    return pairs.empty() ? Exclusions{} : listed(std::move(pairs), layout);
}

} // namespace sinew::sim::collision::contact_lists
