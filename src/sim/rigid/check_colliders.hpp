// The part of validate() for colliders.
#pragma once

#include "sim/core/complaints.hpp"

#include <cmath>
#include <span>

namespace sinew::sim::rigid {

/// Whether two poses are equal; q and -q are one rotation.
inline bool isSame(const Pose& a, const Pose& b) {
    const auto differ = [](float x, float y) {
        return std::abs(double{x} - double{y}) > 1e-5 * (1 + std::abs(double{x}));
    };
    const Quaternion &p = a.rotation, &q = b.rotation;
    const double cosine = double{p.x} * double{q.x} + double{p.y} * double{q.y} + double{p.z} * double{q.z} +
                          double{p.w} * double{q.w};
    return !differ(a.position.x, b.position.x) && !differ(a.position.y, b.position.y) &&
           !differ(a.position.z, b.position.z) && std::abs(cosine) > 1 - 1e-6;
}

void checkColliders(std::span<const Collider> colliders, Complaints& complaints);
/// `isHeld` by particle: whether it never moves.
void checkDriven(const Scene& scene, const std::vector<bool>& isHeld, Complaints& complaints);

} // namespace sinew::sim::rigid
