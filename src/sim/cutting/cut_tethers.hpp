// Tethers end where a cut has parted a particle from its anchor, as the step ends that has cut: with the
// pieces that are found then. One around a slit, which still hangs together, holds as it did.
#pragma once

#include "layout.h"
#include "sim/compile.hpp"

#include <span>

namespace sinew::sim::cutting {

/// A tether of a list on the device.
struct ListedTether {
    std::uint32_t particle = 0, anchor = 0; ///< slots
    float reach = 0;                        ///< [m]
};

/// `list` has layout::TetherReach of each of `tethers`. Nothing where no body that may be cut has both ends
/// of one.
void addTetherFilter(ProgramBuilder& program, BufferId list, std::span<const ListedTether> tethers);

} // namespace sinew::sim::cutting
