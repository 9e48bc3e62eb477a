// Contact properties of pairs of particles (sim::Surface), as kernels read them: three numbers if all
// touching particles have one surface, else a table of pairs and an index per particle.
#pragma once

#include "common/layout.h"
#include "sim/model/state.hpp"

namespace sinew::sim::collision::surfaces {

struct Surfaces {
    float friction = 0, staticFriction = 0, restitution = 0; ///< if there is only one surface
    std::uint32_t count = 0; ///< number of surfaces if there are several; else 0, and no buffer exists
    BufferId ofParticles, pairs;
    bool hasFriction = false, hasRestitution = false; ///< of any pair
};

Surfaces add(ProgramBuilder& program, const Scene& scene, const StateLayout& layout);

/// Always makes a table, for contacts with faces: a face has the surface of its first corner. The buffers
/// have the labels `name`s and `name`_pairs.
Surfaces addTable(ProgramBuilder& program, const Scene& scene, const StateLayout& layout, const char* name);

} // namespace sinew::sim::collision::surfaces
