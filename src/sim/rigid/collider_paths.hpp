// Poses of host colliders, colliders and driven bodies in the steps of a simulation, on the host, in the form
// that the device reads.
#pragma once

#include "common/layout.h"
#include "sim/rigid/host_colliders.hpp"
#include "sinew/colliders.hpp"

#include <span>

namespace sinew::sim::rigid {

layout::ColliderPose onDevice(const Pose& pose, float sign) noexcept;
layout::Collider shapeOf(const Collider& collider) noexcept;

/// The time of a simulation, and the poses of its host colliders, colliders and driven bodies at the end of
/// its newest step, in that order.
class ColliderPaths {
public:
    explicit ColliderPaths(std::vector<Collider> colliders, std::vector<DrivenBody> driven = {},
                           std::uint32_t hostColliders = 0);

    double time() const noexcept { return time_; } ///< [s]
    /// Poses of the colliders at that time.
    std::span<const Pose> poses() const noexcept { return std::span(poses_).first(colliders_.size()); }
    /// Poses of the colliders, then of the driven bodies.
    std::span<const Pose> allPoses() const noexcept { return poses_; }
    const HostColliders& hostColliders() const noexcept { return hostColliders_; }
    /// Start and end poses of all, host colliders first; empty if none moves.
    std::span<const layout::ColliderPose> ways() const noexcept { return ways_; }

    /// Sets the time and poses without motion, such as at the start of a simulation.
    void moveTo(double time, std::span<const HostColliderState> hostColliders = {}) noexcept;
    void advance(float dt, std::span<const HostCollider> hostColliders = {}) noexcept; ///< by a step [s]

private:
    void place() noexcept;

    std::vector<Collider> colliders_;
    std::vector<DrivenBody> driven_;
    HostColliders hostColliders_;
    std::vector<Pose> poses_; // of colliders, of driven bodies
    std::vector<layout::ColliderPose> ways_;
    double time_ = 0;
};

} // namespace sinew::sim::rigid
