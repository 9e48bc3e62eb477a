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

namespace sinew::sim {

struct Pace {
    float h = 0;       ///< of the last step [s]; 0 before the first one
    float longest = 0; ///< H of that step [s]

    /// H of the next step, of length `dt`, in substeps of `of` [s].
    float longestOf(float dt, float of) const {
        constexpr float memory = 2; // [s]; with 1 s, one long step in 300 feeds a beam
        return std::max({of, h, longest * std::exp(-dt / memory)});
    }
};

} // namespace sinew::sim
