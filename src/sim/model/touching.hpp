// Values by particle that decide whether parts of a scene may touch.
#pragma once

#include "sinew/touching.hpp"

#include <span>
#include <vector>

namespace sinew::sim {

/// By particle the radius with which it touches others as a sphere [m]: 0 if faces around it are at least as
/// thick and touch in its place.
std::vector<float> looseRadii(const Scene& scene);

/// By particle Body::arrival; each body that may be absent has a number of its own.
std::vector<std::uint32_t> arrivals(const Scene& scene);

/// particlesTouch() and facesTouch() of a scene, for those who know these values.
bool particlesTouch(std::span<const float> inverseMass, std::span<const float> looseRadii);
bool facesTouch(const Scene& scene, std::span<const float> inverseMass);

} // namespace sinew::sim
