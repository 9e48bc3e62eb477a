// Exact count of edges that pass through faces: on the host, over all edges and faces, independent of the
// device's contacts.
#pragma once

#include "sinew/measure.hpp"

#include <cstddef>
#include <optional>

namespace sinew::tools {

/// Number of pairs of an edge of a movable face and a face (sim::Scene::faces) such that the edge passes
/// through the face. Excludes pairs with a common corner, and faces with a side that was cut or a corner in a
/// removed fragment. Empty if the scene has no movable face.
std::optional<std::size_t> crossingsOf(const sim::Scene& scene, const State& state);

} // namespace sinew::tools
