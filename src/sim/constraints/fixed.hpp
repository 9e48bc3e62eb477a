// Fixed constraints: a particle stays at its position in the scene. They compile to inverse mass 0, hence to
// no pass and no buffer.
#pragma once

#include "sim/scene.hpp"

#include <span>

namespace sinew::sim::constraints::fixed {

/// Sets the inverse mass of every fixed particle to 0; one entry a particle.
void apply(std::span<const FixedConstraint> constraints, std::span<float> inverseMass);

} // namespace sinew::sim::constraints::fixed
