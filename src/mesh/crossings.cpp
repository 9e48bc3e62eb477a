// Crossings are made in two passes over the triangles: the first counts crossings per line, the second stores
// them.
#include "mesh/crossings.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace sinew::mesh {
namespace {

/// +1 or -1 if the ray from (u, v) towards +u crosses the edge from a to b, by the direction the edge runs
/// in; else 0. Half-open in v and evaluated from the lower end, so that both triangles beside an edge get
/// opposite answers.
int crossedEdge(const Vector3& a, const Vector3& b, std::size_t uAxis, std::size_t vAxis, double u,
                double v) {
    const bool isAboveA = a[vAxis] > v, isAboveB = b[vAxis] > v;
    if (isAboveA == isAboveB) return 0;
    const Vector3 &low = isAboveB ? a : b, &high = isAboveB ? b : a;
    const double side =
        (high[uAxis] - low[uAxis]) * (v - low[vAxis]) - (u - low[uAxis]) * (high[vAxis] - low[vAxis]);
    if (!(side > 0)) return 0;
    return isAboveB ? 1 : -1;
}

/// Samples with low <= coordinate <= high, clipped to [0, count): the first one and their number.
std::array<std::uint32_t, 2> samplesBetween(double low, double high, std::uint32_t perCell,
                                            std::uint32_t count) {
    const double first = std::max(0.0, std::ceil(low * perCell - 0.5) - 1); // rounding: one more
    const double last = std::min(count - 1.0, std::floor(high * perCell - 0.5) + 1);
    if (last < first) return {0, 0};
    return {static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(last - first) + 1};
}

} // namespace

/// Calls visit(line, turn, depth, isBelowTie) for each line that meets the triangle.
template <typename Visit>
void Crossings::cross(const std::array<Vector3, 3>& corners, const Visit& visit) const {
    const auto& [a, b, c] = corners;
    const Vector3 low = a.cwiseMin(b).cwiseMin(c), high = a.cwiseMax(b).cwiseMax(c);
    const Vector3 normal = (b - a).cross(c - a);
    const double slopeU = normal[axis_] != 0 ? -normal[u_] / normal[axis_] : 0;
    const double slopeV = normal[axis_] != 0 ? -normal[v_] / normal[axis_] : 0;
    // The moved sample's offsets decrease from x to y to z; the first axis along which the depth differs
    // decides.
    bool isBelowTie = true;
    for (std::size_t axis = axis_; axis-- > 0;)
        if (const double slope = axis == u_ ? slopeU : slopeV; slope != 0) isBelowTie = slope < 0;
    const auto [firstU, countU] = samplesBetween(low[u_], high[u_], perCell_, columns_);
    const auto [firstV, countV] = samplesBetween(low[v_], high[v_], perCell_, rows_);
    for (std::uint32_t row = firstV; row < firstV + countV; ++row)
        for (std::uint32_t column = firstU; column < firstU + countU; ++column) {
            const double u = coordinate(column), v = coordinate(row);
            const int turn = crossedEdge(a, b, u_, v_, u, v) + crossedEdge(b, c, u_, v_, u, v) +
                             crossedEdge(c, a, u_, v_, u, v);
            if (turn == 0) continue;
            const double depth = a[axis_] + slopeU * (u - a[u_]) + slopeV * (v - a[v_]);
            visit(column + std::size_t{columns_} * row, turn, std::clamp(depth, low[axis_], high[axis_]),
                  isBelowTie);
        }
}

Crossings::Crossings(const std::vector<Vector3>& positions, const Triangles& triangles,
                     std::array<std::uint32_t, 3> cells, std::uint32_t perCell, std::size_t axis)
    : axis_(axis), u_(axis == 0 ? 1 : 0), v_(axis == 2 ? 1 : 2), perCell_(perCell),
      columns_(cells[u_] * perCell), rows_(cells[v_] * perCell) {
    const auto forEachCrossing = [&](const auto& visit) {
        for (const auto& [a, b, c] : triangles) cross({positions[a], positions[b], positions[c]}, visit);
    };
    starts_.assign(std::size_t{columns_} * rows_ + 1, 0);
    forEachCrossing([&](std::size_t line, int, double, bool) { ++starts_[line + 1]; });
    std::partial_sum(starts_.begin(), starts_.end(), starts_.begin());
    crossings_.resize(starts_.back());
    std::vector<std::uint32_t> next(starts_.begin(), starts_.end() - 1);
    forEachCrossing([&](std::size_t line, int turn, double depth, bool isBelowTie) {
        crossings_[next[line]++] = {depth, static_cast<std::int8_t>(turn), isBelowTie};
    });
}

Vote Crossings::vote(const std::array<std::uint32_t, 3>& sample) const {
    const std::size_t line = sample[u_] + std::size_t{columns_} * sample[v_];
    const double depth = coordinate(sample[axis_]);
    int turnsBelow = 0, turns = 0, countBelow = 0;
    for (std::uint32_t i = starts_[line]; i < starts_[line + 1]; ++i) {
        const Crossing& crossing = crossings_[i];
        const bool isBelow = crossing.depth < depth || (crossing.depth == depth && crossing.isBelowTie);
        turns += crossing.turn;
        turnsBelow += isBelow ? crossing.turn : 0;
        countBelow += isBelow ? 1 : 0;
    }
    if (turns == 0) return turnsBelow != 0 ? Vote::inside : Vote::outside;
    if ((starts_[line + 1] - starts_[line]) % 2 == 0)
        return countBelow % 2 != 0 ? Vote::inside : Vote::outside;
    return Vote::invalid;
}

} // namespace sinew::mesh
