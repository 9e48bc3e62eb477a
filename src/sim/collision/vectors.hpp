// Vectors in double, for computations on the host about a scene at rest.
#pragma once

#include "sinew/scene.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace sinew::sim::collision {

using Vector = std::array<double, 3>;

inline Vector minus(const Vector& a, const Vector& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
inline double dot(const Vector& a, const Vector& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline Vector cross(const Vector& a, const Vector& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline Vector toVector(const Vec3& v) {
    return {double{v.x}, double{v.y}, double{v.z}};
}

/// Gravity [m/s^2] and its unit direction; `down` is 0 without gravity.
struct Pull {
    double gravity = 0;
    Vector down{};
};
inline Pull pullOf(const Scene& scene) {
    const Vector g = toVector(scene.gravity);
    const double size = std::sqrt(dot(g, g));
    if (size == 0) return {};
    return {size, {g[0] / size, g[1] / size, g[2] / size}};
}

/// The length of the component of `v` perpendicular to the unit vector `down`.
inline double acrossLength(const Vector& v, const Vector& down) {
    const double depth = dot(v, down);
    return std::sqrt(std::max(0.0, dot(v, v) - depth * depth));
}

/// The unit vector `down` and two unit vectors perpendicular to it.
inline std::array<Vector, 3> frameOf(const Vector& down) {
    const std::size_t least = static_cast<std::size_t>(
        std::ranges::min_element(down, {}, [](double v) { return std::abs(v); }) - down.begin());
    Vector across{};
    across[least] = 1;
    for (std::size_t k = 0; k < 3; ++k) across[k] -= down[least] * down[k];
    const double length = std::sqrt(dot(across, across));
    for (double& v : across) v /= length;
    return {down, across, cross(down, across)};
}

inline double squaredToSegment(const Vector& p, const Vector& a, const Vector& b) {
    const Vector ab = minus(b, a), ap = minus(p, a);
    const double length = dot(ab, ab), t = length > 0 ? std::clamp(dot(ap, ab) / length, 0.0, 1.0) : 0;
    const Vector d{ap[0] - t * ab[0], ap[1] - t * ab[1], ap[2] - t * ab[2]};
    return dot(d, d);
}

} // namespace sinew::sim::collision
