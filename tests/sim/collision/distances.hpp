// Distances of a point by their definition.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

namespace sinew::test {

using Eigen::Vector3d;

inline double toSegment(const Vector3d& p, const Vector3d& a, const Vector3d& b) {
    const Vector3d ab = b - a;
    const double length = ab.squaredNorm();
    const double t = length > 0 ? std::clamp((p - a).dot(ab) / length, 0.0, 1.0) : 0;
    return (p - a - t * ab).norm();
}

inline double toTriangle(const Vector3d& p, const std::array<Vector3d, 3>& x) {
    const Vector3d n = (x[1] - x[0]).cross(x[2] - x[0]);
    const double nn = n.squaredNorm();
    if (nn > 0) {
        bool isInside = true;
        for (int k = 0; k < 3; ++k)
            isInside = isInside && (x[(k + 1) % 3] - x[k]).cross(p - x[k]).dot(n) >= 0;
        if (isInside) return std::abs((p - x[0]).dot(n)) / std::sqrt(nn);
    }
    return std::min({toSegment(p, x[0], x[1]), toSegment(p, x[1], x[2]), toSegment(p, x[2], x[0])});
}

} // namespace sinew::test
