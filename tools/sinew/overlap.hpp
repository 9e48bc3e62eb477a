// Exact overlap of particles that touch: on the host, over all pairs, with its own grid, independent of the
// device's lists.
#pragma once

#include "sinew/measure.hpp"

namespace sinew::tools {

struct Overlap {
    double max = 0;        ///< of the deepest pair [m]
    double rms = 0;        ///< root mean square over overlapping pairs [m]; 0 without any
    std::size_t pairs = 0; ///< overlapping pairs
};

/// Measures pairs that may touch: both have a radius, one can move, no link joins them, and, within one
/// linked body, their rest distance is at least 1.05 times the sum of radii. Empty if the scene has no such
/// particles.
std::optional<Overlap> overlapOf(const sim::Scene& scene, const State& state);

} // namespace sinew::tools
