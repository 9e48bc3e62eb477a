// What the solver makes of the stiffness a scene asks for.
#pragma once

#include "sim/scene.hpp"

namespace sinew::scenes {

/// `split` limits stiffness that a substep could not bear (methods: D). Rigid links (compliance 0) are left
/// out: they are always as stiff as the substep allows.
struct StiffnessReport {
    std::size_t elasticLinks = 0;     ///< links with a compliance
    std::size_t clampedLinks = 0;     ///< those softer than asked for
    double softest = 1;               ///< the smallest ratio of effective to wanted stiffness
    std::uint32_t neededSubsteps = 1; ///< with which no link would be clamped
};

/// Nothing to report but for `split`.
StiffnessReport inspectStiffness(const sim::Scene& scene, const sim::Settings& settings);

} // namespace sinew::scenes
