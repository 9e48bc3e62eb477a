// The choice of Settings::levels by "auto". All of the rule stands here.
//
// A body lacks the factor r in substeps: r times as many would give its links their whole stiffness. Levels
// win at equal error from r = 1.8 on, where they cost less than the substeps that they replace. The best
// number grows by one for each factor of about 2.2: a level bears substeps of twice the length. A solid needs
// one more than a sheet, because at the same r its error is larger. docs/levels.md, "The choice by auto", has
// the measurements.
//
// r is that of the sum, with which levels run. A scene with the sharp clamp has it only without levels, and
// needs 0.59 times the substeps of the sum for the same error in a solid, 0.72 times in a sheet, each of
// which takes 1.07 times as long (docs/clamp.md): 0.63 and 0.77 times the time.
// Levels must therefore be 1.6 and 1.3 times faster than the sum. In a solid they are from r = 3.2 on, in a
// sheet wherever they win at all.
#pragma once

#include "sim/stiffness/terms.hpp"

#include <string>
#include <vector>

namespace sinew::sim::stiffness {

/// The largest part of 4 / (1 + 2 theta) that omega may be with levels.
inline constexpr double mostOmegaOfLevels = 0.9;

/// With substeps = 0 as well, "auto" counts on so many levels, which take a third of the substeps.
inline constexpr std::uint32_t levelsOfFewSubsteps = 2;

/// Why `split` cannot have levels in a scene, a sentence each.
std::vector<std::string> obstaclesToLevels(const Scene& scene, const Settings& settings);

/// The number of levels for settings.substeps, which must be resolved: that which the bodies with the most
/// particles are best with; 0 where levels do not win or cannot be. settings.levels must not be 0.
std::uint32_t levelsFor(const Scene& scene, const Settings& settings, const Load& load);

} // namespace sinew::sim::stiffness
