// Every complaint about a Scene or its Settings, as sentences that name the item, the value and the allowed
// range.
#pragma once

#include "sim/scene.hpp"

namespace sinew::sim {

/// Errors only; an empty list means the scene can be compiled. At most 20 sentences, then a count of the
/// rest. Example: "distance[17]: particles 4 and 4 are the same".
std::vector<std::string> validate(const Scene& scene, const Settings& settings);

/// Sentences about scenes that can be computed and are likely not meant: positions so far from the origin
/// that float32 rounds them coarsely. Simulation::complaints() says them once.
std::vector<std::string> warnings(const Scene& scene);

/// Those about the settings, whatever the scene. Cheap.
std::vector<std::string> validate(const Settings& settings);

/// Whether a body that comes to `scene` next can have Lattice::recovery: solver split computes its grid, and
/// omega leaves room for the pressure.
bool canRecover(const Scene& scene, const Settings& settings);

/// Throws std::invalid_argument, one sentence a line, where there are any.
void requireNone(const std::vector<std::string>& complaints);

} // namespace sinew::sim
