// The references that other tests and the study call the truth, held against what is known of them: Verlet
// converges with order 2 and keeps energy and momentum.
#include "sim/reference/trajectory.hpp"
#include "sim/scenes.hpp"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace sinew;
using namespace sinew::sim;
using Eigen::Vector3d;
using reference::State;

namespace {

// A soft block of 27 particles, disturbed, clamped at one corner, under gravity.
Scene softBlock() {
    Scene scene = test::block(2, 0.1f, 1e4f);
    test::disturb(scene, 0.005f, 0.2f);
    scene.fixed = {{0}};
    return scene;
}

// A fixed particle at the origin and one of 1 kg on a spring of 100 N/m, pulled 0.1 m out of its rest length
// of 1 m.
Scene oscillator() {
    Scene scene{.name = "oscillator"};
    scene.gravity = {0, 0, 0};
    scene.particles = {{}, {.position = {0, -1.125f, 0}}};
    scene.distances = {{0, 1, 1, 0.0078125f}}; // 128 N/m
    scene.fixed = {{0}};
    return scene;
}

State afterVerlet(const Scene& scene, double time, std::uint64_t steps) {
    State state = reference::initialState(scene);
    reference::stepVerlet(scene, time / static_cast<double>(steps), steps, state);
    return state;
}

double largestDistance(const std::vector<Vector3d>& a, const std::vector<Vector3d>& b) {
    double largest = 0;
    for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, (a[i] - b[i]).norm());
    return largest;
}

} // namespace

TEST(Verlet, ConvergesWithOrderTwo) {
    const Scene scene = softBlock();
    std::vector<std::vector<Vector3d>> answers;
    for (const std::uint64_t steps : {400, 800, 1600, 3200})
        answers.push_back(afterVerlet(scene, 0.2, steps).x);
    for (std::size_t level = 0; level + 2 < answers.size(); ++level) {
        const double ratio = largestDistance(answers[level], answers[level + 1]) /
                             largestDistance(answers[level + 1], answers[level + 2]);
        EXPECT_NEAR(std::log2(ratio), 2, 0.05) << level;
    }
}

TEST(Verlet, KeepsEnergyToTheSquareOfItsStep) {
    const Scene scene = softBlock();
    const double before = reference::energy(scene, reference::initialState(scene)).total();
    double scale = 0, drifts[2] = {0, 0};
    for (const int level : {0, 1}) {
        State state = reference::initialState(scene);
        for (int sample = 0; sample < 100; ++sample) { // 3 s
            reference::stepVerlet(scene, level == 0 ? 5e-4 : 2.5e-4, level == 0 ? 60 : 120, state);
            const reference::Energy now = reference::energy(scene, state);
            scale = std::max(scale, now.kinetic);
            drifts[level] = std::max(drifts[level], std::abs(now.total() - before));
        }
    }
    EXPECT_LE(drifts[1], 1e-3 * scale);
    EXPECT_NEAR(drifts[0] / drifts[1], 4, 0.6); // bounded and of order 2: no drift adds to it
}

TEST(Verlet, KeepsMomentumAndAngularMomentum) {
    Scene scene = softBlock();
    scene.gravity = {0, 0, 0};
    scene.fixed.clear();
    const auto momenta = [&scene](const State& state) {
        Vector3d linear = Vector3d::Zero(), angular = Vector3d::Zero();
        for (std::size_t i = 0; i < state.x.size(); ++i) {
            linear += state.v[i] / double{scene.particles[i].inverseMass};
            angular += state.x[i].cross(state.v[i]) / double{scene.particles[i].inverseMass};
        }
        return std::pair(linear, angular);
    };
    const auto [linear, angular] = momenta(reference::initialState(scene));
    const auto [linearAfter, angularAfter] = momenta(afterVerlet(scene, 1, 2000));
    EXPECT_LE((linearAfter - linear).norm(), 1e-13 * test::massOf(scene));
    EXPECT_LE((angularAfter - angular).norm(), 1e-13 * test::massOf(scene));
}

