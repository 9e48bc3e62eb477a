// Tests of internal damping: its time in seconds, momentum, and stability under the clamp.
#include "sim/compile/compile.hpp"
#include "sim/constraints/agreement.hpp"
#include "sim/runner.hpp"
#include "sim/scenes.hpp"
#include "sinew/substeps.hpp"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

using namespace sinew;
using namespace sinew::sim;
using Eigen::Vector3d;

namespace {

class DampingTime : public testing::TestWithParam<Solver> {};

} // namespace

TEST_P(DampingTime, StepsAgreeWithDouble) {
    for (const float time : {1e-4f, 0.05f}) {
        for (const bool isInRoom : {false, true}) {
            Scene scene = test::block(4, 0.1f, 1e5f);
            if (isInRoom) test::addRoom(scene);
            scene.dampingTime = time;
            test::disturb(scene, 0.02f, 0.5f);
            test::expectAgreement(scene, GetParam());
        }
        Scene scene = test::chain(40, {1e-4f, true});
        for (std::uint32_t i = 2; i < 40; ++i) scene.bends.push_back({i - 2, i - 1, i, 1e-2f});
        scene.dampingTime = time;
        test::disturb(scene, 0.02f, 0.5f);
        test::expectAgreement(scene, GetParam());
    }
}

// Two masses on a spring: omega = sqrt(2 k / m), amplitude exp(-omega^2 dampingTime t / 2).
TEST_P(DampingTime, OfASpringIsItsDecay) {
    Scene scene{.name = "pair"};
    scene.gravity = {0, 0, 0};
    scene.particles = {{}, {.position = {1.05f, 0, 0}}};
    scene.distances = {{0, 1, 1, 1.0f / 200}};
    scene.dampingTime = 5e-3f; // damping ratio 0.05
    // With one link, `jacobi` and a cold `gauss_seidel` are implicit, which adds a damping of omega^2 h / 2.
    const Settings settings{
        .solver = GetParam(), .substeps = 100, .iterations = 1, .theta = 0, .warmStart = 0};
    test::Runner runner(scene, settings);
    const double rate = std::sqrt(400.0), h = double{scene.dt} / 100;
    const int steps = static_cast<int>(std::round(6 * std::numbers::pi / rate / double{scene.dt}));
    const double t0 = 0, energy0 = 0.5 * 200 * 0.05 * 0.05;
    runner.run(steps);
    const auto x = runner.positions(), v = runner.velocities();
    const double stretch = (x[1] - x[0]).norm() - 1;
    const double energy = 0.5 * 200 * stretch * stretch + test::kineticEnergy(scene, v);
    const double extra = GetParam() == Solver::split ? 0 : h;
    const double predicted =
        rate * rate * (double{scene.dampingTime} + extra) * (steps * double{scene.dt} - t0);
    EXPECT_NEAR(-std::log(energy / energy0) / predicted, 1, 0.05);
}

