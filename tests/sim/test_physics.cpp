// Tests of damping on the device, which is not an analytic case of tests/cases.
#include "sim/compile/compile.hpp"
#include "sim/runner.hpp"
#include "sim/scenes.hpp"

#include <gtest/gtest.h>

#include <cmath>

using namespace sinew;
using namespace sinew::sim;

namespace {

class Physics : public testing::TestWithParam<Solver> {};

} // namespace

TEST_P(Physics, DampingSlowsAFreeParticleExponentially) {
    Scene scene = test::particleAt({0, 0, 0}, {3, 0, 0});
    scene.gravity = {0, 0, 0};
    scene.damping = 1.5f;
    test::Runner runner(scene, {.solver = GetParam(), .substeps = 10});
    runner.run(60);
    EXPECT_NEAR(runner.velocities()[0].x() / (3 * std::exp(-1.5)), 1, 1e-4);
}

INSTANTIATE_TEST_SUITE_P(Of, Physics, testing::Values(Solver::jacobi, Solver::split, Solver::gaussSeidel),
                         [](const auto& parameter) { return solverName(parameter.param); });
