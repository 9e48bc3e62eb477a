#include "sim/model/rounding.hpp"

#include <algorithm>
#include <cmath>

namespace sinew::sim {

Rounding roundingOf(const Scene& scene) {
    float farthest = 0;
    std::uint32_t particle = 0;
    for (std::uint32_t i = 0; i < scene.particles.size(); ++i) {
        const auto& [x, y, z] = scene.particles[i].position;
        const float distance = std::max({std::abs(x), std::abs(y), std::abs(z)});
        if (!(scene.particles[i].inverseMass > 0) || !(distance > farthest)) continue;
        farthest = distance;
        particle = i;
    }
    return {double{farthest}, double{std::nextafter(farthest, INFINITY) - farthest}, particle};
}

bool keepsRemainders(const Scene& scene, std::uint32_t substeps) {
    constexpr double least = 1e-5, leastNear = 1e-4, most = 1e-3; // [m/s]
    constexpr double time = 1e-4;                                 // [s]
    constexpr double far = 8;                                     // [m]
    const Rounding rounding = roundingOf(scene);
    const double lost = 0.5 * rounding.step * substeps / double{scene.dt};
    const double gravity = std::hypot(scene.gravity.x, scene.gravity.y, scene.gravity.z);
    return lost > (rounding.distance >= far ? least : std::clamp(time * gravity, leastNear, most));
}

} // namespace sinew::sim
