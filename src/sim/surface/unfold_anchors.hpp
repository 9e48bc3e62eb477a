// Moves particles that were pulled below a skin (pullAnchors) so that less of the complex is turned over.
#pragma once

#include "sim/surface/skin_complex.hpp"

namespace sinew::sim::surface {

/// By slot, where a particle is for a blade [m].
using Pulled = std::vector<std::pair<std::uint32_t, Vec3>>;

/// Each stays below the parts of the skin that go with it.
void unfoldAnchors(const Scene& scene, const Grid& grid, const lattice::Box& box, const SkinComplex& complex,
                   Pulled& pulled);

} // namespace sinew::sim::surface
