// Poses of host colliders in the steps of a simulation, on the host, in the form that the device reads. On
// the device host colliders are the first colliders, and may appear and disappear.
#pragma once

#include "common/layout.h"
#include "sinew/ranges.hpp"
#include "sinew/step.hpp"

#include <array>
#include <span>

namespace sinew::sim::rigid {

/// By slot; slots beyond Settings::hostColliders are always absent.
using HostColliderStates = std::array<HostColliderState, ranges::mostHostColliders>;

class HostColliders {
public:
    explicit HostColliders(std::uint32_t count) : count_(count) {}

    /// Sets the states without motion, such as at the start of a simulation.
    void moveTo(const HostColliderStates& states) noexcept;
    /// Advances by a step of `dt` [s].
    void advance(std::span<const HostCollider> hostColliders, float dt) noexcept;

    std::uint32_t count() const noexcept { return count_; }
    const HostColliderStates& states() const noexcept { return states_; }
    bool areAny() const noexcept; ///< whether one is present
    std::span<const layout::Collider> shapes() const noexcept { return std::span(shapes_).first(count_); }
    /// Start and end poses of each.
    std::span<const layout::ColliderPose> ways() const noexcept { return std::span(ways_).first(2 * count_); }

private:
    void place(std::size_t slot, const Pose& from, double reach) noexcept;

    std::uint32_t count_;
    HostColliderStates states_{};
    std::array<layout::Collider, ranges::mostHostColliders> shapes_{};
    std::array<layout::ColliderPose, 2 * ranges::mostHostColliders> ways_{};
};

} // namespace sinew::sim::rigid
