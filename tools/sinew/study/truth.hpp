// The true motion of a scene. Where nothing touches anything it is R1, the equations of motion in double
// (cases: 1). Contacts have no smooth truth: there it is the motion that `split` tends to as its substeps
// become shorter, and what halving them still changes is held against every comparison like chaos is.
#pragma once

#include "sinew/runner.hpp"
#include "sinew/study/plan.hpp"

#include <Eigen/Core>
#include <span>

namespace sinew::tools::study {

/// Of body size: what the second truth starts with (cases: 1, chaos check).
inline constexpr double perturbation = 1e-7;
inline constexpr double targetError = 0.01; ///< of body size: the headline is the time to reach it
/// Of a frame, in the truth about contacts; compared with half as many.
inline constexpr std::uint32_t truthSubsteps = 1000;

using Positions = std::vector<Eigen::Vector3d>; // of all particles [m]
Positions positionsOf(const State& state);

/// From one state to another, over all particles [m].
struct Distance {
    double rms = 0, max = 0;
};
Distance distanceOf(const Positions& a, const Positions& b);

struct Truth {
    double bodySize = 0; ///< [m]
    double h = 0;        ///< step of the truth [s]
    double selfDifference =
        0; ///< what halving h still changes, by body size; of contacts: RMS over all frames
    std::vector<double> growth;    ///< of the perturbation: RMS of each frame, by body size
    std::vector<double> halving;   ///< of contacts, RMS of each frame, by body size; else empty
    std::vector<Positions> frames; ///< empty where only the rest was kept

    /// The larger of growth and halving, frame by frame: what no error can be told from.
    std::vector<double> doubt() const;
};

/// How many frames of a run can be compared. Of contacts, where chaos begins with the first of them, it is
/// one number for all runs, or those that are worse would be compared for longer: as long as what cannot be
/// told from chaos is below a tenth of `targetError`.
std::size_t comparableFrames(std::span<const double> frameRms, const Truth& truth);

/// How many of a run that is targetError off in each of them.
std::size_t framesAtTarget(const Truth& truth);

/// Diagonal of the largest body: of what links hold together, its particles' radii included [m].
double largestBody(const sim::Scene& scene);

/// Throws app::Failure (badInput) for a scene whose true motion cannot be computed. After an interruption
/// frames are missing.
Truth truthOf(Session& session, const StudyScene& scene);

} // namespace sinew::tools::study
