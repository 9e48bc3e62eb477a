// Index from slots to the elements of a skin, so that kernels find those near a blade by testing few slots
// instead of many prisms and vertices.
#pragma once

#include "sim/surface/cut_bodies.hpp"
#include "sim/surface/skin_complex.hpp"

namespace sinew::sim::surface {

/// Adds the slots of a body to `bodies` and stores their range in `range`. Prisms of `complex` are numbered
/// from range.prisms.first on, vertices from range.vertices.first on.
void addSkinSlots(CutBodies& bodies, const SkinComplex& complex, HungRange& range);

} // namespace sinew::sim::surface
