// Tests of boundary planes on the device: rest, restitution and friction (analytic cases 16 to 18).
#include "sim/compile/compile.hpp"
#include "sim/reference/elasticity.hpp"
#include "sim/reference/reference.hpp"
#include "sim/runner.hpp"
#include "sim/scenes.hpp"
#include "sinew/bodies.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

using namespace sinew;
using namespace sinew::sim;
using Eigen::Vector3d;

namespace {

constexpr double g = 9.81;

class Contact : public testing::TestWithParam<Solver> {
protected:
    Settings settings(std::uint32_t substeps = 10) const {
        return {.solver = GetParam(), .substeps = substeps};
    }
};

// A particle at rest on a plane through the origin that slopes down towards +x by `degrees`, with friction
// 0.5.
Scene onIncline(double degrees, const Vec3& velocity = {}) {
    const double angle = degrees * std::numbers::pi / 180;
    Scene scene = test::particleAt({0, 0, 0}, velocity);
    scene.planes = {{.normal = {static_cast<float>(std::sin(angle)), static_cast<float>(std::cos(angle)), 0},
                     .friction = 0.5f}};
    return scene;
}

struct Heights {
    double lowest = 0, highest = 0, mean = 0;
};

Heights heightsOf(const std::vector<Vector3d>& x) {
    const auto isLower = [](const Vector3d& a, const Vector3d& b) { return a.y() < b.y(); };
    const auto [low, high] = std::minmax_element(x.begin(), x.end(), isLower);
    Heights heights{.lowest = low->y(), .highest = high->y()};
    for (const Vector3d& p : x) heights.mean += p.y() / static_cast<double>(x.size());
    return heights;
}

// Mean height after each step of springs that fall on the plane y = 0, where particles stop dead. [m]
std::vector<double> meanHeights(const Scene& scene, int steps, int substeps) {
    const reference::Problem problem(scene);
    reference::State state = reference::initialState(scene);
    const double h = double{scene.dt} / substeps;
    std::vector<double> heights;
    std::vector<Vector3d> force(state.x.size());
    for (int step = 0; step < steps; ++step) {
        for (int s = 0; s < substeps; ++s) {
            std::ranges::fill(force, Vector3d::Zero());
            reference::addElasticForces(problem, state.x, force);
            for (std::size_t i = 0; i < state.x.size(); ++i) {
                state.v[i] += h * (force[i] * double{scene.particles[i].inverseMass} - Vector3d(0, g, 0));
                state.x[i] += h * state.v[i];
                if (state.x[i].y() >= 0) continue;
                state.x[i].y() = 0;
                state.v[i].y() = std::max(0.0, state.v[i].y());
            }
        }
        heights.push_back(heightsOf(state.x).mean);
    }
    return heights;
}

// How far the mean height rises after its lowest value. [m]
double reboundOf(const std::vector<double>& heights) {
    const auto lowest = std::ranges::min_element(heights);
    return *std::max_element(lowest, heights.end()) - *lowest;
}

} // namespace

TEST_P(Contact, StopsAFallingParticleAtItsOffset) {
    Scene scene = test::particleAt({0, 0.5f, 0}, {0, -1, 0});
    scene.particles[0].contactOffset = 0.02f;
    scene.planes = {{.offset = 0.1f}};
    test::Runner runner(scene, settings());
    runner.run(120);
    EXPECT_NEAR(runner.positions()[0].y(), 0.12, 1e-6);
    EXPECT_LE(runner.velocities()[0].norm(), g / 600) << "at most what gravity adds in a substep";
}

// Case 16: the rebound height is e^2 h_0, with 600 substeps a second.
TEST_P(Contact, ReboundsToTheHeightOfItsRestitution) {
    for (const double restitution : {0.0, 0.5, 1.0}) {
        Scene scene = test::particleAt({0, 1, 0});
        scene.planes = {{.restitution = static_cast<float>(restitution)}};
        test::Runner runner(scene, settings());
        runner.run(27); // the fall takes 0.4515 s
        double apex = 0;
        for (int step = 27; step < 80; ++step) {
            runner.run(1);
            apex = std::max(apex, runner.positions()[0].y());
        }
        const double expected = restitution * restitution;
        EXPECT_NEAR(apex, expected, 0.02 * std::max(expected, 0.05)) << "e = " << restitution;
    }
}

TEST_P(Contact, NeverReboundsHigherThanItFell) {
    Scene scene = test::particleAt({0, 0.3f, 0});
    scene.planes = {{.restitution = 1}};
    test::Runner runner(scene, settings());
    for (int step = 0; step < 300; ++step) {
        runner.run(1);
        ASSERT_LE(runner.positions()[0].y(), 0.3 * 1.001);
        ASSERT_GE(runner.positions()[0].y(), -1e-6);
    }
}

// Case 17: friction holds up to atan 0.5 = 26.57 degrees, within one degree.
TEST_P(Contact, SticksOnAnInclineBelowTheFrictionAngle) {
    test::Runner runner(onIncline(25.6), settings());
    runner.run(120);
    EXPECT_LE(runner.positions()[0].norm(), 2e-4) << "creep of 1e-4 m/s in 2 s";
}

