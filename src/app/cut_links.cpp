// A link that lies in no body that may be cut has no bits, and is alive.
#include "app/cut_links.hpp"

#include "sim/lattice/link_bits.hpp"

#include <algorithm>
#include <cmath>

namespace sinew::app {

CutLinks::CutLinks(const sim::Scene& scene, std::span<const std::uint32_t> slot) {
    places_.reserve(scene.distances.size());
    for (std::size_t d = 0; d < scene.distances.size(); ++d) {
        const sim::lattice::LinkBits bits = sim::lattice::linkBits(scene, d);
        places_.push_back({.slotOfA = slot[scene.distances[d].a],
                           .ofA = bits.ofA,
                           .slotOfOver = slot[bits.over],
                           .ofOver = bits.ofOver});
    }
}

void StrainSum::add(double strain) {
    squares_ += strain * strain;
    largest_ = std::max(largest_, std::abs(strain));
    ++links_;
}

LinkStrain StrainSum::result() const {
    if (links_ == 0) return {};
    return {std::sqrt(squares_ / static_cast<double>(links_)), largest_, links_};
}

void eachStrain(const sim::Scene& scene, std::span<const float> positions,
                const std::function<bool(std::size_t)>& counts,
                const std::function<void(std::size_t, double)>& give) {
    for (std::size_t d = 0; d < scene.distances.size(); ++d) {
        const sim::DistanceConstraint& link = scene.distances[d];
        if (!(link.restLength > 0) || !counts(d)) continue;
        double square = 0;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double way = double{positions[4 * std::size_t{link.b} + axis]} -
                               double{positions[4 * std::size_t{link.a} + axis]};
            square += way * way;
        }
        give(d, std::sqrt(square) / double{link.restLength} - 1);
    }
}

LinkStrain strainOf(const sim::Scene& scene, std::span<const float> positions,
                    const std::function<bool(std::size_t)>& counts) {
    StrainSum sum;
    eachStrain(scene, positions, counts, [&](std::size_t, double strain) { sum.add(strain); });
    return sum.result();
}

} // namespace sinew::app
