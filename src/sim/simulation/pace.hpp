// The substep lengths that a step leaves to the next one.
//
// `split` clamps a link to the stiffness k' = K / H^2 that a substep of length H can bear. If H followed h at
// once, a host whose steps change in length would change the stiffness of stretched links: a long step
// stretches soft ones, a short one pulls with stiff ones, and the energy grows without bound. So H is the
// longest h of late, which is forgotten slowly: stiffness falls at once, for stability, and returns within
// seconds. With steps of one length H is h. Links that a substep can bear have k' = k, whatever H is.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace sinew::sim {

struct Pace {
    float h = 0;       ///< of the last step [s]; 0 before the first one
    float longest = 0; ///< the longest of late [s]

    /// H of the next step, of length `dt`, in substeps of `of` [s]: its first kick spans half of the last
    /// one.
    float longestOf(float dt, float of) const { return std::max(h, next(dt, of).longest); }

    /// After that step.
    Pace next(float dt, float of) const {
        constexpr float memory = 2; // [s]; with 1 s, one long step in 300 feeds a beam
        return {of, std::max(of, longest * std::exp(-dt / memory))};
    }

    /// For a program that takes over and has other substeps: its links were not stretched by a stiffness that
    /// these could not bear.
    Pace inSubsteps(std::uint32_t from, std::uint32_t to) const {
        return {h, longest * (static_cast<float>(from) / static_cast<float>(to))};
    }
};

} // namespace sinew::sim
