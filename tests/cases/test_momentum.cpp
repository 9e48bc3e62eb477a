// Cases 13 and 14: what spins keeps spinning, what falls gains the momentum of gravity.
#include "cases/cases.hpp"

#include <Eigen/Geometry>

#include <numbers>

using namespace sinew;
using namespace sinew::sim;
using namespace sinew::test;
using Eigen::Vector3d;

namespace {

constexpr float frame = 1.0f / 60;

class Case13Spin : public SolverCase {};
class Case14Gravity : public SolverCase {};

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

// Particles of 10 g on a circle about z, each linked to the next; unstretched it has a radius of 1 m.
constexpr int ringCount = 64;
constexpr double ringMass = 0.01, ringCompliance = 0.01;
const double chord = 2 * std::sin(std::numbers::pi / ringCount);

// The radius at which links of stiffness k hold the ring together at `spin` [rad/s]: m spin^2 r = k chord^2
// (r - 1).
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

TEST(Case13SpinningBlock, KeepsMomentumAndAngularMomentumOverAThousandSubsteps) {
    const Scene scene = spinningBlock({0.5f, 0.2f, -0.4f});
    CaseRunner runner(scene, {.substeps = 100, .omega = 1, .theta = 0});
    const double mass = massOf(scene), speed = 0.67, radius = 0.26; // of the translation, of the block
    const Vector3d before = momentumOf(scene, runner.velocities());
    const Vector3d spinBefore = angularMomentumOf(scene, runner.positions(), runner.velocities());
    runner.run(10);
    const Vector3d change = momentumOf(scene, runner.velocities()) - before;
    const Vector3d spinChange =
        angularMomentumOf(scene, runner.positions(), runner.velocities()) - spinBefore;
    RecordProperty("momentum", std::to_string(1e6 * change.norm() / (mass * speed)) + "e-6");
    RecordProperty("angular", std::to_string(1e6 * spinChange.norm() / (mass * speed * radius)) + "e-6");
    EXPECT_LE(change.norm(), 1e-5 * mass * speed);
    EXPECT_LE(spinChange.norm(), 1e-5 * mass * speed * radius);
}

// A thin ring is stretched by rho spin^2 r^2 / E, with links by m spin^2 r / (chord^2 k). It starts at nine
// tenths of that and breathes about it. A link that acts along where its ends will be, as every solver's but
// that of theta 0, takes angular momentum at the rate h spin^2. A warm start acts along where its ends are,
// as theta 0 does: `gauss_seidel` loses only what it does not keep. (Kept here is half: what 0.9 loses, 5e-4,
// is too close to the rounding of 12,000 substeps.)
TEST_P(Case13Spin, StretchesARing) {
    constexpr double spin = 1;
    const Settings settings{.solver = GetParam(), .substeps = 25, .theta = 0, .warmStart = 0.5f};
    const double lossShare = GetParam() == Solver::gaussSeidel ? 1 - double{settings.warmStart} : 1;
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
                     lossShare * h * spinNow * spinNow * steps * double{frame}, 0.02);
    }
}

INSTANTIATE_TEST_SUITE_P(Of, Case13Spin, testing::ValuesIn(caseSolvers), solverOf);

TEST(Case14Momentum, IsKeptWhereSplitClampsAndDamps) {
    Scene scene = spinningBlock({0.5f, 0.2f, -0.4f});
    disturb(scene, 0.02f, 0.5f);
    CaseRunner runner(scene, {.substeps = 10});
    const Vector3d before = momentumOf(scene, runner.velocities());
    runner.run(100);
    const Vector3d change = momentumOf(scene, runner.velocities()) - before;
    RecordProperty("momentum", std::to_string(1e6 * change.norm() / (massOf(scene) * 0.67)) + "e-6");
    EXPECT_LE(change.norm(), 1e-5 * massOf(scene) * 0.67);
}

TEST_P(Case14Gravity, GivesMomentum) {
    Scene scene = spinningBlock({0, 0, 0});
    scene.gravity = {0, -9.81f, 0};
    CaseRunner runner(scene, {.solver = GetParam(), .substeps = 10});
    runner.run(60);
    const double lag = GetParam() == Solver::split ? double{frame} / 10 / 2 : 0; // of v, half a substep
    const double time = 1 - lag;
    const Vector3d expected = massOf(scene) * time * toVector(scene.gravity);
    const Vector3d change = momentumOf(scene, runner.velocities()) - expected;
    RecordProperty("momentum", std::to_string(1e6 * change.norm() / expected.norm()) + "e-6");
    EXPECT_LE(change.norm(), 1e-5 * expected.norm());
}

INSTANTIATE_TEST_SUITE_P(Of, Case14Gravity, testing::ValuesIn(caseSolvers), solverOf);
