// Samples are read between steps, so a traced run waits for the device and its times are not representative.
#include "sinew/trace.hpp"

#include "app/guard.hpp"
#include "sinew/system.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>

namespace sinew::tools {

Sample sampleOf(const sim::Scene& scene, Runner& runner) {
    const State state = runner.readState();
    const std::uint64_t step = runner.steps();
    const Errors errors = measurePenetration(scene, state, step);
    return {.step = step,
            .time = double{scene.dt} * static_cast<double>(step),
            .kineticEnergy = kineticEnergy(state),
            .penetrationMax = errors.penetrationMax,
            .penetrationRms = errors.penetrationRms,
            .asleep = static_cast<std::size_t>(std::ranges::count(state.isAsleep, true)),
            .potentialEnergy = potentialEnergy(scene, state),
            .residentMib = residentMib(),
            .deviceMib = static_cast<double>(runner.deviceBytes()) / (1024 * 1024)};
}

std::vector<Sample> trace(Runner& runner, const sim::Scene& scene, std::uint64_t count, std::uint64_t every,
                          const std::function<void(std::uint64_t)>& onStep) {
    std::vector<Sample> samples;
    while (runner.steps() < count && !runner.divergence() && !app::isInterrupted()) {
        const std::uint64_t before = runner.steps();
        runner.advance(std::min(every, count - before), sim::Simulation::framesInFlight, onStep);
        if (runner.steps() > before) samples.push_back(sampleOf(scene, runner));
    }
    return samples;
}

std::string toCsv(std::span<const Sample> samples) {
    const auto text = [](const std::optional<double>& value) {
        return value ? fmt::format("{:.6g}", *value) : std::string();
    };
    std::string csv = "step,time,kinetic_energy,penetration_max,penetration_rms,asleep,potential_energy,"
                      "resident_mib,device_mib\n";
    for (const Sample& s : samples)
        csv += fmt::format("{},{:.6g},{:.6g},{},{},{},{:.9g},{:.2f},{:.2f}\n", s.step, s.time,
                           s.kineticEnergy, text(s.penetrationMax), text(s.penetrationRms), s.asleep,
                           s.potentialEnergy, s.residentMib, s.deviceMib);
    return csv;
}

} // namespace sinew::tools
