// More particles in one place than contacts can list: known before anything is made of the scene.
#pragma once

#include "sim/complaints.hpp"
#include "sim/scene.hpp"

namespace sinew::sim::collision {

/// Complains of places in which more than ranges::mostInOneSpot particles of other bodies lie so near a
/// particle that it touches each of them, with the names of the bodies. `scene` is right otherwise. Counts
/// only what can touch and moves; linear in the number of particles.
void checkCrowding(const Scene& scene, Complaints& complaints);

} // namespace sinew::sim::collision
