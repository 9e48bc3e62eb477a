// Errors are summed in double from the published positions.
#include "sinew/study/trial.hpp"

#include "app/guard.hpp"
#include "sinew/statistics.hpp"
#include "sinew/study/analysis.hpp"
#include "sinew/system.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numeric>

namespace sinew::tools::study {

namespace {

constexpr double hopeless = 10; // body sizes: diverged beyond this

} // namespace

double Trial::medianMs() const {
    return summarise(frameMs).value_or(Statistics{}).p50;
}

std::vector<double> Trial::repeatMs() const {
    std::vector<double> medians;
    auto first = frameMs.begin();
    for (const Repeat& repeat : repeats) {
        const auto end = first + static_cast<std::ptrdiff_t>(repeat.frames);
        if (const auto repeated = summarise({first, end})) medians.push_back(repeated->p50);
        first = end;
    }
    return medians;
}

void Trial::add(const std::vector<double>& ms) {
    frameMs.insert(frameMs.end(), ms.begin(), ms.end());
    repeats.push_back({ms.size(), loadAverage()});
}

void compareWithTruth(Session& session, const StudyScene& scene, const Truth& truth, Trial& trial) {
    Runner runner(session, scene.loaded.scene, trial.settings);
    trial.frameRms.clear();
    trial.frameMax.clear();
    for (std::uint32_t frame = 0; frame < scene.frames && !app::isInterrupted(); ++frame) {
        runner.advance(1, 1);
        if (runner.divergence()) break;
        if (runner.steps() <= frame) return; // interrupted within the step
        const Distance error = distanceOf(truth.frames[frame], positionsOf(runner.readState()));
        trial.frameRms.push_back(error.rms / truth.bodySize);
        trial.frameMax.push_back(error.max / truth.bodySize);
    }
    if (!runner.divergence() && trial.frameRms.size() < scene.frames) return;
    trial.isDiverged = runner.divergence() || rmsOver(trial.frameRms, trial.frameRms.size()) > hopeless;
    trial.hasDeviceClock = !runner.deviceMs().empty();
    trial.frameMs.clear();
    trial.repeats.clear();
    trial.add(trial.hasDeviceClock ? runner.deviceMs() : runner.frameMs());
    trial.isRun = true;
}

std::size_t framesLeftToTime(const Trial& trial) {
    constexpr std::size_t wanted = 200, fewest = 40;
    constexpr double enoughMs = 4000;
    const std::size_t frames = trial.frameMs.size();
    const double spent = std::accumulate(trial.frameMs.begin(), trial.frameMs.end(), 0.0);
    if (frames >= wanted || (frames >= fewest && spent >= enoughMs)) return 0;
    const double perFrame = frames == 0 ? 0 : spent / static_cast<double>(frames);
    const auto affordable = perFrame > 0 ? static_cast<std::size_t>(std::ceil(enoughMs / perFrame)) : wanted;
    return std::clamp(affordable, std::max(fewest, frames + 1), wanted) - frames;
}

} // namespace sinew::tools::study
