// Time series of a run: energy, overlap and memory every few steps, for `sinew run --trace` and for runs to
// rest in a study.
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
    double potentialEnergy = 0;                           ///< in gravity [J]
    double residentMib = 0;                               ///< memory of this process
    double deviceMib = 0;                                 ///< in buffers of the device
};

/// The figures of the runner's newest finite state.
Sample sampleOf(const sim::Scene& scene, Runner& runner);

/// Takes steps until `count` are done, isInterrupted() or a divergence; samples after every `every` steps and
/// after the last. `onStep`: see Runner::advance.
std::vector<Sample> trace(Runner& runner, const sim::Scene& scene, std::uint64_t count, std::uint64_t every,
                          const std::function<void(std::uint64_t)>& onStep = {});

/// A line of names, which docs/report.md explains, and one line per sample; a field is empty if the figure
/// has no meaning.
std::string toCsv(std::span<const Sample> samples);

} // namespace sinew::tools
