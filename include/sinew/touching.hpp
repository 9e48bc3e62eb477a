// Whether parts of a scene may touch, in contacts that only `split` has a form for.
#pragma once

#include "sinew/export.hpp"
#include "sinew/scene.hpp"

namespace sinew::sim {

/// Whether two particles with a radius may touch each other, at least one of which moves.
SINEW_API bool particlesTouch(const Scene& scene);
/// Whether particles with a radius may touch faces, with a particle or a face that moves.
SINEW_API bool facesTouch(const Scene& scene);

} // namespace sinew::sim
