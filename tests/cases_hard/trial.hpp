// A run that every hard case makes: finite after each step, no energy from nowhere, the same bits three times
// over and in reversed invocation order.
#pragma once

#include "sim/runner.hpp"
#include "sim/scene.hpp"

#include <functional>

namespace sinew::test {

/// What a run showed; entry 0 of the lists is the start.
struct Trial {
    std::vector<std::vector<Eigen::Vector3d>> x, v; ///< after each step [m], [m/s]
    std::vector<double> kineticEnergy;              ///< [J]
    std::uint64_t hash = 0;
};

struct TrialPlan {
    int steps = 60;
    /// Length of a step [s]; the scene's where it is empty.
    std::function<float(int step)> dt;
    /// Targets of attachments.
    std::function<std::vector<sim::Vec3>(int step)> anchors;
    /// What attachments may add to the energy [J].
    double work = 0;
};

/// Runs the scene and checks the criteria of all hard cases; fails the calling test where one is broken.
/// Energy: kinetic energy <= 1.01 x (kinetic + elastic energy of the start + work of gravity + plan.work).
Trial runTrial(const sim::Scene& scene, const sim::Settings& settings, const TrialPlan& plan = {});

/// Of the links as stiff as the solver makes them at the scene's dt: for `split` by the division of particles
/// that the analytic cases predict with, for others by what one correction of a link alone can set free.
double elasticEnergy(const sim::Scene& scene, const sim::Settings& settings);

} // namespace sinew::test
