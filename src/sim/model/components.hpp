// Connected components by links, as the scene has them: sleep and grabs find the rest of a body with them.
#pragma once

#include "sinew/scene.hpp"

#include <span>

namespace sinew::sim {

/// For each particle the smallest index in its component, connected by links (links.hpp). Static particles
/// (inverse mass 0) do not connect others.
std::vector<std::uint32_t> linkedComponents(const Scene& scene, std::span<const float> inverseMass);

/// The same, but connected also through static particles.
std::vector<std::uint32_t> linkedBodies(const Scene& scene);

} // namespace sinew::sim
