// Tests the references that other tests and the study use as the truth. Verlet converges with order 2 and
// conserves energy and momentum. Newton's method converges quadratically to an implicit Euler step of order 1
// and to states at rest.
#include "sim/reference/implicit_step.hpp"
#include "sim/reference/potential.hpp"
#include "sim/reference/trajectory.hpp"
#include "sim/scenes.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

using namespace sinew;
using namespace sinew::sim;
using Eigen::Vector3d;
using reference::State;

namespace {

// A soft block of 27 particles under gravity, disturbed and clamped at one corner.
Scene softBlock() {
    Scene scene = test::block(2, 0.1f, 1e4f);
    test::disturb(scene, 0.005f, 0.2f);
    scene.fixed = {{0}};
    return scene;
}

// A fixed particle at the origin and one of 1 kg on a spring of 128 N/m, stretched by 0.125 m from its rest
// length of 1 m.
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

// Momentum [kg m/s] and angular momentum about the origin [kg m^2/s].
std::pair<Vector3d, Vector3d> momentaOf(const Scene& scene, const State& state) {
    Vector3d linear = Vector3d::Zero(), angular = Vector3d::Zero();
    for (std::size_t i = 0; i < state.x.size(); ++i) {
        linear += state.v[i] / double{scene.particles[i].inverseMass};
        angular += state.x[i].cross(state.v[i]) / double{scene.particles[i].inverseMass};
    }
    return {linear, angular};
}

// Message of the std::invalid_argument, or "".
template <typename Action> std::string complaintOf(const Action& action) {
    try {
        action();
    } catch (const std::invalid_argument& error) {
        return error.what();
    }
    return "";
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
    EXPECT_NEAR(drifts[0] / drifts[1], 4, 0.6); // bounded and of order 2, without additional drift
}

TEST(Verlet, KeepsMomentumAndAngularMomentum) {
    Scene scene = softBlock();
    scene.gravity = {0, 0, 0};
    scene.fixed.clear();
    const auto [linear, angular] = momentaOf(scene, reference::initialState(scene));
    const auto [linearAfter, angularAfter] = momentaOf(scene, afterVerlet(scene, 1, 2000));
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

// For order 2, the remaining error is a third of the change by halving h.
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
    const auto complaint = [](const Scene& scene, const reference::TrajectoryOptions& options) {
        return complaintOf([&] { reference::trueTrajectory(scene, options); });
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

// A scene element without a part in the equations of motion would make the result that of another scene.
TEST(References, RefuseByNameWhatTheyLeaveOut) {
    const auto with = [](auto&& add) {
        Scene scene = oscillator();
        scene.particles.push_back({.position = {2, 0, 0}});
        add(scene);
        return scene;
    };
    const std::pair<const char*, Scene> scenes[] = {
        {"bends", with([](Scene& s) {
             s.bends = {{0, 1, 2, 1e-3f}};
         })},
        {"attachments", with([](Scene& s) { s.attachments = {{.particle = 1, .compliance = 1e-3f}}; })},
        {"tethers", with([](Scene& s) {
             s.tethers = {{1, 0, 0.5f}};
         })},
        {"internal damping", with([](Scene& s) { s.dampingTime = 0.01f; })}};
    for (const auto& named : scenes) {
        const char* name = named.first;
        const Scene& scene = named.second;
        SCOPED_TRACE(name);
        State state = reference::initialState(scene);
        const auto isRefused = [&](const std::string& sentence) {
            return sentence.find(name) != std::string::npos;
        };
        const bool isDamping = scene.dampingTime > 0, hasEnergy = isDamping || !scene.tethers.empty();
        EXPECT_TRUE(isRefused(complaintOf([&] { reference::trueTrajectory(scene, {}); })));
        EXPECT_TRUE(isRefused(complaintOf([&] { reference::stepVerlet(scene, 1e-4, 1, state); })));
        EXPECT_TRUE(isRefused(complaintOf([&] { reference::stepImplicitEuler(scene, 0.01, state); })));
        if (!isDamping) { // damping has no effect on a state at rest
            EXPECT_TRUE(isRefused(complaintOf([&] { reference::findEquilibrium(scene, state); })));
        }
        EXPECT_EQ(isRefused(complaintOf([&] { reference::energy(scene, state); })), !hasEnergy);
    }
}

TEST(Trajectory, SaysWhereNoStepIsShortEnough) {
    // Rounding alone changes the result by more than this tolerance.
    EXPECT_THROW(reference::trueTrajectory(softBlock(), {.frames = 6, .tolerance = 1e-17}),
                 std::runtime_error);
}

TEST(Potential, HasTheGradientAndHessianThatDifferencesShow) {
    const Scene scene = softBlock();
    const reference::Problem problem(scene);
    const State state = reference::initialState(scene);
    constexpr double distance = 1e-6;
    for (const reference::Potential& potential :
         {reference::Potential(problem), reference::Potential(problem, 1.0 / 60, state)}) {
        ASSERT_EQ(potential.size(), 3 * 26);
        const auto x = potential.moved(state.x, 0.003, Eigen::VectorXd::Random(potential.size()));
        const Eigen::VectorXd gradient = potential.gradient(x);
        const Eigen::MatrixXd hessian = potential.hessian(x, reference::Potential::Hessian::exact);
        for (Eigen::Index row = 0; row < potential.size(); ++row) {
            const Eigen::VectorXd unit = Eigen::VectorXd::Unit(potential.size(), row);
            const auto above = potential.moved(x, distance, unit),
                       below = potential.moved(x, -distance, unit);
            EXPECT_NEAR((potential.value(above) - potential.value(below)) / (2 * distance), gradient[row],
                        1e-6 * gradient.norm());
            const Eigen::VectorXd change =
                (potential.gradient(above) - potential.gradient(below)) / (2 * distance);
            EXPECT_LE((change - hessian.col(row)).norm(), 1e-6 * hessian.norm());
        }
    }
}

TEST(Potential, IsNeverIndefiniteInItsConvexForm) {
    Scene scene = softBlock();
    test::disturb(scene, 0.04f, 0);
    const reference::Problem problem(scene);
    const reference::Potential potential(problem);
    const std::vector<Vector3d> x = reference::initialState(scene).x;
    const auto smallest = [&](reference::Potential::Hessian kind) {
        return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(potential.hessian(x, kind)).eigenvalues()[0];
    };
    EXPECT_LT(smallest(reference::Potential::Hessian::exact), -1)
        << "the state is not compressed enough to tell";
    EXPECT_GE(smallest(reference::Potential::Hessian::convex), -1e-9);
}

TEST(Newton, ConvergesQuadratically) {
    const Scene scene = softBlock();
    State state = reference::initialState(scene);
    const reference::NewtonReport report = reference::stepImplicitEuler(scene, 1.0 / 60, state);
    EXPECT_LT(report.residual(), 1e-10);
    const std::vector<double>& g = report.gradients;
    ASSERT_GE(g.size(), 4u);
    //
    // grad
    // is squared from one iteration to the next, as long as rounding is negligible: the exponent is 2.
    double exponent = 0;
    for (std::size_t k = 2; k < g.size(); ++k) {
        if (g[k] > 1e-10 * g[0]) exponent = std::log(g[k] / g[k - 1]) / std::log(g[k - 1] / g[k - 2]);
    }
    EXPECT_GT(exponent, 1.7);
}

TEST(ImplicitEuler, ConvergesWithOrderOne) {
    const Scene scene = softBlock();
    const std::vector<Vector3d> truth = afterVerlet(scene, 0.1, 20'000).x;
    std::vector<double> errors;
    for (const int steps : {200, 400, 800}) {
        State state = reference::initialState(scene);
        for (int step = 0; step < steps; ++step) reference::stepImplicitEuler(scene, 0.1 / steps, state);
        errors.push_back(largestDistance(state.x, truth));
    }
    EXPECT_NEAR(std::log2(errors[0] / errors[1]), 1, 0.1);
    EXPECT_NEAR(std::log2(errors[1] / errors[2]), 1, 0.05);
}

// Along its spring the oscillator is linear: x' (1 + s) = 2 x - x_before, s = (omega h)^2.
TEST(ImplicitEuler, DampsAnOscillatorAsPredicted) {
    constexpr double h = 1.0 / 60, s = 128 * h * h;
    const Scene scene = oscillator();
    State state = reference::initialState(scene);
    double before = 0.125, now = 0.125; // at rest
    for (int step = 0; step < 60; ++step) {
        reference::stepImplicitEuler(scene, h, state);
        const double next = (2 * now - before) / (1 + s);
        EXPECT_NEAR(-state.x[1].y() - 1, next, 1e-10) << step;
        before = std::exchange(now, next);
    }
    EXPECT_LT(std::abs(now), 0.125 * std::pow(1 + s, -20));
}

TEST(ImplicitEuler, KeepsMomentumAndNoEnergy) {
    Scene scene = softBlock();
    scene.gravity = {0, 0, 0};
    scene.fixed.clear();
    State state = reference::initialState(scene);
    const Vector3d before = momentaOf(scene, state).first;
    double energy = reference::energy(scene, state).total();
    for (int step = 0; step < 30; ++step) {
        reference::stepImplicitEuler(scene, 1.0 / 60, state);
        const double now = reference::energy(scene, state).total();
        EXPECT_LT(now, energy) << step;
        energy = now;
    }
    EXPECT_LE((momentaOf(scene, state).first - before).norm(), 1e-10 * test::massOf(scene));
}

TEST(ImplicitEuler, FallsAsFarAsItsOrderSays) {
    const Scene scene = test::particleAt({0, 0, 0}, {1, 4, 0.5f});
    State state = reference::initialState(scene);
    for (int step = 0; step < 10; ++step) reference::stepImplicitEuler(scene, 0.1, state);
    // v n h + g h^2 n (n + 1) / 2
    EXPECT_LE((state.x[0] - Vector3d(1, 4 - double{9.81f} * 0.55, 0.5)).norm(), 1e-12);
}

TEST(ImplicitEuler, RefusesWhatItHasNoEnergyFor) {
    Scene rigid = oscillator();
    rigid.distances[0].compliance = 0;
    State state = reference::initialState(rigid);
    EXPECT_NE(
        complaintOf([&] { reference::stepImplicitEuler(rigid, 0.1, state); }).find("distance[0] is rigid"),
        std::string::npos);
    EXPECT_NE(complaintOf([&] { reference::stepImplicitEuler(oscillator(), 0, state); }).find("h"),
              std::string::npos);
}

// N masses m below each other: the n-th spring from below carries n m g.
TEST(Equilibrium, OfAHangingChainCarriesItsWeight) {
    Scene scene = test::chain(21, {1.0f / 128});
    scene.fixed = {{0}};
    scene.damping = 1;                                       // has no effect
    const State state = reference::staticEquilibrium(scene); // from a horizontal start
    double load = 0;
    for (std::size_t i = 20; i > 0; --i) {
        load += double{9.81f} / double{scene.particles[i].inverseMass};
        EXPECT_NEAR((state.x[i - 1] - state.x[i]).norm(), double{0.1f} + load / 128, 1e-9) << i;
        EXPECT_NEAR(state.x[i].x(), 0, 1e-9);
        EXPECT_LT(state.x[i].y(), state.x[i - 1].y());
    }
}

TEST(Equilibrium, OfASheetLeavesNoForceAndLessEnergyThanAnythingNear) {
    const Scene scene = test::sheet(8, 1e-3f);
    State state = reference::initialState(scene);
    const reference::NewtonReport report = reference::findEquilibrium(scene, state);
    EXPECT_LT(report.residual(), 1e-9);
    const double least = reference::energy(scene, state).total();
    const reference::Problem problem(scene);
    const reference::Potential potential(problem);
    for (int trial = 0; trial < 50; ++trial) {
        State near = state;
        near.x = potential.moved(state.x, 1e-3, Eigen::VectorXd::Random(potential.size()));
        EXPECT_GT(reference::energy(scene, near).total(), least);
    }
}

TEST(Equilibrium, DoesNotExistWhereNothingHolds) {
    Scene scene = oscillator();
    scene.gravity = {0, -9.81f, 0};
    scene.fixed.clear();
    EXPECT_THROW(reference::staticEquilibrium(scene), std::runtime_error);
}
