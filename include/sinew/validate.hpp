// Validation of a Scene and its Settings: complaints as sentences that name the item, the value and the
// allowed range.
#pragma once

#include "sinew/export.hpp"
#include "sinew/scene.hpp"

namespace sinew::sim {

/// Errors only; an empty list means that the scene can be compiled. At most 20 sentences, then a count of the
/// rest. Example: "distance[17]: particles 4 and 4 are the same".
SINEW_API std::vector<std::string> validate(const Scene& scene, const Settings& settings);

/// Sentences about scenes that can be computed but are probably not intended: positions so far from the
/// origin that float32 rounds them coarsely. Simulation::complaints() returns them once.
SINEW_API std::vector<std::string> warnings(const Scene& scene);

/// Complaints about the settings, whatever the scene. Cheap.
SINEW_API std::vector<std::string> validate(const Settings& settings);

/// Whether a body added to `scene` can have Lattice::recovery: solver `split` computes its grid, and omega
/// leaves room for the pressure.
SINEW_API bool canRecover(const Scene& scene, const Settings& settings);

/// Throws std::invalid_argument with `complaints`, one sentence a line, if there are any.
SINEW_API void requireNone(const std::vector<std::string>& complaints);

} // namespace sinew::sim
