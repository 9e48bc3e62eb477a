// Why no pass: an infinite mass takes no correction and no gravity in any kernel, exactly and for free.
#include "sim/constraints/fixed.hpp"

namespace sinew::sim::constraints::fixed {

void apply(std::span<const FixedConstraint> constraints, std::span<float> inverseMass) {
    for (const FixedConstraint& constraint : constraints) inverseMass[constraint.particle] = 0;
}

} // namespace sinew::sim::constraints::fixed
