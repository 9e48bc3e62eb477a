// Pilot runs: the error of a number of substeps, estimated from the first steps of a scene, and the number
// that reaches an error.
#pragma once

#include "sinew/study/truth.hpp"

#include <map>

namespace sinew::tools {

/// The findings of three runs that differ in their substeps by factors of 2. Differences are RMS over all
/// steps and particles, relative to the motion: to the distance from the start, averaged in the same way.
struct ErrorEstimate {
    std::uint32_t steps = 0;             ///< of each pilot run
    std::vector<std::uint32_t> substeps; ///< of the runs, rising
    std::uint32_t chosen = 0;            ///< the number whose error is given
    double difference = 0;               ///< measured: between `chosen` and the finest run
    /// Measured: log2 of the ratio of both differences. Empty if they do not shrink by a quarter at least:
    /// then there is no estimate, as in a scene that is chaotic within these steps.
    std::optional<double> order;
    std::optional<double> ofMotion; ///< the error by that order (Richardson), relative to the motion
    std::optional<double> ofBody;   ///< the same relative to the largest body
};

/// The order, and the error of the finest of three runs, from the differences of the two coarser ones and of
/// the two finer ones. Empty if the second difference is above 3/4 of the first.
struct Richardson {
    double order = 0, finest = 0;
};
std::optional<Richardson> extrapolate(double coarseDifference, double fineDifference);

/// Runs each number of substeps once and keeps its motion. `session` and `loaded` outlive the object.
class Pilot {
public:
    Pilot(Session& session, const scenes::LoadedScene& loaded, std::uint32_t steps);

    /// Runs half, once and twice the substeps; an odd number 1, 2 and 4 times as many; near the largest
    /// number a quarter, half and once. While their differences do not shrink, all are doubled, up to 16
    /// times the substeps. Empty if a run diverges or is interrupted, or if nothing moves.
    std::optional<ErrorEstimate> estimate(std::uint32_t substeps);

    /// The fewest substeps whose error is at most `error`, relative to the motion, to a part in 16: doubles
    /// until the estimate is below a quarter of it, then bisects by the difference from the finest run plus
    /// the estimated error of that. Empty if no number does.
    std::optional<ErrorEstimate> find(double error);

private:
    struct Motion {
        std::vector<study::Positions> frames;
        bool isWhole = false;
    };
    const Motion& motion(std::uint32_t substeps);
    /// RMS between two motions [m]; empty if one is not whole.
    std::optional<double> difference(std::uint32_t a, std::uint32_t b);
    std::optional<double> moved(std::uint32_t substeps);
    std::optional<ErrorEstimate> estimateOf(std::uint32_t chosen, std::uint32_t finest);

    Session& session_;
    const scenes::LoadedScene& loaded_;
    std::uint32_t steps_;
    std::map<std::uint32_t, Motion> motions_;
};

/// "about 0.4 % of the motion ...": measured figures and the estimate, told apart.
std::string toText(const ErrorEstimate& estimate);

} // namespace sinew::tools
