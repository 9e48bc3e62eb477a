// Hard cases 13 and 30, and the bound on the time of all others: faults during a run, more colors than a step
// allows, and work that does not depend on the state.
#include "cases_hard/trial.hpp"
#include "sim/compile/compile.hpp"
#include "sim/model/coloring.hpp"
#include "sim/scenes.hpp"
#include "sinew/bodies.hpp"
#include "sinew/validate.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

using namespace sinew;
using namespace sinew::sim;
using Eigen::Vector3d;

namespace {

class RunTimeCase : public testing::TestWithParam<Solver> {
protected:
    Settings settings(std::uint32_t substeps = 8) const {
        return {.solver = GetParam(), .substeps = substeps};
    }
};

// Two blocks of 64 particles that fall side by side without contact.
Scene twoBodies() {
    Scene scene{.name = "two bodies"};
    for (const float x : {0.0f, 1.0f})
        addLattice(scene, {.origin = {x, 1, 0}, .cells = {3, 3, 3}, .spacing = 0.1f, .youngModulus = 1e5f});
    test::disturb(scene, 0.002f, 0.2f);
    return scene;
}

// One particle at the centre of `spokes` links, which needs as many colors as spokes.
Scene hub(std::uint32_t spokes) {
    Scene scene{.name = "hub"};
    scene.particles = {{.position = {0, 0, 0}}};
    for (std::uint32_t i = 1; i <= spokes; ++i) {
        const double angle = 0.1 * i;
        scene.particles.push_back({.position = test::toFloats({std::cos(angle), std::sin(angle), 0})});
        scene.distances.push_back({0, i, 1, 1e-4f});
    }
    return scene;
}

std::uint64_t invocationsOf(const StepProgram& program) {
    std::uint64_t sum = 0;
    for (const Pass& pass : program[List::step]) sum += pass.items;
    return sum;
}

} // namespace

// A NaN undoes the step for the whole scene. It reaches no other body, and both bodies continue as if the
// fault had not happened.
TEST_P(RunTimeCase, Case13ANaNCostsOneStepAndReachesNoOtherBody) {
    const Scene scene = twoBodies();
    constexpr std::uint32_t hit = 21, ofFirst = 64;
    test::Runner calm(scene, settings()), runner(scene, settings());
    calm.run(20);
    runner.run(10);
    const auto x = runner.positions(), v = runner.velocities();
    runner.writePosition(hit, std::numeric_limits<float>::quiet_NaN());
    const Status spoilt = runner.run(1);
    EXPECT_GE(spoilt.nonFinite, 1u);
    EXPECT_LE(spoilt.nonFinite, ofFirst) << "it has spread within its body at most";
    EXPECT_LT(spoilt.firstBadParticle, ofFirst);
    EXPECT_EQ(runner.positions(), x) << "the last finite state, of neighbours and of the other body too";
    EXPECT_EQ(runner.velocities(), v);
    EXPECT_EQ(runner.run(10).nonFinite, 0u) << "nothing is left of it";
    const auto expected = calm.positions(), reached = runner.positions();
    double difference = 0;
    for (std::size_t i = 0; i < expected.size(); ++i)
        difference = std::max(difference, (reached[i] - expected[i]).norm());
    EXPECT_LE(difference, 1e-5) << "[m]: rounding of the state put back";
    std::printf("case 13 %s: %u of 128 particles hit, afterwards %.2g m from the calm run\n",
                solverName(GetParam()), spoilt.nonFinite, difference);
}

// The grid of a ragged body has slots without a particle, which no step restores; a NaN must not enter them.
TEST_P(RunTimeCase, Case13ANaNInABodyWithEmptyCellsCostsOneStepToo) {
    Scene scene{.name = "ragged"};
    Lattice body{.origin = {0, 1, 0}, .cells = {5, 4, 6}, .spacing = 0.1f, .youngModulus = 1e5f};
    body.fill = test::raggedFill(5 * 4 * 6);
    addLattice(scene, body);
    test::Runner runner(scene, settings());
    ASSERT_EQ(runner.run(3).nonFinite, 0u);
    for (std::uint32_t hit = 0; hit < scene.particles.size(); hit += 17) {
        runner.writePosition(hit, std::numeric_limits<float>::quiet_NaN());
        EXPECT_GE(runner.run(1).nonFinite, 1u);
        EXPECT_EQ(runner.run(1).nonFinite, 0u) << "particle " << hit;
    }
}

// Coloring never leaves a constraint out: it uses as many colors as needed, and compilation refuses a step
// with too many and names their number. Solvers without colors accept the scene.
TEST_P(RunTimeCase, Case30MoreColorsThanAStepHasRoomForAreRefusedByNumber) {
    const Scene scene = hub(128);
    const Coloring coloring = colorByParticles(scene, inverseMasses(scene));
    EXPECT_EQ(coloring.colorCount(), 128u);
    EXPECT_EQ(coloring.order.size(), scene.distances.size());
    const auto complaints = validate(scene, settings(1000));
    if (GetParam() != Solver::gaussSeidel) {
        EXPECT_TRUE(complaints.empty());
    } else {
        ASSERT_EQ(complaints.size(), 1u);
        EXPECT_NE(complaints[0].find("128 colors of constraints is 128000 passes"), std::string::npos)
            << complaints[0];
    }
    const test::Trial trial = test::runTrial(scene, settings(), {.steps = 10});
    for (const DistanceConstraint& spoke : scene.distances)
        EXPECT_NEAR((trial.x.back()[spoke.b] - trial.x.back()[spoke.a]).norm(), 1, 1e-5);
}

// The frame time of a broken state must stay below three times that of a calm one. Without a clock, the test
// checks that the passes of a step and their invocations follow from the scene and not from the state.
TEST_P(RunTimeCase, ABrokenStateIsNoMoreWorkThanACalmOne) {
    for (Scene calm : {test::block(4, 0.1f, 1e5f), test::sheet(8, 1e-4f), test::chain(20, {1e-4f})}) {
        SCOPED_TRACE(calm.name);
        const StepProgram usual = compile(calm, settings());
        EXPECT_TRUE(std::ranges::none_of(usual[List::step], &Pass::isIndirect))
            << "nothing decided on the device";
        Scene flat = calm, mirrored = calm, collapsed = calm, wild = calm;
        for (Particle& particle : flat.particles) particle.position.y = 0;
        for (Particle& particle : mirrored.particles) particle.position.x *= -1;
        for (Particle& particle : collapsed.particles) particle.position = {1, 2, 3};
        test::disturb(wild, 1, 100);
        for (const Scene* broken : {&flat, &mirrored, &collapsed, &wild}) {
            const StepProgram program = compile(*broken, settings());
            EXPECT_EQ(describe(program), describe(usual));
            EXPECT_EQ(invocationsOf(program), invocationsOf(usual));
            EXPECT_EQ(declaredBytes(program), declaredBytes(usual));
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Of, RunTimeCase, testing::Values(Solver::jacobi, Solver::split, Solver::gaussSeidel),
                         [](const auto& parameter) { return solverName(parameter.param); });
