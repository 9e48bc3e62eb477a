// The error of a run against the true motion.
#pragma once

#include "sim/reference/trajectory.hpp"
#include "sim/runner.hpp"

#include <cmath>
#include <vector>

namespace sinew::test {

/// RMS distance from the true motion, relative to that of a body that stays where it is.
inline double errorOf(const sim::Scene& scene, const sim::Settings& settings,
                      const sim::reference::Trajectory& truth) {
    Runner runner(scene, settings);
    const std::vector<Eigen::Vector3d> start = runner.positions();
    double error = 0, motion = 0;
    for (const std::vector<Eigen::Vector3d>& frame : truth.frames) {
        runner.run(1);
        const std::vector<Eigen::Vector3d> x = runner.positions();
        for (std::size_t i = 0; i < x.size(); ++i) {
            error += (x[i] - frame[i]).squaredNorm();
            motion += (start[i] - frame[i]).squaredNorm();
        }
    }
    return std::sqrt(error / motion);
}

} // namespace sinew::test
