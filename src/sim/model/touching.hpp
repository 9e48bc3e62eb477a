// Whether parts of a scene may touch, in contacts that only `split` has a form for.
#pragma once

#include "sinew/scene.hpp"

#include <span>
#include <vector>

namespace sinew::sim {

/// By particle the radius with which it touches others as a sphere [m]: 0 if faces around it are at least as
/// thick and touch in its place.
std::vector<float> looseRadii(const Scene& scene);

/// By particle Body::arrival; each body that may be absent has a number of its own.
std::vector<std::uint32_t> arrivals(const Scene& scene);

/// Whether two particles with a radius may touch each other, at least one of which moves.
bool particlesTouch(const Scene& scene);
bool particlesTouch(std::span<const float> inverseMass, std::span<const float> looseRadii);

/// Whether particles with a radius may touch faces, with a particle or a face that moves.
bool facesTouch(const Scene& scene);
bool facesTouch(const Scene& scene, std::span<const float> inverseMass);

} // namespace sinew::sim