TEST(DampingTimeOfSplit, KeepsLinearAndAngularMomentumOfASpinningBody) {
    Scene scene = test::block(3, 0.1f, 1e5f);
    scene.gravity = {0, 0, 0};
    scene.dampingTime = 0.02f;
    const Vector3d spin(3, 8, -2), centre(0.15, 0.15, 0.15);
    for (Particle& particle : scene.particles) {
        const Vector3d v = spin.cross(test::toVector(particle.position) - centre);
        particle.velocity = {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
    }
    test::Runner runner(scene, {.substeps = 40, .theta = 0});
    const auto momenta = [&] {
        const auto x = runner.positions(), v = runner.velocities();
        std::pair<Vector3d, Vector3d> sums{Vector3d::Zero(), Vector3d::Zero()};
        for (std::size_t i = 0; i < x.size(); ++i) {
            const double mass = 1 / double{scene.particles[i].inverseMass};
            sums.first += mass * v[i];
            sums.second += mass * (x[i] - centre).cross(v[i]);
        }
        return sums;
    };
    runner.run(1); // after a step, because velocities lag by half a substep
    const auto before = momenta();
    runner.run(100);
    const auto after = momenta();
    EXPECT_LE((after.first - before.first).norm(), 1e-5 * test::massOf(scene));
    EXPECT_LE((after.second - before.second).norm(), 2e-4 * before.second.norm());
}

// Energy falls for any damping time and any number of substeps.
TEST(DampingTimeOfSplitAndGaussSeidel, IsStableWhateverItIs) {
    for (const Solver solver : {Solver::split, Solver::gaussSeidel}) {
        for (const float time : {1e-3f, 1.0f}) {
            for (const std::uint32_t substeps : {2u, 16u}) {
                for (const float compliance : {0.0f, 1e-4f, 1e-2f}) {
                    Scene scene = test::sheet(8, compliance);
                    scene.gravity = {0, 0, 0};
                    scene.dampingTime = time;
                    test::disturb(scene, 0.001f, 0.1f);
                    test::Runner runner(scene, {.solver = solver, .substeps = substeps});
                    const double before = test::kineticEnergy(scene, runner.velocities());
                    ASSERT_EQ(runner.run(40).nonFinite, 0u);
                    EXPECT_LE(test::kineticEnergy(scene, runner.velocities()), before)
                        << solverName(solver) << ", " << time << " s, " << substeps << " substeps, "
                        << compliance << " m/N";
                }
            }
        }
    }
}

TEST(DampingTimeOfSplit, IsReportedAsFarAsASubstepBearsIt) {
    Scene scene = test::block(3, 0.1f, 1e5f);
    scene.dampingTime = 1e-4f;
    EXPECT_NEAR(inspectStiffness(scene, {.substeps = 60}).dampingTime, 1e-4, 1e-9);
    scene.dampingTime = 0.5f;
    const double borne = inspectStiffness(scene, {.substeps = 60}).dampingTime;
    EXPECT_GT(borne, 1e-4);
    EXPECT_LT(borne, 0.05);
    scene.dampingTime = 2e-3f;
    const SubstepChoice choice = chooseSubsteps(scene, {});
    EXPECT_EQ(choice.reason, SubstepReason::damping);
    EXPECT_NEAR(inspectStiffness(scene, {.substeps = choice.substeps}).dampingTime, 2e-3, 2e-5);
}

// Damping leaves a hanging chain at rest unchanged. (XPBD's damping term in the constraint would stretch it
// four times as far with a tenth of a second and 32 substeps.)
TEST(DampingTimeOfGaussSeidel, LeavesTheStaticShape) {
    Scene scene{.name = "hanging chain"};
    for (std::uint32_t i = 0; i <= 20; ++i) {
        scene.particles.push_back({.position = {0, -0.05f * static_cast<float>(i), 0}, .inverseMass = 100});
        if (i > 0) scene.distances.push_back({i - 1, i, 0.05f, 1e-3f});
    }
    scene.fixed = {{0}};
    scene.damping = 8;
    const double exact = 0.01 * 9.81 * 20 * 21 / (2 * 1000);
    scene.dampingTime = 0.1f;
    test::Runner runner(scene, {.solver = Solver::gaussSeidel, .substeps = 32});
    ASSERT_EQ(runner.run(250).nonFinite, 0u);
    EXPECT_NEAR((-runner.positions()[20].y() - 1) / exact, 1, 5e-3);
}

TEST(DampingTimeOfGaussSeidel, KeepsMomentumAndSpin) {
    Scene scene = test::block(3, 0.1f, 1e5f);
    scene.gravity = {0, 0, 0};
    const Vector3d spin(3, 8, -2), centre(0.15, 0.15, 0.15);
    for (Particle& particle : scene.particles) {
        const Vector3d v = spin.cross(test::toVector(particle.position) - centre);
        particle.velocity = {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
    }
    const auto spinAfter = [&](float time) {
        scene.dampingTime = time;
        test::Runner runner(scene, {.solver = Solver::gaussSeidel, .substeps = 40});
        runner.run(40);
        const auto x = runner.positions(), v = runner.velocities();
        Vector3d linear = Vector3d::Zero(), angular = Vector3d::Zero();
        for (std::size_t i = 0; i < x.size(); ++i) {
            const double mass = 1 / double{scene.particles[i].inverseMass};
            linear += mass * v[i];
            angular += mass * (x[i] - centre).cross(v[i]);
        }
        EXPECT_LE(linear.norm(), 1e-5 * test::massOf(scene)) << time;
        return angular.norm();
    };
    // The PBD order loses the same spin with and without damping, which damps the vibration only.
    EXPECT_NEAR(spinAfter(0.02f) / spinAfter(0), 1, 2e-3);
}

// In a substep, a link removes the part 1 - 1 / (1 + c h w) of the velocity along it, c = k dampingTime.
TEST(DampingTimeOfGaussSeidel, IsReportedAsFarAsALinkTakesItInASubstep) {
    Scene scene{.name = "pair"};
    scene.particles = {{}, {.position = {1, 0, 0}}};
    scene.distances = {{0, 1, 1, 1.0f / 200}};
    const double h = double{scene.dt} / 10;
    for (const double time : {1e-4, 0.5}) {
        scene.dampingTime = static_cast<float>(time);
        const double reported =
            inspectStiffness(scene, {.solver = Solver::gaussSeidel, .substeps = 10}).dampingTime;
        EXPECT_NEAR(reported * (1 + time * h * 2 * 200) / time, 1, 1e-5);
    }
}

INSTANTIATE_TEST_SUITE_P(Of, DampingTime, testing::Values(Solver::jacobi, Solver::split, Solver::gaussSeidel),
                         [](const auto& parameter) { return solverName(parameter.param); });
