// Combines three bundles of lines and a tree.
#include "mesh/inside.hpp"

#include <cmath>

namespace sinew::mesh {

Inside::Inside(const std::vector<Vector3>& positions, const Crossings::Triangles& triangles,
               const TriangleTree& tree, std::array<std::uint32_t, 3> cells, std::uint32_t perCell)
    : crossings_{Crossings(positions, triangles, cells, perCell, 0),
                 Crossings(positions, triangles, cells, perCell, 1),
                 Crossings(positions, triangles, cells, perCell, 2)},
      perCell_(perCell), tree_(tree) {}

Inside::Answer Inside::operator()(const std::array<std::uint32_t, 3>& sample) const {
    const Vote vote = crossings_[0].vote(sample);
    if (vote != Vote::invalid && crossings_[1].vote(sample) == vote && crossings_[2].vote(sample) == vote)
        return {vote == Vote::inside, false};
    const Vector3 point = Vector3(sample[0] + 0.5, sample[1] + 0.5, sample[2] + 0.5) / perCell_;
    return {std::abs(tree_.windingNumber(point)) > 0.5, true};
}

} // namespace sinew::mesh
