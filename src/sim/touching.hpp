// Parts of a scene that may touch: contacts that only `split` has a form for.
#pragma once

#include "sim/scene.hpp"

namespace sinew::sim {

/// Whether two particles with a radius may touch each other, of which one moves.
bool particlesTouch(const Scene& scene);

/// Whether particles with a radius may touch faces, of which one moves.
bool facesTouch(const Scene& scene);

} // namespace sinew::sim
