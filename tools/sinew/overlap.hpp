// How deep particles that touch each other are in each other, exactly and over all pairs: found on the host,
// by a grid of its own, whatever the lists of the device said.
#pragma once

#include "sinew/measure.hpp"

namespace sinew::tools {

struct Overlap {
    double max = 0; ///< of the deepest pair [m]
    double rms = 0; ///< root mean square over the pairs nearer than touching [m]; 0 where there is none
    std::size_t pairs = 0; ///< nearer than touching
};

/// Of pairs that may touch: both have a radius, one can move, nothing links them, and if they are of one
/// linked body they are at rest no nearer than 1.05 times touching. Empty where the scene has no such
/// particles.
std::optional<Overlap> overlapOf(const sim::Scene& scene, const State& state);

} // namespace sinew::tools
