// Distances to colliders in double, computed by formulas that differ from the kernel's.
#pragma once

#include "sinew/scene.hpp"

#include <Eigen/Geometry>
#include <algorithm>

namespace sinew::test {

inline Eigen::Quaterniond toRotation(const sim::Quaternion& q) {
    return Eigen::Quaterniond(double{q.w}, double{q.x}, double{q.y}, double{q.z}).normalized();
}
inline sim::Quaternion turnedBy(double degrees, const Eigen::Vector3d& axis) {
    const Eigen::Quaterniond q(Eigen::AngleAxisd(degrees * 3.14159265358979323846 / 180, axis.normalized()));
    return {static_cast<float>(q.x()), static_cast<float>(q.y()), static_cast<float>(q.z()),
            static_cast<float>(q.w())};
}

/// Distance from the collider's surface; negative inside [m].
inline double gapOf(const sim::Collider& collider, const sim::Pose& pose, const Eigen::Vector3d& x) {
    const Eigen::Vector3d middle(double{pose.position.x}, double{pose.position.y}, double{pose.position.z});
    const Eigen::Vector3d s = toRotation(pose.rotation).conjugate() * (x - middle);
    switch (collider.shape) {
    case sim::ColliderShape::sphere:
        return s.norm() - double{collider.radius};
    case sim::ColliderShape::capsule: {
        const double end = double{collider.halfLength};
        return (s - Eigen::Vector3d(0, std::clamp(s.y(), -end, end), 0)).norm() - double{collider.radius};
    }
    case sim::ColliderShape::box: {
        const sim::Vec3& e = collider.halfExtents;
        const Eigen::Vector3d out = s.cwiseAbs() - Eigen::Vector3d(double{e.x}, double{e.y}, double{e.z});
        return out.cwiseMax(0).norm() + std::min(out.maxCoeff(), 0.0);
    }
    }
    return 0;
}

} // namespace sinew::test
