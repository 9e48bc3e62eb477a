// One point of a study: a scene solved with one choice of settings, its error against the truth and its time
// on the device.
#pragma once

#include "sinew/study/truth.hpp"
#include "sinew/trace.hpp"

namespace sinew::tools::study {

/// One motion that was timed.
struct Repeat {
    std::size_t frames = 0; ///< its entries of Trial::frameMs
    double load = 0;        ///< the machine's load average over the last minute, all programs
};

struct Trial {
    sim::Settings settings;
    std::string identity; ///< of all inputs of the result; see store.hpp
    std::uint64_t sweeps = 0, barriers = 0;
    std::optional<double> clamped; ///< share of elastic links softer than asked; empty if not known
    bool isRun = false, isDiverged = false;
    std::vector<double> frameRms, frameMax; ///< error of each frame with a finite state, by body size
    std::vector<double> frameMs;            ///< times of steps [ms], of all repeats, one after another
    std::vector<Repeat> repeats;
    bool hasDeviceClock = false; ///< frameMs are device timestamps, else wall-clock times

    double medianMs() const;
    /// The median time of a step in each repeat [ms]: equal work, so that its spread is that of the machine.
    std::vector<double> repeatMs() const;
    /// Adds a repeat with these times and the present load.
    void add(const std::vector<double>& ms);
};

/// A run to rest.
struct RestRun {
    sim::Settings settings;
    std::string identity;
    bool isRun = false, isDiverged = false;
    std::vector<Sample> samples; ///< by rising time
};

/// Runs the motion once and compares every frame with the truth. The trial diverges if the state is not
/// finite, or off by more than ten body sizes.
void compareWithTruth(Session& session, const StudyScene& scene, const Truth& truth, Trial& trial);

/// Number of frames still to be timed: 200 in all, fewer if they are slow.
std::size_t framesLeftToTime(const Trial& trial);

} // namespace sinew::tools::study