TEST_P(Contact, SlidesOnAnInclineAboveTheFrictionAngle) {
    for (const double degrees : {27.5, 35.0}) {
        test::Runner runner(onIncline(degrees), settings());
        runner.run(120);
        const double angle = degrees * std::numbers::pi / 180;
        const double path = g * (std::sin(angle) - 0.5 * std::cos(angle)) * 2 * 2 / 2;
        EXPECT_NEAR(runner.positions()[0].norm() / path, 1, 0.01) << degrees << " degrees";
    }
}

TEST_P(Contact, HoldsFasterWhatRestsThanWhatSlides) {
    const double angle = 22 * std::numbers::pi / 180;
    for (const double speed : {0.0, 0.2}) {
        Scene scene = onIncline(22, {static_cast<float>(speed * std::cos(angle)),
                                     static_cast<float>(-speed * std::sin(angle)), 0});
        scene.planes[0].friction = 0.2f;
        scene.planes[0].staticFriction = 0.5f;
        test::Runner runner(scene, settings());
        runner.run(60);
        const double path = speed + g * (std::sin(angle) - 0.2 * std::cos(angle)) / 2;
        EXPECT_NEAR(runner.positions()[0].norm(), speed > 0 ? path : 0, speed > 0 ? 0.01 * path : 1e-4);
    }
}

// Case 18: d = v^2 / (2 mu g).
TEST_P(Contact, SlidesToAStopWhereFrictionSays) {
    test::Runner runner(onIncline(0, {2, 0, 0}), settings());
    runner.run(90);
    EXPECT_NEAR(runner.positions()[0].x() / (4 / (2 * 0.5 * g)), 1, 0.01);
    EXPECT_LE(std::abs(runner.velocities()[0].x()), 1e-5);
}

TEST_P(Contact, SlidesForEverWithoutFriction) {
    Scene scene = onIncline(0, {2, 0, 0});
    scene.planes[0].friction = 0;
    test::Runner runner(scene, settings());
    runner.run(60);
    EXPECT_NEAR(runner.positions()[0].x(), 2, 1e-4);
}

TEST_P(Contact, HoldsAParticleInACornerOfThreePlanes) {
    Scene scene = test::particleAt({0.2f, 0.4f, 0.3f}, {-3, 0, -2});
    scene.planes = {{.normal = {1, 0, 0}, .restitution = 0.5f},
                    {.normal = {0, 1, 0}, .friction = 0.3f, .restitution = 0.5f},
                    {.normal = {0, 0, 1}, .restitution = 0.5f}};
    test::Runner runner(scene, settings());
    for (int step = 0; step < 120; ++step) {
        runner.run(1);
        ASSERT_GE(runner.positions()[0].minCoeff(), -1e-6) << "step " << step;
    }
}

TEST(RestingCube, KeepsItsHeightWithinOnePercentAfterFourSeconds) {
    constexpr std::uint32_t cells = 8;
    constexpr double side = 0.4;
    Scene scene = test::block(cells, static_cast<float>(side / cells), 1e6f, 0.05f);
    scene.planes = {{.friction = 0.5f}};
    scene.damping = 2;
    test::Runner runner(scene);
    ASSERT_EQ(runner.run(240).nonFinite, 0u);
    const Heights heights = heightsOf(runner.positions());
    EXPECT_NEAR((heights.highest - heights.lowest) / side, 1, 0.01);
    EXPECT_NEAR(heights.lowest, 0, 0.01 * side);
    EXPECT_NEAR(heights.mean / (side / 2), 1, 0.01);
    double fastest = 0;
    for (const Vector3d& v : runner.velocities()) fastest = std::max(fastest, v.norm());
    EXPECT_LE(fastest, 0.01) << "[m/s]";
}

INSTANTIATE_TEST_SUITE_P(Of, Contact, testing::Values(Solver::jacobi, Solver::split, Solver::gaussSeidel),
                         [](const auto& parameter) { return solverName(parameter.param); });

// A soft body rebounds by the elastic energy that its links take up in the impact, though the plane has no
// restitution. The truth is the motion of its springs, whose particles stop dead, in short steps in double.
TEST(SoftBody, ReboundsByTheEnergyOfItsLinks) {
    for (const std::array<std::uint32_t, 3> cells : {std::array{3u, 3u, 3u}, {1u, 8u, 1u}}) {
        Scene scene;
        addLattice(scene, {.origin = {0, 0.3f, 0}, .cells = cells, .spacing = 0.05f, .youngModulus = 5e4f});
        constexpr int steps = 45;
        const double truth = reboundOf(meanHeights(scene, steps, 1600));
        scene.planes = {{}};
        for (const std::uint32_t substeps : {16u, 64u}) {
            test::Runner runner(scene, {.substeps = substeps, .theta = 0});
            std::vector<double> heights;
            for (int step = 0; step < steps; ++step) {
                runner.run(1);
                heights.push_back(heightsOf(runner.positions()).mean);
            }
            const double rise = reboundOf(heights);
            std::printf("%u cells high, %u substeps: rises by %.4f m (%.4f)\n", cells[1], substeps, rise,
                        truth);
            EXPECT_NEAR(rise, truth, 0.003 * truth);
        }
    }
}
