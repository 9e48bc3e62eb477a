// Cases 13 and 14: angular momentum is conserved, and a falling body gains the momentum of gravity.
#include "cases/cases.hpp"
#include "sim/reference/trajectory.hpp"

#include <Eigen/Geometry>

#include <cstdio>
#include <numbers>

using namespace sinew;
using namespace sinew::sim;
using namespace sinew::test;
using Eigen::Vector3d;

namespace {

constexpr float frame = 1.0f / 60;

class Case13Spin : public SolverCase {};
class Case13SpinningBlock : public SolverCase {};
class Case14Momentum : public SolverCase {};
class Case14Gravity : public SolverCase {};

constexpr double blockSpeed = 0.67, blockRadius = 0.26; // speed of flight [m/s], radius of the block [m]
constexpr float halfWarm = 0.5f; // at 0.9 the loss of `gauss_seidel` is too close to rounding

// Share of the theoretical loss of angular momentum, which a link causes by acting along the future positions
// of its ends. A warm start acts along the present positions, as theta 0 does, so `gauss_seidel` loses only
// the part that it does not warm start.
double lossShare(const Settings& settings) {
    if (settings.solver == Solver::split) return double{settings.theta};
    return settings.solver == Solver::gaussSeidel ? 1 - double{settings.warmStart} : 1;
}

Vector3d momentumOf(const Scene& scene, const std::vector<Vector3d>& v) {
    Vector3d sum = Vector3d::Zero();
    for (std::size_t i = 0; i < v.size(); ++i) sum += v[i] / double{scene.particles[i].inverseMass};
    return sum;
}

Vector3d angularMomentumOf(const Scene& scene, const std::vector<Vector3d>& x,
                           const std::vector<Vector3d>& v) {
    Vector3d sum = Vector3d::Zero();
    for (std::size_t i = 0; i < v.size(); ++i)
        sum += x[i].cross(v[i]) / double{scene.particles[i].inverseMass};
    return sum;
}

// A ring of 10 g particles about z, each linked to the next, with an unstretched radius of 1 m.
constexpr int ringCount = 64;
constexpr double ringMass = 0.01, ringCompliance = 0.01;
const double chord = 2 * std::sin(std::numbers::pi / ringCount);

// Radius at which links of stiffness k balance the spin [rad/s]: m spin^2 r = k chord^2 (r - 1).
double radiusAt(double spin, double k) {
    return 1 / (1 - ringMass * spin * spin / (chord * chord * k));
}

Scene spinningRing(double radius, double spin) {
    Scene scene{.name = "ring"};
    scene.gravity = {0, 0, 0};
    for (std::uint32_t i = 0; i < ringCount; ++i) {
        const double angle = 2 * std::numbers::pi * i / ringCount;
        const Vector3d x = radius * Vector3d(std::cos(angle), std::sin(angle), 0);
        scene.particles.push_back({.position = toFloats(x),
                                   .velocity = toFloats(spin * Vector3d(-x.y(), x.x(), 0)),
                                   .inverseMass = static_cast<float>(1 / ringMass)});
        scene.distances.push_back(
            {i, (i + 1) % ringCount, static_cast<float>(chord), static_cast<float>(ringCompliance)});
    }
    return scene;
}

} // namespace

// Angular momentum that links take along the true motion if they act along the positions of their ends a time
// h later. A pair of forces f n on ends with relative velocity u exerts the torque h f u x n.
Vector3d spinTaken(const Scene& scene, double h, double time) {
    constexpr int samples = 1000;
    reference::State state = reference::initialState(scene);
    Vector3d sum = Vector3d::Zero();
    for (int sample = 0; sample < samples; ++sample) {
        reference::stepVerlet(scene, time / samples / 2, 1, state); // advances to the middle of the interval
        for (const DistanceConstraint& c : scene.distances) {
            const Vector3d d = state.x[c.b] - state.x[c.a], u = state.v[c.b] - state.v[c.a];
            const double force = (d.norm() - double{c.restLength}) / double{c.compliance};
            sum += time / samples * h * force * u.cross(d.normalized());
        }
        reference::stepVerlet(scene, time / samples / 2, 1, state);
    }
    return sum;
}

TEST_P(Case13SpinningBlock, KeepsItsMomentumAndLosesNoMoreSpinThanItsSolverTakes) {
    const Scene scene = spinningBlock({0.5f, 0.2f, -0.4f});
    Settings settings = accurate(GetParam(), 100);
    settings.omega = 1;
    settings.warmStart = halfWarm;
    CaseRunner runner(scene, settings);
    const double mass = massOf(scene), time = 10 * double{frame}, h = double{frame} / settings.substeps;
    const Vector3d before = momentumOf(scene, runner.velocities());
    const Vector3d spinBefore = angularMomentumOf(scene, runner.positions(), runner.velocities());
    runner.run(10);
    const Vector3d change = momentumOf(scene, runner.velocities()) - before;
    const Vector3d spinChange =
        angularMomentumOf(scene, runner.positions(), runner.velocities()) - spinBefore;
    const Vector3d expected = lossShare(settings) * spinTaken(scene, h, time);
    const double unit = 1e-6 * mass * blockSpeed * blockRadius;
    std::printf("case 13 %s: momentum %.2ge-6, spin %.2ge-6, expected %.2ge-6, off by %.2ge-6\n",
                solverName(GetParam()), 1e6 * change.norm() / (mass * blockSpeed), spinChange.norm() / unit,
                expected.norm() / unit, (spinChange - expected).norm() / unit);
    EXPECT_LE(change.norm(), 1e-5 * mass * blockSpeed);
    EXPECT_LE((spinChange - expected).norm(), 10 * unit);
}

