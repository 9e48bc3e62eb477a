// A scene that begins with too little room for its contacts, and makes more as steps say what they need.
#pragma once

#include "sim/runner.hpp"

#include <functional>

namespace sinew::test {

struct GrowingRun {
    std::uint64_t hash = 0; ///< of the state at the end
    int growths = 0;
};

/// `steps` steps from room for one contact on. One that finds too little must say how much it needs and leave
/// the state as it was; a simulation with that much takes over and does it again. `afterStep` is called after
/// each that came to its end.
GrowingRun runGrowing(const sim::Scene& scene, sim::Settings settings, int steps,
                      const std::function<void(Runner&)>& afterStep = {});

} // namespace sinew::test
