// Crossings of a surface with a bundle of parallel lines: each line lies along one axis of a cell grid and
// runs through the sample points of a row of cells. One line answers "inside or outside?" for all samples on
// it.
//
// Signs are exact: every triangle edge is classified once per line with one expression, so the two triangles
// beside it always agree and a closed surface crosses every line an even number of times, up and down in
// equal number, whatever the rounding. Ties are broken as if every sample were moved by (e1, e2, e3), e1 >>
// e2 >> e3 > 0.
#pragma once

#include "mesh/vector3.hpp"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace sinew::mesh {

enum class Vote : std::uint8_t { outside, inside, invalid };

class Crossings {
public:
    using Triangles = std::vector<std::array<std::uint32_t, 3>>;

    /// `positions` in cell units, 0 at the grid's low corner. Each cell edge holds `perCell` samples, at
    /// (i + 1/2) / perCell for i = 0, 1, ...
    Crossings(const std::vector<Vector3>& positions, const Triangles& triangles,
              std::array<std::uint32_t, 3> cells, std::uint32_t perCell, std::size_t axis);

    /// The vote of this axis on a sample. A line that the surface enters as often as it leaves it counts
    /// windings, so overlapping parts are inside; one with an even number of crossings counts parity, so
    /// flipped triangles do no harm; any other line has met a hole: invalid.
    Vote vote(const std::array<std::uint32_t, 3>& sample) const;

    std::size_t bytes() const {
        return starts_.size() * sizeof(starts_[0]) + crossings_.size() * sizeof(Crossing);
    }

private:
    struct Crossing {
        double depth = 0;        ///< along the axis, in cell units
        std::int8_t turn = 0;    ///< +1 or -1: the side of the surface that the axis points to
        bool isBelowTie = false; ///< at equal depth the moved sample lies beyond the crossing
    };

    template <typename Visit> void cross(const std::array<Vector3, 3>& corners, const Visit& visit) const;
    double coordinate(std::uint32_t sample) const { return (sample + 0.5) / perCell_; }

    std::size_t axis_, u_, v_;
    std::uint32_t perCell_, columns_, rows_;
    std::vector<std::uint32_t> starts_; ///< per line, u fastest; one more at the end
    std::vector<Crossing> crossings_;
};

} // namespace sinew::mesh
