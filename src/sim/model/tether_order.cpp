// Tethers of one particle keep their order in the scene.
#include "sim/model/tether_order.hpp"

#include "sim/model/inverse_masses.hpp"

#include <algorithm>
#include <iterator>

namespace sinew::sim {

std::vector<Tether> tethersInOrder(const Scene& scene) {
    const std::vector<float> inverseMass = inverseMasses(scene);
    std::vector<Tether> sorted;
    std::ranges::copy_if(scene.tethers, std::back_inserter(sorted),
                         [&](const Tether& tether) { return inverseMass[tether.particle] > 0; });
    std::ranges::stable_sort(sorted, {}, &Tether::particle);
    return sorted;
}

} // namespace sinew::sim
