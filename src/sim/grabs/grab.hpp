// Grabs on the device: temporary constraints that the host requests in each step. A step in which a grab
// begins or ends determines the held particles (open_grabs, select_grabbed, the second with no groups
// otherwise). A pass after the links of a substep pulls the held particles (solve_grabs, with groups for
// these alone), the same for every solver. A program without grabs (Settings::grabs) has none of these
// passes.
#pragma once

#include "common/layout.h"
#include "sim/model/feature.hpp"
#include "sinew/step.hpp"

#include <array>

namespace sinew::sim::grabs {

struct Grabs {
    layout::GrabPush push{};
    BufferId requests, states, bodies, grips, held, holding, pulling;
};

/// Sets build.particles.grabs: adds the buffers. Nothing without Settings::grabs; the functions below then
/// add nothing either.
void add(Build& build);
/// Appends the passes that determine the held particles, after bodies have come and gone (motions/pool.hpp).
void addChoice(Build& build);
/// Appends the pull at the end of a substep.
void addPass(Build& build, const Substep& substep);

/// The grabs on the host: contents of the grabs buffer of a step.
class GrabRequests {
public:
    /// For at most `count` grabs in a scene of `particles` particles.
    GrabRequests(std::uint32_t count, std::size_t particles) : count_(count), particles_(particles) {}

    /// Restores earlier grabs. A grab that begins later still has a serial number of its own.
    void restore(const GrabRequests& before) noexcept { requests_ = before.requests_; }
    /// Continues the grabs of `other`; `origins` by particle: its index there, or NO_ELEMENT. Grabs of
    /// particles that are gone end.
    void carry(const GrabRequests& other, std::span<const std::uint32_t> origins) noexcept;
    /// Ends all grabs.
    void reset() noexcept { requests_ = {}; }
    /// Advances by a step of `dt` [s].
    void advance(std::span<const Grab> grabs, float dt) noexcept;
    bool areFree() const noexcept; ///< no grab holds anything
    std::span<const layout::GrabRequest> values() const noexcept {
        return std::span(requests_).first(count_);
    }

private:
    std::uint32_t count_;
    std::size_t particles_;
    std::uint32_t serial_ = 0; // of the newest grab
    std::array<layout::GrabRequest, MOST_GRABS> requests_{};
};

} // namespace sinew::sim::grabs
