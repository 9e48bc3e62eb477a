#include "sim/cutting/faced_bodies.hpp"

#include <cmath>

namespace sinew::test {

using namespace sim;

Lattice facedLattice(std::array<std::uint32_t, 3> cells, float youngModulus, bool isCuttable) {
    return {.cells = cells,
            .spacing = facedSpacing,
            .youngModulus = youngModulus,
            .radius = facedSpacing / 2,
            .isCuttable = isCuttable};
}

std::vector<std::uint32_t> particlesWhere(const Scene& scene, const std::function<bool(const Vec3&)>& isIn) {
    std::vector<std::uint32_t> result;
    for (std::uint32_t i = 0; i < scene.particles.size(); ++i)
        if (isIn(scene.particles[i].position)) result.push_back(i);
    return result;
}

Pose poseAt(const Vec3& position, double turn) {
    return {position, {static_cast<float>(std::sin(turn / 2)), 0, 0, static_cast<float>(std::cos(turn / 2))}};
}

} // namespace sinew::test
