// Where colliders and driven bodies are in the steps of a simulation, on the host: what the device reads for
// a step.
#pragma once

#include "layout.h"
#include "sim/colliders.hpp"

#include <span>

namespace sinew::sim::collision {

/// The time of a simulation, and at the ends of its newest step its colliders and, after them, driven bodies.
class ColliderPaths {
public:
    explicit ColliderPaths(std::vector<Collider> colliders, std::vector<DrivenBody> driven = {});

    double time() const noexcept { return time_; } ///< [s]
    /// Where the colliders are at that time.
    std::span<const Pose> poses() const noexcept { return std::span(poses_).first(colliders_.size()); }
    /// Likewise, and the driven bodies.
    std::span<const Pose> allPoses() const noexcept { return poses_; }
    /// From and to of all; empty where none moves.
    std::span<const layout::ColliderPose> ways() const noexcept { return ways_; }

    void moveTo(double time) noexcept; ///< at once, as when a simulation begins
    void advance(float dt) noexcept;   ///< by a step [s]

private:
    void place() noexcept;

    std::vector<Collider> colliders_;
    std::vector<DrivenBody> driven_;
    std::vector<Pose> poses_;
    std::vector<layout::ColliderPose> ways_;
    double time_ = 0;
};

} // namespace sinew::sim::collision
