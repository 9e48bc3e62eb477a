// Removal of tethers whose particle a cut has separated from the anchor, at the end of the step that cut,
// from the new pieces. A tether around a slit, through which both still hang together, stays.
#pragma once

#include "common/layout.h"
#include "sim/program/program.hpp"

#include <span>

namespace sinew::sim::constraints {

/// A tether of a list on the device.
struct ListedTether {
    std::uint32_t particle = 0, anchor = 0; ///< slots
    float reach = 0;                        ///< [m]
};

/// Appends the removal; `list` has a layout::TetherReach for each of `tethers`. Nothing if no cuttable body
/// contains both ends of one.
void addTetherFilter(ProgramBuilder& program, BufferId list, std::span<const ListedTether> tethers);

} // namespace sinew::sim::constraints
