// Whether parts of a scene may touch, in contacts that only `split` has a form for.
#pragma once

#include "sinew/scene.hpp"

namespace sinew::sim::collision {

/// Whether two particles with a radius may touch each other, at least one of which moves.
bool particlesTouch(const Scene& scene);

/// Whether particles with a radius may touch faces, with a particle or a face that moves.
bool facesTouch(const Scene& scene);

} // namespace sinew::sim::collision
