// Errors are summed in double from the positions a user would see.
#include "sinew/study/trial.hpp"

#include "app/guard.hpp"
#include "sinew/statistics.hpp"
#include "sinew/study/analysis.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace sinew::tools::study {

namespace {

namespace reference = sim::reference;

constexpr double hopeless = 10; // body sizes: no picture of the scene any more

struct Distance {
    double rms = 0, max = 0; // [m]
};

template <typename Positions>
Distance distance(const std::vector<Eigen::Vector3d>& truth, const Positions& positionOf) {
    Distance result;
    for (std::size_t i = 0; i < truth.size(); ++i) {
        const double square = (positionOf(i) - truth[i]).squaredNorm();
        result.rms += square;
        result.max = std::max(result.max, square);
    }
    result.rms = std::sqrt(result.rms / static_cast<double>(truth.size()));
    result.max = std::sqrt(result.max);
    return result;
}

reference::Trajectory trajectory(const StudyScene& scene, double disturbance) {
    try {
        return reference::trueTrajectory(
            scene.loaded.scene,
            {.frames = scene.frames, .dt = double{scene.loaded.scene.dt}, .perturbation = disturbance});
    } catch (const std::invalid_argument& error) {
        throw app::Failure(app::badInput, "cannot study " + scene.name + ": " + error.what() +
                                              ": use a scene of elastic bodies without planes and damping");
    } catch (const std::runtime_error& error) {
        throw app::Failure(app::badInput,
                           "cannot study " + scene.name + ": " + error.what() + ": use fewer --frames");
    }
}

} // namespace

Truth truthOf(const StudyScene& scene) {
    const double size = reference::bodySize(scene.loaded.scene);
    reference::Trajectory truth = trajectory(scene, 0);
    const reference::Trajectory disturbed = trajectory(scene, perturbation);
    Truth result{.bodySize = size, .h = truth.h, .selfDifference = truth.selfDifference};
    for (std::size_t f = 0; f < truth.frames.size(); ++f) {
        const auto& other = disturbed.frames[f];
        result.growth.push_back(distance(truth.frames[f], [&](std::size_t i) { return other[i]; }).rms /
                                size);
    }
    result.frames = std::move(truth.frames);
    return result;
}

double Trial::medianMs() const {
    return summarise(frameMs).value_or(Statistics{}).p50;
}

void compareWithTruth(Session& session, const StudyScene& scene, const Truth& truth, Trial& trial) {
    Runner runner(session, scene.loaded.scene, trial.settings);
    trial.frameRms.clear();
    trial.frameMax.clear();
    for (std::uint32_t frame = 0; frame < scene.frames && !app::isInterrupted(); ++frame) {
        runner.advance(1, 1);
        if (runner.divergence()) break;
        if (runner.steps() <= frame) return; // interrupted within the step
        const State state = runner.readState();
        const Distance error = distance(truth.frames[frame], [&](std::size_t i) {
            const auto& x = state.positions[i];
            return Eigen::Vector3d(double{x[0]}, double{x[1]}, double{x[2]});
        });
        trial.frameRms.push_back(error.rms / truth.bodySize);
        trial.frameMax.push_back(error.max / truth.bodySize);
    }
    if (!runner.divergence() && trial.frameRms.size() < scene.frames) return;
    trial.isDiverged = runner.divergence() || rmsOver(trial.frameRms, trial.frameRms.size()) > hopeless;
    trial.hasDeviceClock = !runner.deviceMs().empty();
    trial.frameMs = trial.hasDeviceClock ? runner.deviceMs() : runner.frameMs();
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
