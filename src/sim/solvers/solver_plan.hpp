// The plan of a solver: what its state holds, and the function that adds its passes.
#pragma once

#include "sim/model/feature.hpp"

#include <functional>
#include <vector>

namespace sinew::sim::solvers {

/// A solver's choices for a scene, made before anything is built.
struct SolverPlan {
    std::vector<float> positionW; ///< by particle: the w of the state's positions
    std::vector<float> mostW;     ///< the most that the state may raise it to; empty if nothing changes it
    /// Appends the passes of the phase "solve".
    std::function<void(Build& build)> addPasses;
};

} // namespace sinew::sim::solvers
