// Time series of a run: energy and overlap every few steps, for `sinew run --trace` and for runs to rest in a
// study.
#pragma once

#include "sinew/runner.hpp"

#include <string>

namespace sinew::tools {

struct Sample {
    std::uint64_t step = 0;                               ///< steps done
    double time = 0;                                      ///< [s]
    double kineticEnergy = 0;                             ///< [J]
    std::optional<double> penetrationMax, penetrationRms; ///< see Errors [m]
    std::size_t asleep = 0;                               ///< sleeping particles
};

Sample sampleOf(const sim::Scene& scene, const State& state, std::uint64_t step);

/// Takes steps until `count` are done, isInterrupted() or a divergence; samples after every `every` steps and
/// after the last. `onStep`: see Runner::advance.
std::vector<Sample> trace(Runner& runner, const sim::Scene& scene, std::uint64_t count, std::uint64_t every,
                          const std::function<void(std::uint64_t)>& onStep = {});

/// "step,time,kinetic_energy,penetration_max,penetration_rms,asleep" and one line per sample; a field is
/// empty if the figure has no meaning.
std::string toCsv(std::span<const Sample> samples);

} // namespace sinew::tools
