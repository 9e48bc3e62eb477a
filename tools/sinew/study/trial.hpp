// One point of a study: a scene solved with one choice of settings, its error against the true motion and its
// time on the device.
#pragma once

#include "sim/reference/trajectory.hpp"
#include "sinew/runner.hpp"
#include "sinew/study/plan.hpp"

namespace sinew::tools::study {

/// Of body size: what the second truth starts with (cases: 1, chaos check).
inline constexpr double perturbation = 1e-7;

/// The true motion of a scene, and how fast a small disturbance of it grows.
struct Truth {
    double bodySize = 0;        ///< [m]
    double h = 0;               ///< step of the truth [s]
    double selfDifference = 0;  ///< what halving h still changes, by body size
    std::vector<double> growth; ///< of the perturbation: RMS of each frame, by body size
    std::vector<std::vector<Eigen::Vector3d>> frames; ///< positions [m]; empty where only the rest was kept
};

/// Throws app::Failure (badInput) for a scene whose true motion cannot be computed.
Truth truthOf(const StudyScene& scene);

struct Trial {
    sim::Settings settings;
    std::string identity; ///< of everything that shapes its result; see store.hpp
    std::uint64_t sweeps = 0, barriers = 0;
    std::optional<double> clamped; ///< share of elastic links softer than asked; empty where not known
    bool isRun = false, isDiverged = false;
    std::vector<double> frameRms, frameMax; ///< error of each frame with a finite state, by body size
    std::vector<double> frameMs;            ///< time of steps [ms], those of all rounds
    bool hasDeviceClock = false;            ///< frameMs are device timestamps, else wall-clock times

    double medianMs() const;
};

/// Runs the motion once and compares every frame with the truth. Where the state stops being finite, or is
/// ten body sizes off, the trial has diverged.
void compareWithTruth(Session& session, const StudyScene& scene, const Truth& truth, Trial& trial);

/// How many frames of a trial are still to be timed: 200 in all, fewer where they take long.
std::size_t framesLeftToTime(const Trial& trial);

} // namespace sinew::tools::study
