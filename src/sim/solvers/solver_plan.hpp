// The plan of a solver: its layout of the state, and the function that adds its passes.
#pragma once

#include "sim/model/state.hpp"

#include <functional>
#include <vector>

namespace sinew::sim::solvers {

/// A solver's choices for a scene, made before anything is built.
struct SolverPlan {
    StateLayout layout;
    std::vector<float> positionW; ///< by particle: the w of the state's positions
    /// Appends the passes of the phase "solve". Refers to the scene and contains all other inputs of the
    /// plan.
    std::function<void(ProgramBuilder& program, const ParticleBuffers& particles)> addPasses;
};

} // namespace sinew::sim::solvers
