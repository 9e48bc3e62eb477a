// Ranges of the scene's skins in its index buffers.
#pragma once

#include "sinew/simulation.hpp"

namespace sinew::sim {

enum class Triangles { all, whole };

/// Consecutive ranges, of all triangles or of those that are drawn while nothing is cut.
std::vector<SkinRange> rangesOf(const std::vector<Skin>& skins, Triangles which);

} // namespace sinew::sim
