// A fixed particle has an infinite mass. It takes no correction and no gravity in any kernel, so it needs no
// pass.
#include "sinew/inverse_masses.hpp"

namespace sinew::sim {

std::vector<float> inverseMasses(const Scene& scene) {
    std::vector<float> result;
    result.reserve(scene.particles.size());
    for (const Particle& particle : scene.particles) result.push_back(particle.inverseMass);
    for (const FixedConstraint& constraint : scene.fixed) result[constraint.particle] = 0;
    return result;
}

} // namespace sinew::sim
