// Tethers (long-range attachments) on the device: one pass after the links of a substep, the same for every
// solver.
#pragma once

#include "common/layout.h"
#include "sim/model/feature.hpp"

namespace sinew::sim::constraints::tether {

struct Tethers {
    std::uint32_t count = 0; ///< tethered particles that move
    BufferId particles, tethers;
    BufferId cut;               ///< layout::CutTether of those that a cut may remove
    std::uint32_t cutCount = 0; ///< their number
};

/// Keeps Tethers.
void add(Build& build);
/// Appends the pass of a substep.
void addPass(Build& build, const Substep& substep);
/// Appends the removal of tethers whose particle a cut has separated from the anchor, from the new pieces. A
/// tether around a slit, through which both still hang together, stays.
void addCutPass(Build& build);

} // namespace sinew::sim::constraints::tether
