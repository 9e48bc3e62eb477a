// Where colliders are in the steps of a simulation, on the host: what the device reads for a step.
#pragma once

#include "layout.h"
#include "sim/colliders.hpp"

#include <span>

namespace sinew::sim::collision {

/// The time of a simulation, and its colliders at the ends of its newest step.
class ColliderPaths {
public:
    explicit ColliderPaths(const std::vector<Collider>& colliders);

    double time() const noexcept { return time_; } ///< [s]
    /// Where they are at that time, one a collider.
    std::span<const Pose> poses() const noexcept { return poses_; }
    /// From and to of every collider; empty where none moves.
    std::span<const layout::ColliderPose> ways() const noexcept { return ways_; }

    void moveTo(double time) noexcept; ///< at once, as when a simulation begins
    void advance(float dt) noexcept;   ///< by a step [s]

private:
    std::vector<Collider> colliders_;
    std::vector<Pose> poses_;
    std::vector<layout::ColliderPose> ways_;
    double time_ = 0;
};

} // namespace sinew::sim::collision
