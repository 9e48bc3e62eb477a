// The true motion of a scene. Without contacts it is R1, the equations of motion solved in double. Contacts
// have no smooth truth: the motion then is the limit of `split` for short substeps, and its change when they
// are halved limits every comparison, as chaos does.
#pragma once

#include "sinew/runner.hpp"
#include "sinew/study/plan.hpp"

#include <Eigen/Core>
#include <span>

namespace sinew::tools::study {

/// Perturbation of the second truth, relative to the body size (chaos check).
inline constexpr double perturbation = 1e-7;
inline constexpr double targetError = 0.01; ///< relative to body size; the headline is the time to reach it
/// Substeps per frame of the truth for contacts; compared with half as many.
inline constexpr std::uint32_t truthSubsteps = 1000;

using Positions = std::vector<Eigen::Vector3d>; // of all particles [m]
Positions positionsOf(const State& state);

/// The difference of two states over all particles [m].
struct Distance {
    double rms = 0, max = 0;
};
Distance distanceOf(const Positions& a, const Positions& b);

/// The scene with every coordinate of movable particles displaced by up to `most` [m], by a hash of the
/// index.
sim::Scene disturbed(sim::Scene scene, double most);

/// The positions of a scene at the start [m].
Positions startOf(const sim::Scene& scene);

struct Truth {
    double bodySize = 0;         ///< [m]
    double h = 0;                ///< step of the truth [s]
    double selfDifference = 0;   ///< change when h is halved, by body size; for contacts: RMS over all frames
    std::vector<double> growth;  ///< growth of the perturbation: RMS of each frame, by body size
    std::vector<double> halving; ///< for contacts, RMS of each frame, by body size; else empty
    std::vector<double> motion;  ///< distance from the start: RMS of each frame, by body size
    std::vector<Positions> frames; ///< empty if loaded without frames

    /// The larger of growth and halving, frame by frame: smaller errors are not significant.
    std::vector<double> doubt() const;
    /// The error of a body that stays where it started, over the first `count` frames, by body size: what an
    /// error relative to the motion is divided by. At most as many frames as there are.
    double standingStill(std::size_t count) const;
    double standingStill() const { return standingStill(motion.size()); }
};

/// Number of frames of a run that can be compared. For contacts, chaos begins with the first one; all runs
/// use the same number, since worse runs would otherwise be compared for longer: the frames whose doubt is
/// below a tenth of `targetError`.
std::size_t comparableFrames(std::span<const double> frameRms, const Truth& truth);

/// Number of comparable frames of a run that is off by targetError in each of them.
std::size_t framesAtTarget(const Truth& truth);

/// Diagonal of the largest body (particles joined by links), with particle radii [m].
double largestBody(const sim::Scene& scene);

/// Throws app::Failure (badInput) if the scene's true motion cannot be computed. After an interruption frames
/// are missing.
Truth truthOf(Session& session, const StudyScene& scene);

} // namespace sinew::tools::study
