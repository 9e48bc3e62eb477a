// Driven bodies: particles that follow a path. They are set after the links of a substep and before its
// contacts, which they push and carry without giving way. A scene without moving driven bodies has no such
// pass.
#pragma once

#include "sim/rigid/colliders.hpp"

namespace sinew::sim::rigid::driven {

struct Driven {
    std::uint32_t count = 0; ///< particles
    std::uint32_t row = 0;   ///< number of poses in a substep
    BufferId particles, poses;
};

/// Keeps Driven, whose poses follow those of the colliders.
void add(Build& build);

/// Appends the pass that moves them to their pose at the end of a substep.
void addPass(Build& build, const Substep& substep);

/// By particle: whether it belongs to a driven body that moves.
std::vector<bool> areDriven(const Scene& scene);

} // namespace sinew::sim::rigid::driven
