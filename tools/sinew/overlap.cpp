// Each ball searches grid cells as wide as the largest sum of two radii. Sums are in double, in the order of
// the scene.
#include "sinew/overlap.hpp"

#include "sim/model/links.hpp"
#include "sim/model/touching.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <unordered_map>
#include <unordered_set>

namespace sinew::tools {

namespace {

using Point = std::array<double, 3>;
using Cell = std::array<std::int64_t, 3>;

struct CellHash {
    std::size_t operator()(const Cell& cell) const {
        std::uint64_t hash = 0;
        for (const std::int64_t index : cell)
            hash = (hash ^ static_cast<std::uint64_t>(index)) * 0x9e3779b97f4a7c15u;
        return static_cast<std::size_t>(hash >> 16);
    }
};

double distance(const Point& a, const Point& b) {
    return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

// Pairs that never touch, by the rules of sim::Particle::radius.
class Apart {
public:
    explicit Apart(const sim::Scene& scene) : scene_(scene), body_(scene.particles.size()) {
        std::iota(body_.begin(), body_.end(), 0u);
        sim::forEachLinkedPair(scene, [this](std::uint32_t a, std::uint32_t b) { link(a, b); });
    }

    bool hold(std::uint32_t i, std::uint32_t j) {
        if (root(i) != root(j)) return false;
        if (linked_.contains(keyOf(i, j))) return true;
        const sim::Particle &a = scene_.particles[i], &b = scene_.particles[j];
        return distance(restOf(a), restOf(b)) < 1.05 * (double{a.radius} + double{b.radius});
    }

private:
    static Point restOf(const sim::Particle& p) {
        return {double{p.position.x}, double{p.position.y}, double{p.position.z}};
    }
    static std::uint64_t keyOf(std::uint32_t i, std::uint32_t j) {
        return std::uint64_t{std::min(i, j)} << 32 | std::max(i, j);
    }
    std::uint32_t root(std::uint32_t i) {
        while (body_[i] != i) i = body_[i] = body_[body_[i]];
        return i;
    }
    void link(std::uint32_t i, std::uint32_t j) {
        const std::uint32_t a = root(i), b = root(j);
        body_[std::max(a, b)] = std::min(a, b);
        linked_.insert(keyOf(i, j));
    }
    const sim::Scene& scene_;
    std::vector<std::uint32_t> body_;
    std::unordered_set<std::uint64_t> linked_;
};

// Calls visit(i, j) once for every two particles in the same or in neighbouring cells.
template <typename Visit>
void forEachNear(const std::vector<std::uint32_t>& particles, const std::vector<Point>& x, double edge,
                 const Visit& visit) {
    std::unordered_map<Cell, std::vector<std::uint32_t>, CellHash> cells;
    const auto cellOf = [&](std::uint32_t i) {
        Cell cell{};
        for (std::size_t axis = 0; axis < 3; ++axis)
            cell[axis] = static_cast<std::int64_t>(std::clamp(std::floor(x[i][axis] / edge), -1e15, 1e15));
        return cell;
    };
    for (const std::uint32_t i : particles) { // those already there have lower indices
        const Cell home = cellOf(i);
        for (std::int64_t n = 0; n < 27; ++n) {
            const auto found =
                cells.find({home[0] + n % 3 - 1, home[1] + n / 3 % 3 - 1, home[2] + n / 9 - 1});
            if (found == cells.end()) continue;
            for (const std::uint32_t j : found->second) visit(j, i);
        }
        cells[home].push_back(i);
    }
}

} // namespace

std::optional<Overlap> overlapOf(const sim::Scene& scene, const State& state) {
    if (!sim::particlesTouch(scene)) return {};
    std::vector<std::uint32_t> wide;
    std::vector<Point> x(scene.particles.size());
    double largest = 0;
    for (std::uint32_t i = 0; i < scene.particles.size(); ++i) {
        const auto& at = state.positions[i];
        x[i] = {double{at[0]}, double{at[1]}, double{at[2]}};
        const bool isPlaced = std::isfinite(at[0]) && std::isfinite(at[1]) && std::isfinite(at[2]);
        if (scene.particles[i].radius <= 0 || !isPlaced || !state.has(i)) continue;
        wide.push_back(i);
        largest = std::max(largest, double{scene.particles[i].radius});
    }
    Apart apart(scene);
    Overlap overlap;
    double squares = 0;
    forEachNear(wide, x, 2 * largest, [&](std::uint32_t i, std::uint32_t j) {
        const double touching = double{scene.particles[i].radius} + double{scene.particles[j].radius};
        const double depth = touching - distance(x[i], x[j]);
        if (depth <= 0 || (state.positions[i][3] == 0 && state.positions[j][3] == 0) || apart.hold(i, j))
            return;
        overlap.max = std::max(overlap.max, depth);
        squares += depth * depth;
        ++overlap.pairs;
    });
    if (overlap.pairs > 0) overlap.rms = std::sqrt(squares / static_cast<double>(overlap.pairs));
    return overlap;
}

} // namespace sinew::tools
