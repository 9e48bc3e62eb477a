// Inside test of the sample points of a cell grid: by the votes of the lines along x, y and z, and where
// these disagree by the generalised winding number [Jacobson 2013], |w| > 0.5.
#pragma once

#include "mesh/crossings.hpp"
#include "mesh/triangle_tree.hpp"

namespace sinew::mesh {

class Inside {
public:
    /// `positions` in cell units, and `tree` over the same triangles, which must outlive this object. Each
    /// cell edge holds `perCell` samples, at (i + 1/2) / perCell for i = 0, 1, ...
    Inside(const std::vector<Vector3>& positions, const Crossings::Triangles& triangles,
           const TriangleTree& tree, std::array<std::uint32_t, 3> cells, std::uint32_t perCell);

    struct Answer {
        bool isInside = false;
        bool isDoubtful = false; ///< the votes disagreed
    };
    Answer operator()(const std::array<std::uint32_t, 3>& sample) const;

    std::size_t bytes() const { ///< without the tree
        return crossings_[0].bytes() + crossings_[1].bytes() + crossings_[2].bytes();
    }

private:
    std::array<Crossings, 3> crossings_;
    std::uint32_t perCell_;
    const TriangleTree& tree_;
};

} // namespace sinew::mesh
