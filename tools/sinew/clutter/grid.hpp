// Balls sorted into the cells of a dense grid over their bounding box, x fastest: three cells in a row along
// x are one range, so each ball reads nine ranges.
#pragma once

#include "sinew/clutter/balls.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sinew::tools::clutter {

class Grid {
public:
    /// Puts balls nearer than `edge` into the same or neighbouring cells.
    void sort(const std::vector<Vec4>& x, float edge) {
        fit(x, edge);
        start_.assign(std::size_t{size_[0]} * size_[1] * size_[2] + 1, 0);
        cell_.resize(x.size());
        for (std::size_t i = 0; i < x.size(); ++i) ++start_[cell_[i] = cellOf(x[i])];
        std::uint32_t sum = 0;
        for (std::uint32_t& start : start_) sum += start, start = sum;
        ball_.resize(x.size());
        for (std::size_t i = x.size(); i-- > 0;) ball_[--start_[cell_[i]]] = static_cast<std::uint32_t>(i);
    }

    /// Calls visit(j) for every ball in the cells around ball `i`, itself included.
    template <typename Visit> void forEachNear(std::uint32_t i, const Visit& visit) const {
        const std::uint32_t cell = cell_[i], layer = size_[0] * size_[1];
        for (std::uint32_t n = 0; n < 9; ++n) {
            const std::uint32_t row = cell + (n % 3) * size_[0] + (n / 3) * layer - size_[0] - layer;
            for (std::uint32_t k = start_[row - 1]; k < start_[row + 2]; ++k) visit(ball_[k]);
        }
    }

private:
    static constexpr std::uint32_t mostAlong = 512; // cells grow if a ball flies far away

    // Fits the box with one empty cell on all sides.
    void fit(const std::vector<Vec4>& x, float edge) {
        std::array<float, 3> high{};
        low_.fill(std::numeric_limits<float>::max());
        high.fill(std::numeric_limits<float>::lowest());
        for (const Vec4& at : x)
            for (std::size_t axis = 0; axis < 3; ++axis) {
                low_[axis] = std::min(low_[axis], at[axis]);
                high[axis] = std::max(high[axis], at[axis]);
            }
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const float wide = std::max(edge, (high[axis] - low_[axis]) / mostAlong);
            scale_[axis] = 1 / wide;
            size_[axis] = static_cast<std::uint32_t>((high[axis] - low_[axis]) * scale_[axis]) + 3;
        }
    }
    std::uint32_t cellOf(const Vec4& x) const {
        const auto index = [&](std::size_t axis) {
            return static_cast<std::uint32_t>((x[axis] - low_[axis]) * scale_[axis]) + 1;
        };
        return index(0) + size_[0] * (index(1) + size_[1] * index(2));
    }

    std::array<float, 3> low_{}, scale_{};
    std::array<std::uint32_t, 3> size_{};
    std::vector<std::uint32_t> start_, cell_, ball_;
};

} // namespace sinew::tools::clutter
