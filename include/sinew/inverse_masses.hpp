// Inverse masses of the particles of a scene.
#pragma once

#include "sinew/export.hpp"
#include "sinew/scene.hpp"

#include <vector>

namespace sinew::sim {

/// Inverse mass of every particle after fixed constraints [1/kg]; 0 = never moves.
SINEW_API std::vector<float> inverseMasses(const Scene& scene);

} // namespace sinew::sim
