#include "sim/rounding.hpp"

#include <algorithm>
#include <cmath>

namespace sinew::sim {

Rounding roundingOf(const Scene& scene) {
    float farthest = 0;
    for (const Particle& particle : scene.particles)
        if (particle.inverseMass > 0)
            for (const float value : {particle.position.x, particle.position.y, particle.position.z})
                farthest = std::max(farthest, std::abs(value));
    return {double{farthest}, double{std::nextafter(farthest, INFINITY) - farthest}};
}

bool keepsRemainders(const Scene& scene, std::uint32_t substeps) {
    constexpr double least = 1e-5, most = 1e-3; // [m/s]
    constexpr double time = 1e-4;               // [s]
    constexpr double far = 8;                   // [m]
    const Rounding rounding = roundingOf(scene);
    const double lost = 0.5 * rounding.step * substeps / double{scene.dt};
    const double gravity = std::hypot(scene.gravity.x, scene.gravity.y, scene.gravity.z);
    return lost > (rounding.distance >= far ? least : std::clamp(time * gravity, least, most));
}

} // namespace sinew::sim
