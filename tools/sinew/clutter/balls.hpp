// The input of the CPU programs in `sinew bench --scene clutter`: balls of one size, and planes, in float.
// All files of this folder except Bullet's are compiled for the building machine.
#pragma once

#include "sinew/scene.hpp"

namespace sinew::tools::clutter {

using Vec4 = std::array<float, 4>;

struct Balls {
    std::vector<Vec4> x, v; ///< [m], [m/s]; w = inverse mass [1/kg]
    float radius = 0;       ///< of each ball [m]
    float friction = 0;     ///< between balls
    std::vector<sim::Plane> planes;
    sim::Vec3 gravity;                          ///< [m/s^2]
    float dt = 0;                               ///< length of a step [s]
    std::uint32_t substeps = 1, iterations = 1; ///< per step; per substep
    float h() const { return dt / static_cast<float>(substeps); }
};

/// Throws std::invalid_argument unless the scene consists of loose particles of one radius and planes.
Balls ballsOf(const sim::Scene& scene, std::uint32_t substeps, std::uint32_t iterations);

/// Moves `x` out of all planes; `before` is its position when the substep began. Friction undoes the
/// tangential motion of the substep, up to the coefficient times the depth.
inline void projectPlanes(const Balls& balls, Vec4& x, const Vec4& before) {
    for (const sim::Plane& plane : balls.planes) {
        const sim::Vec3& n = plane.normal;
        const float depth = plane.offset + balls.radius - (n.x * x[0] + n.y * x[1] + n.z * x[2]);
        if (depth <= 0) continue;
        Vec4 slid{x[0] - before[0], x[1] - before[1], x[2] - before[2], 0};
        const float along = n.x * slid[0] + n.y * slid[1] + n.z * slid[2];
        slid = {slid[0] - along * n.x, slid[1] - along * n.y, slid[2] - along * n.z, 0};
        const float square = slid[0] * slid[0] + slid[1] * slid[1] + slid[2] * slid[2];
        const float reach = plane.friction * depth;
        const float back = square <= reach * reach ? 1 : reach / __builtin_sqrtf(square);
        x[0] += depth * n.x - back * slid[0];
        x[1] += depth * n.y - back * slid[1];
        x[2] += depth * n.z - back * slid[2];
    }
}

} // namespace sinew::tools::clutter
