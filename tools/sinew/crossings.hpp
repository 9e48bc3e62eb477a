// How often surfaces pass through each other, exactly and over all edges and faces: found on the host,
// whatever contacts of the device said.
#pragma once

#include "sinew/measure.hpp"

#include <cstddef>
#include <optional>

namespace sinew::tools {

/// Pairs of an edge of a face that can move and a face (sim::Scene::faces) such that the edge passes through
/// the face. Pairs with a corner in common do not count, nor do faces of which a cut has parted a side or a
/// crumb has taken a corner. Empty where the scene has no face that can move.
std::optional<std::size_t> crossingsOf(const sim::Scene& scene, const State& state);

} // namespace sinew::tools
