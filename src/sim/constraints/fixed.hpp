// Fixed constraints: a particle stays where the scene puts it. Compiles to inverse mass 0, so to no pass and
// no buffer.
#pragma once

#include "sim/scene.hpp"

#include <span>

namespace sinew::sim::constraints::fixed {

/// Sets the inverse mass of every fixed particle to 0; one entry a particle.
void apply(std::span<const FixedConstraint> constraints, std::span<float> inverseMass);

} // namespace sinew::sim::constraints::fixed
