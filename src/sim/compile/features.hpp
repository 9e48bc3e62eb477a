// The features of a step, one row each.
#pragma once

#include "sim/model/feature.hpp"

namespace sinew::sim {

/// All features. At each stage they add their passes in this order.
std::span<const Feature> features();

} // namespace sinew::sim
