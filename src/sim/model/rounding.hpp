// Coarseness of float32 positions in a scene, and whether it affects motion.
#pragma once

#include "sinew/scene.hpp"

#include <cstdint>

namespace sinew::sim {

/// Spacing of float32 numbers at the moving particle with the largest coordinate along any axis.
struct Rounding {
    double distance = 0; ///< largest coordinate of that particle [m]
    double step = 0;     ///< [m]
    std::uint32_t particle = 0;
};
Rounding roundingOf(const Scene& scene);

/// Whether positions store rounding remainders. A substep may lose half of `step`, which is an error in
/// speed. Remainders are kept if this speed exceeds 1e-5 m/s; within 8 m of the origin only if it exceeds
/// both 1e-4 m/s and the speed that gravity adds in 1e-4 s, which is 1 mm/s on Earth, and is capped at 1
/// mm/s. Positions, gravity and the length of a step are those of the scene, not of later steps.
bool keepsRemainders(const Scene& scene, std::uint32_t substeps);

} // namespace sinew::sim
