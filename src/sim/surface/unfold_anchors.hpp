// Moves particles that were pulled below a skin (pullAnchors) so that less volume of the complex is inverted.
#pragma once

#include "sim/surface/skin_complex.hpp"

namespace sinew::sim::surface {

/// By slot, the position of a particle for a blade [m].
using Pulled = std::vector<std::pair<std::uint32_t, Vec3>>;

/// Each particle stays below the parts of the skin that follow it.
void unfoldAnchors(const Scene& scene, const Grid& grid, const lattice::Box& box, const SkinComplex& complex,
                   Pulled& pulled);

} // namespace sinew::sim::surface
