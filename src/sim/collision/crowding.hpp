// Detection of more particles in one place than contact lists can hold, before a scene is compiled.
#pragma once

#include "sim/core/complaints.hpp"
#include "sinew/scene.hpp"

namespace sinew::sim::collision {

/// Complains about places where a particle touches more than ranges::mostInOneSpot particles of other bodies,
/// with the names of the bodies. `scene` must be otherwise valid. Counts only moving particles that can
/// touch; linear in the number of particles.
void checkCrowding(const Scene& scene, Complaints& complaints);

} // namespace sinew::sim::collision
