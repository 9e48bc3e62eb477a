// Tethers of particles that move.
#pragma once

#include "sinew/scene.hpp"

#include <vector>

namespace sinew::sim {

/// Tethers of moving particles, sorted by particle: the order on the device.
std::vector<Tether> tethersInOrder(const Scene& scene);

} // namespace sinew::sim
