// Particles sorted into columns along gravity, to find those above an object.
#pragma once

#include "sim/collision/vectors.hpp"
#include "sinew/scene.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

namespace sinew::sim::stiffness {

/// Columns as wide as the median link of the scene. Keeps `places` by reference.
class Columns {
public:
    Columns(const Scene& scene, const std::vector<collision::Vector>& places,
            std::span<const std::uint32_t> particles, const collision::Vector& down);

    /// Calls visit(particle, way) for particles in columns that overlap a square of side 2 `half` around
    /// `place`; `way` is how far below the particle the place is [m], negative if it is above.
    template <typename Visit>
    void visitBelow(const collision::Vector& place, double half, const Visit& visit) const {
        const collision::Vector at = onMap(place);
        const double reach = half / width_;
        forEachColumn({at[1] - reach, at[1] + reach}, {at[2] - reach, at[2] + reach},
                      [&](double, double, const std::vector<std::uint32_t>& column) {
                          for (const std::uint32_t i : column) visit(i, at[0] - depthOf(i));
                      });
    }

    /// Calls visit for particles in columns that overlap a triangle; `way` is to its depth at the middle of
    /// the column.
    template <typename Visit>
    void visitBelow(const std::array<collision::Vector, 3>& corners, const Visit& visit) const {
        const std::array<collision::Vector, 3> on{onMap(corners[0]), onMap(corners[1]), onMap(corners[2])};
        const auto bounds = [&](std::size_t axis) {
            return std::pair(std::min({on[0][axis], on[1][axis], on[2][axis]}),
                             std::max({on[0][axis], on[1][axis], on[2][axis]}));
        };
        forEachColumn(bounds(1), bounds(2),
                      [&](double x, double y, const std::vector<std::uint32_t>& column) {
                          double depth = 0;
                          if (meets(on, x, y, depth))
                              for (const std::uint32_t i : column) visit(i, depth - depthOf(i));
                      });
    }

private:
    using Key = std::pair<std::int64_t, std::int64_t>;
    struct Hash {
        std::size_t operator()(const Key& key) const {
            return static_cast<std::size_t>(static_cast<std::uint64_t>(key.first) * 73856093 ^
                                            static_cast<std::uint64_t>(key.second) * 19349663);
        }
    };

    // Depth [m], and the position across in units of columns.
    collision::Vector onMap(const collision::Vector& place) const;
    double depthOf(std::uint32_t i) const { return collision::dot(places_[i], frame_[0]); }
    // Whether a triangle overlaps the square of a column, and its depth there [m].
    static bool meets(const std::array<collision::Vector, 3>& corners, double x, double y, double& depth);

    template <typename Visit>
    void forEachColumn(const std::pair<double, double>& x, const std::pair<double, double>& y,
                       const Visit& visit) const {
        const double columns = (x.second - x.first + 1) * (y.second - y.first + 1);
        if (!(columns < static_cast<double>(columns_.size()))) {
            for (const auto& [key, column] : columns_) {
                const double i = static_cast<double>(key.first), j = static_cast<double>(key.second);
                if (i >= x.first - 0.5 && i <= x.second + 0.5 && j >= y.first - 0.5 && j <= y.second + 0.5)
                    visit(i, j, column);
            }
            return;
        }
        for (std::int64_t j = std::llround(y.first); j <= std::llround(y.second); ++j)
            for (std::int64_t i = std::llround(x.first); i <= std::llround(x.second); ++i)
                if (const auto found = columns_.find({i, j}); found != columns_.end())
                    visit(static_cast<double>(i), static_cast<double>(j), found->second);
    }

    const std::vector<collision::Vector>& places_;
    std::array<collision::Vector, 3> frame_; // down first
    double width_ = 1;                       // [m]
    std::unordered_map<Key, std::vector<std::uint32_t>, Hash> columns_;
};

} // namespace sinew::sim::stiffness
