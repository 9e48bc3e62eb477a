// Runs a trial and checks the criteria of all hard cases.
#include "cases_hard/trial.hpp"

#include "cases/cases.hpp"
#include "sim/compile/compile.hpp"
#include "sim/scenes.hpp"
#include "sinew/substeps.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace sinew::test {

using namespace sim;
using Eigen::Vector3d;

namespace {

sim::Status step(Runner& runner, const Scene& scene, const TrialPlan& plan, int index) {
    const float dt = plan.dt ? plan.dt(index) : scene.dt;
    return runner.step(dt, plan.anchors ? plan.anchors(index) : std::vector<Vec3>{});
}

std::uint64_t hashOfRun(const Scene& scene, const Settings& settings, const TrialPlan& plan) {
    Runner runner(scene, settings);
    for (int s = 0; s < plan.steps; ++s) step(runner, scene, plan, s);
    return runner.stateHash();
}

void expectEqualBits(const Scene& scene, Settings settings, const TrialPlan& plan, std::uint64_t hash) {
    for (int repeat = 0; repeat < 2; ++repeat) EXPECT_EQ(hashOfRun(scene, settings, plan), hash) << "repeat";
    settings.isReversed = true;
    EXPECT_EQ(hashOfRun(scene, settings, plan), hash) << "reversed";
}

// Work of gravity between two states [J].
double workOfGravity(const Scene& scene, const std::vector<float>& inverseMass,
                     const std::vector<Vector3d>& from, const std::vector<Vector3d>& to) {
    double work = 0;
    for (std::size_t i = 0; i < from.size(); ++i)
        if (inverseMass[i] > 0) work += toVector(scene.gravity).dot(to[i] - from[i]) / double{inverseMass[i]};
    return work;
}

} // namespace

double elasticEnergy(const Scene& scene, const Settings& asked) {
    const Settings settings = withSubsteps(scene, asked);
    const std::vector<float> inverseMass = inverseMasses(scene);
    const double h = double{scene.dt} / settings.substeps;
    const bool isSplit = settings.solver == Solver::split;
    const std::vector<double> ofSplit =
        isSplit ? splitStiffnesses(scene, settings, h) : std::vector<double>{};
    double energy = 0;
    for (std::size_t index = 0; index < scene.distances.size(); ++index) {
        const DistanceConstraint& c = scene.distances[index];
        const double w = double{inverseMass[c.a]} + double{inverseMass[c.b]};
        if (w == 0) continue;
        const Vector3d d = toVector(scene.particles[c.b].position) - toVector(scene.particles[c.a].position);
        const double stretch = d.norm() - double{c.restLength};
        // XPBD: a correction C / (w + compliance / h^2) releases at most this energy as motion.
        const double stiffness = isSplit ? ofSplit[index] : 1 / (double{c.compliance} + h * h * w);
        energy += 0.5 * stiffness * stretch * stretch;
    }
    return energy;
}

Trial runTrial(const Scene& scene, const Settings& settings, const TrialPlan& plan) {
    const std::vector<float> inverseMass = inverseMasses(scene);
    Trial trial;
    Runner runner(scene, settings);
    const auto look = [&] {
        trial.x.push_back(runner.positions());
        trial.v.push_back(runner.velocities());
        trial.kineticEnergy.push_back(kineticEnergy(scene, trial.v.back()));
    };
    look();
    const double start = trial.kineticEnergy[0] + elasticEnergy(scene, settings) + plan.work;
    for (int s = 0; s < plan.steps; ++s) {
        const std::uint32_t nonFinite = step(runner, scene, plan, s).nonFinite;
        EXPECT_EQ(nonFinite, 0u) << "step " << s;
        look();
        const double allowed =
            start + std::max(0.0, workOfGravity(scene, inverseMass, trial.x[0], trial.x.back()));
        // At rest, a `jacobi` step reports half a kick of gravity as velocity; float32 adds rounding.
        const double h = double{scene.dt} / withSubsteps(scene, settings).substeps;
        const double kick = 0.5 * massOf(scene) * std::pow(toVector(scene.gravity).norm() * h, 2);
        const double most = 1.01 * allowed + kick + 1e-9;
        EXPECT_LE(trial.kineticEnergy.back(), most) << "step " << s;
        // Stops at the first failure of this run; failures of an earlier run do not count.
        if (nonFinite > 0 || !(trial.kineticEnergy.back() <= most)) return trial;
    }
    trial.hash = runner.stateHash();
    expectEqualBits(scene, settings, plan, trial.hash);
    return trial;
}

} // namespace sinew::test
