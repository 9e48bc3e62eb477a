// Comparison of a grid with the particles and constraints that it names.
#pragma once

#include "sinew/scene.hpp"

#include <optional>

namespace sinew::sim::lattice {

/// The first error of `grid`, as the rest of a sentence that begins with its name. Constraints with an end
/// that does not exist are left to the check of constraints.
std::optional<std::string> complaintAbout(const Scene& scene, const Grid& grid);

} // namespace sinew::sim::lattice
