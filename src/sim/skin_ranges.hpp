// Where the skins of a scene are in its index buffers.
#pragma once

#include "sim/program.hpp"
#include "sim/simulation.hpp"

namespace sinew::sim {

enum class Triangles { all, whole };

/// One behind the other, of all triangles or of those that are drawn while nothing is cut.
std::vector<SkinRange> rangesOf(const std::vector<Skin>& skins, Triangles which);

/// Where `ranges` says, one a skin; none where there are none.
std::vector<SkinRange> rangesOf(const std::vector<Skin>& skins,
                                const std::vector<StepProgram::IndexRange>& ranges);

} // namespace sinew::sim
