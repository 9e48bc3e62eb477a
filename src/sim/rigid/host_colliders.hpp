// Poses of host colliders in the steps of a simulation, on the host, in the form that the device reads. On
// the device host colliders are the first colliders, and may appear and disappear.
#pragma once

#include "common/layout.h"
#include "sinew/step.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace sinew::sim::rigid {

/// By slot, Settings::hostColliders of them.
using HostColliderStates = std::vector<HostColliderState>;

class HostColliders {
public:
    explicit HostColliders(std::uint32_t count)
        : states_(count), shapes_(count), ways_(2 * std::size_t{count}) {}

    /// Sets the states without motion, such as at the start of a simulation; slots without a state are
    /// absent.
    void moveTo(std::span<const HostColliderState> states) noexcept;
    /// Advances by a step of `dt` [s].
    void advance(std::span<const HostCollider> hostColliders, float dt) noexcept;

    const HostColliderStates& states() const noexcept { return states_; }
    bool areAny() const noexcept; ///< whether one is present
    std::span<const layout::Collider> shapes() const noexcept { return shapes_; }
    /// Start and end poses of each.
    std::span<const layout::ColliderPose> ways() const noexcept { return ways_; }

private:
    void place(std::size_t slot, const Pose& from, double reach) noexcept;

    HostColliderStates states_;
    std::vector<layout::Collider> shapes_;
    std::vector<layout::ColliderPose> ways_;
};

} // namespace sinew::sim::rigid
