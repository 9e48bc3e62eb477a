// What is linked, as the scene has it: by whom sleep and hands find the rest of a body.
#pragma once

#include "sim/scene.hpp"

#include <span>

namespace sinew::sim {

/// The smallest index among the particles that distance and bend constraints link each one to. What never
/// moves (inverse mass 0) links nothing.
std::vector<std::uint32_t> linkedComponents(const Scene& scene, std::span<const float> inverseMass);

} // namespace sinew::sim
