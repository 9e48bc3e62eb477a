// The run of every hard case. It checks that each step is finite, that no energy appears, and that three runs
// and one in reversed invocation order give equal bits.
#pragma once

#include "sim/runner.hpp"
#include "sinew/scene.hpp"

#include <functional>

namespace sinew::test {

/// Results of a run; entry 0 of each list is the start.
struct Trial {
    std::vector<std::vector<Eigen::Vector3d>> x, v; ///< after each step [m], [m/s]
    std::vector<double> kineticEnergy;              ///< [J]
    std::uint64_t hash = 0;
};

struct TrialPlan {
    int steps = 60;
    /// Length of a step [s]; empty means the scene's dt.
    std::function<float(int step)> dt;
    /// Targets of the attachments at a step.
    std::function<std::vector<sim::Vec3>(int step)> anchors;
    /// Largest energy that attachments may add [J].
    double work = 0;
};

/// Runs the scene and checks the criteria of all hard cases; a broken criterion fails the calling test.
/// Energy: kinetic energy <= 1.01 x (kinetic + elastic energy of the start + work of gravity + plan.work).
Trial runTrial(const sim::Scene& scene, const sim::Settings& settings, const TrialPlan& plan = {});

/// Elastic energy of the links with the stiffness that the solver gives them at the scene's dt [J]. For
/// `split`, from the division of particles in the analytic cases; for others, from the energy that one
/// correction of one link can release.
double elasticEnergy(const sim::Scene& scene, const sim::Settings& settings);

} // namespace sinew::test
