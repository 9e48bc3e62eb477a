// Ranges of the scene's skins in its index buffers.
#pragma once

#include "sim/program.hpp"
#include "sim/simulation.hpp"

namespace sinew::sim {

enum class Triangles { all, whole };

/// Consecutive ranges, of all triangles or of those that are drawn while nothing is cut.
std::vector<SkinRange> rangesOf(const std::vector<Skin>& skins, Triangles which);

/// The given ranges with the names and colors of the skins, one a skin; empty if `ranges` is.
std::vector<SkinRange> rangesOf(const std::vector<Skin>& skins,
                                const std::vector<StepProgram::IndexRange>& ranges);

} // namespace sinew::sim
