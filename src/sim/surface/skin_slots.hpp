// What of a skin stands on each slot, so that kernels find what is near a blade by the few slots and not by
// the many prisms and vertices.
#pragma once

#include "sim/surface/cut_bodies.hpp"
#include "sim/surface/skin_complex.hpp"

namespace sinew::sim::surface {

/// Adds the slots of a body to `bodies` and says in `range` which they are. Of `complex` prisms count from
/// range.prisms.first on, vertices from range.vertices.first on.
void addSkinSlots(CutBodies& bodies, const SkinComplex& complex, HungRange& range);

} // namespace sinew::sim::surface
