// Laws of motion on the device: free fall, links, springs, momentum (analytic cases 1 to 4, 13, 14).
#include "sim/compile.hpp"
#include "sim/runner.hpp"
#include "sim/scenes.hpp"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace sinew;
using namespace sinew::sim;
using Eigen::Vector3d;

namespace {

constexpr float frame = 1.0f / 60;

class Physics : public testing::TestWithParam<Solver> {};

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

// A block that flies and spins, without gravity.
Scene spinningBlock(const Vec3& speed) {
    Scene scene = test::block(3, 0.1f, 1e5f);
    scene.gravity = {0, 0, 0};
    const Vector3d spin(1, 2, -1), centre(0.15, 0.15, 0.15); // [rad/s], [m]
    for (Particle& particle : scene.particles) {
        const Vector3d v = test::toVector(speed) + spin.cross(test::toVector(particle.position) - centre);
        particle.velocity = {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
    }
    return scene;
}

// A particle of 10 g on a spring from a fixed particle at the origin, hanging along -y.
Scene hangingSpring(float compliance, float restLength) {
    Scene scene{.name = "hanging spring"};
    scene.particles = {{.inverseMass = 1}, {.position = {0, -restLength, 0}, .inverseMass = 100}};
    scene.distances = {{0, 1, restLength, compliance}};
    scene.fixed = {{0}};
    return scene;
}

double ulp(double value) {
    const auto x = static_cast<float>(value);
    return double{std::nextafter(x, std::numeric_limits<float>::infinity())} - double{x};
}

} // namespace

TEST_P(Physics, FreeFallIsExactForAnyStep) {
    Scene scene = test::particleAt({0.3f, 0, -2}, {1, 4, 0.5f});
    scene.gravity = {0.5f, -9.81f, 0};
    for (const std::uint32_t substeps : {1u, 7u, 10u}) {
        test::Runner runner(scene, {.solver = GetParam(), .substeps = substeps});
        double t = 0;
        float dt = frame;
        for (int step = 0; step < 60; ++step) {
            dt = frame * static_cast<float>(1 + step * 7 % 5) / 3;
            runner.step(dt);
            t += double{dt};
        }
        const Vector3d g = test::toVector(scene.gravity), v = test::toVector(scene.particles[0].velocity);
        const Vector3d path = t * v + t * t / 2 * g;
        const Vector3d x = test::toVector(scene.particles[0].position) + path;
        EXPECT_LE((runner.positions()[0] - x).norm(), 1e-5 * path.norm()) << substeps << " substeps";
        const double lag = GetParam() == Solver::split ? double{dt} / substeps / 2 : 0; // leapfrog
        EXPECT_LE((runner.velocities()[0] - v - (t - lag) * g).norm(), 1e-5 * (t * g).norm());
    }
}

TEST_P(Physics, OneProjectionGivesARigidLinkItsLengthAndKeepsTheCentreOfMass) {
    Scene scene;
    scene.gravity = {0, 0, 0};
    scene.particles = {{.position = {-0.31f, 0.12f, 0.05f}}, {.position = {0.24f, -0.2f, 0.4f}}};
    scene.distances = {{0, 1, 0.5f, 0}};
    // `split` takes half of omega in the half-kick that starts it: omega 2 is one whole projection.
    test::Runner runner(scene, {.solver = GetParam(), .substeps = 1, .omega = 2, .theta = 0});
    const Vector3d before = (runner.positions()[0] + runner.positions()[1]) / 2;
    runner.step(frame);
    const auto x = runner.positions();
    EXPECT_NEAR((x[1] - x[0]).norm(), 0.5, 4 * ulp(0.5));
    EXPECT_LE(((x[0] + x[1]) / 2 - before).cwiseAbs().maxCoeff(), 2 * ulp(0.3));
}

TEST_P(Physics, AHangingSpringStretchesByItsLoad) {
    constexpr double k = 100, mass = 0.01, gravity = 98.1; // clamped by `split` at one and two substeps
    Scene scene = hangingSpring(static_cast<float>(1 / k), 0.01f);
    scene.gravity = {0, -98.1f, 0};
    scene.damping = 20;
    for (const std::uint32_t substeps : {1u, 2u, 4u, 16u, 64u}) {
        const Settings settings{.solver = GetParam(), .substeps = substeps, .omega = 1, .theta = 0.1f};
        const double h = double{frame} / substeps;
        const double clamp = 1 / (2 * h * h / mass); // omega / (2 n w h^2)
        const double effective = GetParam() == Solver::split ? std::min(k, clamp) : k;
        test::Runner runner(scene, settings);
        runner.run(240);
        const double stretch = -runner.positions()[1].y() - 0.01;
        EXPECT_NEAR(stretch / (mass * gravity / effective), 1, 1e-4) << substeps << " substeps";
    }
}

// Case 4: x_n = A cos(2 n asin(omega h / 2)) for leapfrog, exactly, at constant amplitude.
TEST(Split, VibratesAsLeapfrogDoes) {
    constexpr double k = 100, mass = 0.01, amplitude = 0.02;
    Scene scene = hangingSpring(static_cast<float>(1 / k), 0.1f);
    scene.gravity = {0, 0, 0};
    scene.particles[1].position.y -= static_cast<float>(amplitude);
    const Settings settings{.substeps = 8, .omega = 2, .theta = 0};
    const double phase = 2 * std::asin(std::sqrt(k / mass) * double{frame} / settings.substeps / 2);
    test::Runner runner(scene, settings);
    for (int step = 1; step <= 120; ++step) {
        runner.step(frame);
        const double stretch = -runner.positions()[1].y() - 0.1;
        ASSERT_NEAR(stretch, amplitude * std::cos(phase * settings.substeps * step), 2e-3 * amplitude)
            << step;
    }
}

TEST(Split, KeepsMomentumAndAngularMomentumOverAThousandSubsteps) {
    const Scene scene = spinningBlock({0.5f, 0.2f, -0.4f});
    test::Runner runner(scene, {.substeps = 100, .omega = 1, .theta = 0});
    const double mass = test::massOf(scene), speed = 0.67, radius = 0.26; // of the translation, of the block
    const Vector3d before = momentumOf(scene, runner.velocities());
    const Vector3d spinBefore = angularMomentumOf(scene, runner.positions(), runner.velocities());
    runner.run(10);
    EXPECT_LE((momentumOf(scene, runner.velocities()) - before).norm(), 1e-5 * mass * speed);
    const Vector3d spin = angularMomentumOf(scene, runner.positions(), runner.velocities());
    EXPECT_LE((spin - spinBefore).norm(), 1e-5 * mass * speed * radius);
}

TEST(Split, KeepsMomentumWhereItClampsAndDamps) {
    Scene scene = spinningBlock({0.5f, 0.2f, -0.4f});
    test::disturb(scene, 0.02f, 0.5f);
    test::Runner runner(scene, {.substeps = 10});
    const Vector3d before = momentumOf(scene, runner.velocities());
    runner.run(100);
    EXPECT_LE((momentumOf(scene, runner.velocities()) - before).norm(), 1e-5 * test::massOf(scene) * 0.67);
}

TEST(Split, GainsTheMomentumOfGravity) {
    Scene scene = spinningBlock({0, 0, 0});
    scene.gravity = {0, -9.81f, 0};
    test::Runner runner(scene, {.substeps = 10});
    runner.run(60);
    const double time = 1 - double{frame} / 10 / 2; // v is half a substep behind
    const Vector3d expected = test::massOf(scene) * time * test::toVector(scene.gravity);
    EXPECT_LE((momentumOf(scene, runner.velocities()) - expected).norm(), 1e-5 * expected.norm());
}

TEST_P(Physics, DampingSlowsAFreeParticleExponentially) {
    Scene scene = test::particleAt({0, 0, 0}, {3, 0, 0});
    scene.gravity = {0, 0, 0};
    scene.damping = 1.5f;
    test::Runner runner(scene, {.solver = GetParam(), .substeps = 10});
    runner.run(60);
    EXPECT_NEAR(runner.velocities()[0].x() / (3 * std::exp(-1.5)), 1, 1e-4);
}

INSTANTIATE_TEST_SUITE_P(Of, Physics, testing::Values(Solver::jacobi, Solver::split),
                         [](const auto& parameter) { return solverName(parameter.param); });
