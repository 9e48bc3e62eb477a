// Steps the reference and the device side by side.
#include "sim/constraints/agreement.hpp"

#include "sim/compile/compile.hpp"
#include "sim/model/coloring.hpp"
#include "sim/scenes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace sinew::test {

using namespace sim;

namespace {

std::uint64_t hashAfter(const Scene& scene, Settings settings, bool isReversed,
                        const std::vector<std::vector<Vec3>>& targets) {
    settings.isReversed = isReversed;
    Runner runner(scene, settings);
    for (const std::vector<Vec3>& to : targets) runner.step(scene.dt, to);
    return runner.stateHash();
}

} // namespace

void stepReference(const Scene& scene, const Settings& settings, float dt, reference::State& state) {
    if (settings.solver == Solver::gaussSeidel) {
        const std::vector<float> inverseMass = inverseMasses(scene);
        const Coloring links = colorByParticles(scene, inverseMass), bends = colorBends(scene, inverseMass);
        reference::GaussSeidel(scene, settings, links.order, bends.order).step(double{dt}, state);
        return;
    }
    const auto step = settings.solver == Solver::split ? reference::stepSplit : reference::stepJacobi;
    step(scene, settings, double{dt}, state);
}

double differenceOf(const Runner& runner, const reference::State& state, const Scene& scene, float dt) {
    const auto x = runner.positions(), v = runner.velocities();
    double largest = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        if (!x[i].allFinite() || !v[i].allFinite()) return std::numeric_limits<double>::infinity();
        largest = std::max({largest, (x[i] - state.x[i]).norm(), (v[i] - state.v[i]).norm() * double{dt}});
    }
    return largest / sizeOf(scene);
}

double differenceFromDouble(const Scene& scene, const Settings& settings,
                            const std::vector<std::vector<Vec3>>& targets) {
    Runner runner(scene, settings);
    reference::State state = reference::initialState(scene);
    for (const std::vector<Vec3>& to : targets) {
        runner.step(scene.dt, to);
        state.targets.clear();
        for (const Vec3& target : to) state.targets.push_back(toVector(target));
        stepReference(scene, settings, scene.dt, state);
    }
    return differenceOf(runner, state, scene, scene.dt);
}

void expectAgreement(const Scene& scene, Solver solver, const std::vector<std::vector<Vec3>>& targets) {
    for (const Settings& settings :
         {Settings{.solver = solver, .substeps = 1, .iterations = 2, .omega = 1, .theta = 0},
          Settings{.solver = solver, .substeps = 5},
          Settings{.solver = solver, .substeps = 8, .iterations = 2}}) {
        SCOPED_TRACE(scene.name + ", " + solverName(solver) + ", " + std::to_string(settings.substeps) +
                     " substeps");
        EXPECT_LE(differenceFromDouble(scene, settings, targets), 1e-5);
        EXPECT_EQ(hashAfter(scene, settings, false, targets), hashAfter(scene, settings, true, targets));
    }
}

} // namespace sinew::test
