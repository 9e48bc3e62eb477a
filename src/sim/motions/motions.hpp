// Motions of the host: velocities, impulses and poses of bodies and regions, once at the start of a step. A
// step without a motion runs none of these passes.
//
//   move   measure_motions, resolve_motions, place_bodies      poses
//          measure_motions, resolve_motions, apply_motions     velocities, impulses
//   open   stray_placed, forget_contacts                       contacts of placed bodies, list by list
//   end    place_previous                                      Settings::keepsPrevious
#pragma once

#include "sim/model/feature.hpp"
#include "sinew/step.hpp"

#include <array>
#include <span>

namespace sinew::sim::motions {

/// Adds the buffers, and the passes that move particles. Nothing unless Settings::motions; the functions
/// below then add nothing either.
void add(Build& build);
/// Appends the passes that let bodies into the world and out of it, before grabs look for particles
/// (pool.hpp).
void addComing(Build& build);
/// Appends the passes over contact lists, after these were added.
void addForgetting(Build& build);
/// Appends the pass over previous positions.
void addPrevious(Build& build);

/// The reason why a motion has no effect.
enum class Fault : std::uint8_t {
    none,
    noRoom,
    kind,
    number,
    body,
    radius,
    notWhole,
    rotation,
    isHeld,
    isAlwaysThere
};

Fault faultOf(const Motion& motion, const MotionGroups& scene) noexcept;
/// As a part of a sentence; null for `none`.
const char* textOf(Fault fault) noexcept;

/// The motions of the newest step.
class MotionRequests {
public:
    /// For at most `count` motions. Refers to `groups`.
    MotionRequests(std::uint32_t count, const MotionGroups& groups) : count_(count), groups_(&groups) {}

    /// Advances by a step. Returns the index of the first motion that has no effect, or the number of
    /// motions.
    std::size_t advance(std::span<const Motion> motions) noexcept;
    std::span<const layout::MotionRequest> values() const noexcept {
        return std::span(requests_).first(count_);
    }
    /// Dispatch arguments of the passes: 0 groups if no motion needs them.
    std::span<const layout::DispatchArguments> arguments() const noexcept {
        return std::span(arguments_).first(count_ > 0 ? MOTION_ARGUMENTS : 0);
    }
    /// Whether a body that may be cut comes or goes: its cuts are undone, by the passes of a cut.
    bool undoCuts() const noexcept { return undoCuts_; }

private:
    std::uint32_t count_;
    const MotionGroups* groups_;
    std::array<layout::MotionRequest, MOST_MOTIONS> requests_{};
    std::array<layout::DispatchArguments, MOTION_ARGUMENTS> arguments_{};
    bool undoCuts_ = false;
};

} // namespace sinew::sim::motions
