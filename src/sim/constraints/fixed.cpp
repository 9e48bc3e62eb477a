// Inverse mass 0 replaces a pass: every kernel then applies no correction and no gravity, exactly and at no
// cost.
#include "sim/constraints/fixed.hpp"

namespace sinew::sim::constraints::fixed {

void apply(std::span<const FixedConstraint> constraints, std::span<float> inverseMass) {
    for (const FixedConstraint& constraint : constraints) inverseMass[constraint.particle] = 0;
}

} // namespace sinew::sim::constraints::fixed