TEST(Trajectory, OfAnOscillatorIsACosine) {
    const Scene scene = oscillator();
    const reference::Trajectory truth = reference::trueTrajectory(scene, {.frames = 60, .dt = 0.05});
    ASSERT_EQ(truth.frames.size(), 60u);
    EXPECT_LT(truth.selfDifference, 1e-6);
    for (std::size_t frame = 0; frame < truth.frames.size(); ++frame) {
        const double t = 0.05 * static_cast<double>(frame + 1);
        EXPECT_NEAR(-truth.frames[frame][1].y() - 1, 0.125 * std::cos(std::sqrt(128.0) * t), 1e-6) << frame;
        EXPECT_EQ(truth.frames[frame][0], Vector3d::Zero());
    }
}

// A third as much again as what halving h moved the answer by is what still lacks, for order 2.
TEST(Trajectory, IsAsCloseToTheLimitAsItSays) {
    const Scene scene = softBlock();
    const reference::Trajectory truth = reference::trueTrajectory(scene, {.frames = 12});
    const std::vector<Vector3d> limit = afterVerlet(scene, 12.0 / 60, 100'000).x;
    EXPECT_LT(truth.selfDifference, 1e-6);
    EXPECT_LE(largestDistance(truth.frames.back(), limit),
              0.5 * truth.selfDifference * reference::bodySize(scene));
}

TEST(Trajectory, TakesStepsShorterThanATenthOfTheFastestVibration) {
    // 128 N/m on 1 kg
    EXPECT_LE(reference::trueTrajectory(oscillator(), {.tolerance = 1}).h, 0.1 / std::sqrt(128.0));
}

TEST(Trajectory, OfAPerturbedSceneStaysAsCloseAsThePerturbation) {
    const Scene scene = softBlock();
    const reference::Trajectory calm = reference::trueTrajectory(scene, {.frames = 6});
    const reference::Trajectory disturbed =
        reference::trueTrajectory(scene, {.frames = 6, .perturbation = 1e-4});
    const double moved =
        largestDistance(calm.frames.back(), disturbed.frames.back()) / reference::bodySize(scene);
    EXPECT_GT(moved, 1e-5);
    EXPECT_LT(moved, 1e-3);
    EXPECT_EQ(calm.frames.back()[0], disturbed.frames.back()[0]) << "a fixed particle is not moved";
    const reference::Trajectory again = reference::trueTrajectory(scene, {.frames = 6, .perturbation = 1e-4});
    EXPECT_EQ(again.frames, disturbed.frames);
}

TEST(Trajectory, FallsExactlyWithoutSprings) {
    const Scene scene = test::particleAt({0.3f, 0, -2}, {1, 4, 0.5f});
    const reference::Trajectory truth = reference::trueTrajectory(scene, {.frames = 60});
    const Vector3d path = test::toVector(scene.particles[0].velocity) + 0.5 * test::toVector(scene.gravity);
    const Vector3d x = test::toVector(scene.particles[0].position) + path;
    EXPECT_LE((truth.frames.back()[0] - x).norm(), 1e-12 * path.norm());
}

TEST(Trajectory, RefusesWhatIsNotASpringByName) {
    const auto complaint = [](const Scene& scene,
                              const reference::TrajectoryOptions& options) -> std::string {
        try {
            reference::trueTrajectory(scene, options);
        } catch (const std::invalid_argument& error) {
            return error.what();
        }
        return "";
    };
    Scene rigid = oscillator(), walled = oscillator(), damped = oscillator();
    rigid.distances[0].compliance = 0;
    walled.planes.push_back({});
    damped.damping = 0.5f;
    EXPECT_NE(complaint(rigid, {}).find("distance[0] is rigid"), std::string::npos);
    EXPECT_NE(complaint(walled, {}).find("planes"), std::string::npos);
    EXPECT_NE(complaint(damped, {}).find("damping"), std::string::npos);
    EXPECT_NE(complaint(oscillator(), {.dt = 0}).find("dt"), std::string::npos);
    EXPECT_NE(complaint(oscillator(), {.tolerance = 0}).find("tolerance"), std::string::npos);
    EXPECT_NE(complaint(oscillator(), {.perturbation = -1}).find("perturbation"), std::string::npos);
}

TEST(Trajectory, SaysWhereNoStepIsShortEnough) {
    // Rounding alone moves the answer by more.
    EXPECT_THROW(reference::trueTrajectory(softBlock(), {.frames = 6, .tolerance = 1e-17}),
                 std::runtime_error);
}
