// Where pokes are in the steps of a simulation, on the host: what the device reads of them. There they are
// colliders, the first ones, that come and go.
#pragma once

#include "layout.h"
#include "sim/ranges.hpp"
#include "sim/simulation.hpp"

#include <array>
#include <span>

namespace sinew::sim::collision {

/// Of each slot; those beyond Settings::pokes are never there.
using PokeStates = std::array<PokeState, ranges::mostPokes>;

class Pokes {
public:
    explicit Pokes(std::uint32_t count) : count_(count) {}

    /// At once, as when a simulation begins.
    void moveTo(const PokeStates& states) noexcept;
    /// A step of `dt` [s].
    void advance(std::span<const Poke> pokes, float dt) noexcept;

    std::uint32_t count() const noexcept { return count_; }
    const PokeStates& states() const noexcept { return states_; }
    bool areAny() const noexcept; ///< there
    std::span<const layout::Collider> shapes() const noexcept { return std::span(shapes_).first(count_); }
    /// From and to of each.
    std::span<const layout::ColliderPose> ways() const noexcept { return std::span(ways_).first(2 * count_); }

private:
    void place(std::size_t slot, const Pose& from, double reach) noexcept;

    std::uint32_t count_;
    PokeStates states_{};
    std::array<layout::Collider, ranges::mostPokes> shapes_{};
    std::array<layout::ColliderPose, 2 * ranges::mostPokes> ways_{};
};

} // namespace sinew::sim::collision
