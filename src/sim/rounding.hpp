// How coarse float32 positions are in a scene, and whether that shows in its motion.
#pragma once

#include "sim/scene.hpp"

#include <cstdint>

namespace sinew::sim {

/// The distance between float32 numbers at the moving particle that is farthest from the origin along an
/// axis.
struct Rounding {
    double distance = 0; ///< of that particle [m]
    double step = 0;     ///< [m]
    std::uint32_t particle = 0;
};
Rounding roundingOf(const Scene& scene);

/// Whether positions keep what rounding takes from them. A substep may lose half of `step`, which is a speed.
/// They do where that speed is more than 1e-5 m/s, or within 8 m of the origin more than 1e-4 m/s and than
/// gravity gives in 1e-4 s, which is 1 mm/s on Earth and never more than that. Positions, gravity and the
/// length of a step are those of the scene, not those of later steps.
bool keepsRemainders(const Scene& scene, std::uint32_t substeps);

} // namespace sinew::sim
