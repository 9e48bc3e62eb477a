// Runs a scene that starts with too small a contact capacity, and enlarges it as steps report their need.
#pragma once

#include "sim/runner.hpp"

#include <functional>

namespace sinew::test {

struct GrowingRun {
    std::uint64_t hash = 0; ///< of the final state
    int growths = 0;
};

/// Runs `steps` steps, starting with capacity for one contact. A step that lacks capacity must report its
/// need and leave the state unchanged; a simulation with that capacity takes over and repeats the step. Calls
/// `afterStep` after each completed step.
GrowingRun runGrowing(const sim::Scene& scene, sim::Settings settings, int steps,
                      const std::function<void(Runner&)>& afterStep = {});

} // namespace sinew::test