INSTANTIATE_TEST_SUITE_P(Of, Case13SpinningBlock, testing::ValuesIn(caseSolvers), solverOf);

// A thin ring stretches by rho spin^2 r^2 / E, with links by m spin^2 r / (chord^2 k). It starts at nine
// tenths of that and oscillates about it. Links that act along future positions take angular momentum at the
// rate h spin^2.
TEST_P(Case13Spin, StretchesARing) {
    constexpr double spin = 1;
    const Settings settings{.solver = GetParam(), .substeps = 25, .theta = 0, .warmStart = halfWarm};
    const double h = double{frame} / settings.substeps;
    const double k = reachedStiffness(spinningRing(1, spin), settings, h, 0);
    const Scene scene = spinningRing(1 + 0.9 * (radiusAt(spin, k) - 1), spin);
    CaseRunner runner(scene, settings);
    const double before = angularMomentumOf(scene, runner.positions(), runner.velocities()).z();
    constexpr int steps = 480;
    double radius = 0;
    for (int step = 0; step < steps; ++step) {
        runner.run(1);
        for (const Vector3d& x : runner.positions()) radius += x.norm() / ringCount / steps;
    }
    const double after = angularMomentumOf(scene, runner.positions(), runner.velocities()).z();
    const double spinNow = (before + after) / 2 / (ringCount * ringMass * radius * radius);
    expectWithin("strain", radius - 1, radiusAt(spinNow, k) - 1, 0.01);
    if (GetParam() == Solver::split) {
        expectWithin("angular momentum after 12,000 substeps", after, before, 12 * 1e-5);
    } else {
        expectWithin("lost angular momentum", 1 - after / before,
                     lossShare(settings) * h * spinNow * spinNow * steps * double{frame}, 0.02);
    }
}

INSTANTIATE_TEST_SUITE_P(Of, Case13Spin, testing::ValuesIn(caseSolvers), solverOf);

namespace {

// Change of a vibrating, flying block's momentum over 1000 substeps, divided by M v.
Vector3d momentumGained(const Settings& settings) {
    Scene scene = spinningBlock({0.5f, 0.2f, -0.4f});
    disturb(scene, 0.02f, 0.5f);
    CaseRunner runner(scene, settings);
    const Vector3d before = momentumOf(scene, runner.velocities());
    runner.run(100);
    return (momentumOf(scene, runner.velocities()) - before) / (massOf(scene) * blockSpeed);
}

} // namespace

// These settings clamp and damp, or soften links as much as averaging does. With one weight for all
// particles, `jacobi` moves both ends of a link alike; a particle has 18 links.
TEST_P(Case14Momentum, IsKeptWhereASolverClampsAndDamps) {
    const Vector3d gained = momentumGained({.solver = GetParam(), .substeps = 10, .weight = 1.0f / 18});
    std::printf("case 14 %s: momentum %.2g\n", solverName(GetParam()), gained.norm());
    EXPECT_LE(gained.norm(), 1e-5);
}

INSTANTIATE_TEST_SUITE_P(Of, Case14Momentum, testing::ValuesIn(caseSolvers), solverOf);

// Averaging moves the ends of a link unequally where they have different numbers of links. This limit of
// averaging has the same size in double.
TEST(Case14MomentumOfJacobi, ChangesWithAveragingAsMuchAsInDouble) {
    const Settings settings{.solver = Solver::jacobi, .substeps = 10};
    const Vector3d gained = momentumGained(settings);
    Scene scene = spinningBlock({0.5f, 0.2f, -0.4f});
    disturb(scene, 0.02f, 0.5f);
    reference::State state = reference::initialState(scene);
    const Vector3d before = momentumOf(scene, state.v);
    for (int step = 0; step < 100; ++step) reference::stepJacobi(scene, settings, double{scene.dt}, state);
    const Vector3d expected = (momentumOf(scene, state.v) - before) / (massOf(scene) * blockSpeed);
    std::printf("case 14 jacobi, averaging: momentum %.4g, in double %.4g, differs by %.2g\n", gained.norm(),
                expected.norm(), (gained - expected).norm());
    EXPECT_LE((gained - expected).norm(), 1e-5);
    EXPECT_LE(gained.norm(), 0.025);
}

TEST_P(Case14Gravity, GivesMomentum) {
    Scene scene = spinningBlock({0, 0, 0});
    scene.gravity = {0, -9.81f, 0};
    CaseRunner runner(scene, {.solver = GetParam(), .substeps = 10});
    runner.run(60);
    const double lag = GetParam() == Solver::split ? double{frame} / 10 / 2 : 0; // lag of the velocities
    const double time = 1 - lag;
    const Vector3d expected = massOf(scene) * time * toVector(scene.gravity);
    const Vector3d change = momentumOf(scene, runner.velocities()) - expected;
    RecordProperty("momentum", std::to_string(1e6 * change.norm() / expected.norm()) + "e-6");
    EXPECT_LE(change.norm(), 1e-5 * expected.norm());
}

INSTANTIATE_TEST_SUITE_P(Of, Case14Gravity, testing::ValuesIn(caseSolvers), solverOf);
