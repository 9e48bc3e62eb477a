// What pairs of particles are like to touch (sim::Surface), as kernels take it: three numbers where all
// particles that touch have one surface, else a table of pairs and an index per particle.
#pragma once

#include "layout.h"
#include "sim/compile.hpp"

namespace sinew::sim::collision::surfaces {

struct Surfaces {
    float friction = 0, staticFriction = 0, restitution = 0; ///< where there is one
    std::uint32_t count = 0; ///< where there are several; else 0, and no buffer exists
    BufferId ofParticles, pairs;
    bool hasFriction = false, hasRestitution = false; ///< of any pair
};

Surfaces add(ProgramBuilder& program, const Scene& scene, const StateLayout& layout);

/// With a table in any case, for contacts with faces: a face has the surface of its first corner. Buffers are
/// called `name`s and `name`_pairs.
Surfaces addTable(ProgramBuilder& program, const Scene& scene, const StateLayout& layout, const char* name);

} // namespace sinew::sim::collision::surfaces
