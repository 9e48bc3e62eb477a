// Cases 3, 4, 5 and 15: one spring that hangs, vibrates or swings.
#include "cases/cases.hpp"
#include "sim/reference/trajectory.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <cstdio>
#include <numbers>
#include <optional>

using namespace sinew;
using namespace sinew::sim;
using namespace sinew::test;
using Eigen::Vector3d;

namespace {

constexpr float frame = 1.0f / 60;

class Case03HangingSpring : public SolverCase {};
class Case05Pendulum : public SolverCase {};

// A particle of 10 g on a spring that hangs along -y from a fixed particle at the origin.
Scene hangingSpring(float compliance, float restLength) {
    Scene scene{.name = "hanging spring"};
    scene.particles = {{.inverseMass = 1}, {.position = {0, -restLength, 0}, .inverseMass = 100}};
    scene.distances = {{0, 1, restLength, compliance}};
    scene.fixed = {{0}};
    return scene;
}

// Two free masses of 1 and 0.5 kg on a spring along x that is stretched by 0.02 m; omega = 16 rad/s. A step
// has one substep, so that every state can be read.
constexpr double omega = 16, amplitude = 0.02;
Scene vibratingPair(double omegaH) {
    Scene scene{.name = "vibrating pair", .dt = static_cast<float>(omegaH / omega)};
    scene.gravity = {0, 0, 0};
    const float compliance = static_cast<float>(3 / (omega * omega)); // 1 / (omega^2 mu), mu = 1/3 kg
    scene.particles = {{.position = {-0.04f, 0, 0}, .inverseMass = 1},
                       {.position = {0.08f, 0, 0}, .inverseMass = 2}};
    scene.distances = {{0, 1, 0.1f, compliance}};
    return scene;
}

// Progress of a mode in one substep: phase [rad] and factor of its amplitude.
struct Advance {
    double phase, factor;
};

// The theta form has z^2 - (2 - s (1 + theta)) z + (1 - s theta) = 0. The other solvers, with one spring, are
// implicit Euler.
Advance predictedAdvance(const Settings& settings, double omegaH) {
    const double s = omegaH * omegaH, theta = double{settings.theta};
    if (settings.solver != Solver::split) return {std::atan(omegaH), 1 / std::sqrt(1 + s)};
    const double factor = std::sqrt(1 - s * theta);
    return {std::acos((2 - s * (1 + theta)) / (2 * factor)), factor};
}

// Measures the phase by zero crossings, and the factor by a fit of x_n+1 = 2 r cos(phi) x_n - r^2 x_n-1.
Advance measuredAdvance(const Settings& settings, double omegaH, double periods) {
    const Scene scene = vibratingPair(omegaH);
    CaseRunner runner(scene, settings);
    Crossings crossings;
    std::vector<Eigen::RowVector2d> before;
    std::vector<double> after;
    double last = amplitude, now = amplitude;
    for (int step = 1; step <= static_cast<int>(periods * 2 * std::numbers::pi / omegaH); ++step) {
        runner.run(1);
        const auto x = runner.positions();
        const double next = (x[1] - x[0]).norm() - double{0.1f};
        crossings.add(step, next);
        if (step > 2) {
            before.emplace_back(now, -last);
            after.push_back(next);
        }
        last = std::exchange(now, next);
    }
    Eigen::MatrixX2d matrix(before.size(), 2);
    for (std::size_t n = 0; n < before.size(); ++n) matrix.row(static_cast<Eigen::Index>(n)) = before[n];
    const Eigen::Map<const Eigen::VectorXd> right(after.data(), static_cast<Eigen::Index>(after.size()));
    const Eigen::Vector2d fit = (matrix.transpose() * matrix).inverse() * matrix.transpose() * right;
    return {2 * std::numbers::pi / crossings.period(), std::sqrt(fit[1])};
}

void expectToVibrateAsPredicted(const Settings& settings, double omegaH, double periods) {
    const std::string name = std::string(solverName(settings.solver)) + " theta " +
                             std::to_string(settings.theta) + ", omega h " + std::to_string(omegaH);
    SCOPED_TRACE(name);
    const Advance predicted = predictedAdvance(settings, omegaH);
    const Advance measured = measuredAdvance(settings, omegaH, periods);
    expectWithin("frequency: " + name, measured.phase, predicted.phase, 0.005);
    EXPECT_NEAR(measured.factor, predicted.factor, 0.005 * (1 - predicted.factor) + 1e-5);
    if (settings.solver == Solver::split && settings.theta == 0 && omegaH < 0.3) {
        expectWithin("frequency, of exact: " + name, measured.phase, omegaH, 0.004);
    }
}

} // namespace

TEST_P(Case03HangingSpring, StretchesByItsLoadForAnySubstep) {
    constexpr double k = 100, mass = 0.01, gravity = 98.1; // `split` clamps k at one and two substeps
    Scene scene = hangingSpring(static_cast<float>(1 / k), 0.01f);
    scene.gravity = {0, -98.1f, 0};
    scene.damping = 20;
    for (const std::uint32_t substeps : {1u, 2u, 4u, 16u, 64u}) {
        const Settings settings{.solver = GetParam(), .substeps = substeps, .omega = 1, .theta = 0};
        // XPBD is exact for one spring; `split` has the clamped stiffness.
        const double effective =
            GetParam() == Solver::split ? reachedStiffness(scene, settings, double{frame} / substeps, 0) : k;
        CaseRunner runner(scene, settings);
        runner.run(75); // the initial oscillation has decayed to exp(-12.5)
        const double stretch = -runner.positions()[1].y() - double{0.01f};
        expectWithin("stretch, " + std::to_string(substeps) + " substeps", stretch,
                     mass * gravity / effective, 1e-4);
    }
}

TEST(Case04HarmonicSpring, VibratesAsItsSolverPredicts) {
    for (const double omegaH : {0.1, 0.25, 0.6}) {
        for (const float theta : {0.0f, 0.1f, 1.0f}) {
            const Settings settings{
                .solver = Solver::split, .substeps = 1, .omega = theta == 1 ? 1.3f : 2, .theta = theta};
            ASSERT_TRUE(isUnclamped(vibratingPair(omegaH), settings));
            expectToVibrateAsPredicted(settings, omegaH, theta == 1 ? 4 : 10);
        }
        // One sweep solves one spring exactly, warm or cold.
        for (const Solver solver : {Solver::jacobi, Solver::gaussSeidel})
            expectToVibrateAsPredicted({.solver = solver, .substeps = 1}, omegaH, 4);
    }
}

// Leapfrog gives exactly x_n = A cos(2 n asin(omega h / 2)) with constant amplitude.
TEST(Case04HarmonicSpring, FollowsLeapfrogToTheStep) {
    constexpr double k = 100, mass = 0.01;
    Scene scene = hangingSpring(static_cast<float>(1 / k), 0.1f);
    scene.gravity = {0, 0, 0};
    scene.particles[1].position.y -= static_cast<float>(amplitude);
    const Settings settings{.substeps = 8, .omega = 2, .theta = 0};
    const double phase = 2 * std::asin(std::sqrt(k / mass) * double{frame} / settings.substeps / 2);
    CaseRunner runner(scene, settings);
    for (int step = 1; step <= 120; ++step) {
        runner.step(frame);
        const double stretch = -runner.positions()[1].y() - 0.1;
        ASSERT_NEAR(stretch, amplitude * std::cos(phase * settings.substeps * step), 2e-3 * amplitude)
            << step;
    }
}

// `split` clamps every rigid link, so it runs at theta 0.05. At theta 0 the link's own vibration, excited by
// float32 rounding, is never damped and scatters the tension by 3 %.
TEST_P(Case05Pendulum, SwingsWithThePeriodAndTheTensionOfARigidOne) {
    constexpr double length = 1, mass = 1, gravity = double{9.81f}, angle = std::numbers::pi / 3;
    Scene scene{.name = "pendulum"};
    scene.particles = {{}, {}};
    scene.distances = {{0, 1, static_cast<float>(length), 0}};
    scene.fixed = {{0}};
    const bool isSplit = GetParam() == Solver::split;
    const Settings settings{.solver = GetParam(), .substeps = isSplit ? 10u : 64u, .theta = 0.05f};
    const double h = double{frame} / settings.substeps, lag = isSplit ? h / 2 : 0; // of the velocity
    // The pendulum starts with its static stretch, or the link would vibrate first.
    const double stretch = mass * gravity * std::cos(angle) / reachedStiffness(scene, settings, h, 0);
    const double start = length + (isSplit ? stretch : 0);
    scene.particles[1].position = {static_cast<float>(start * std::sin(angle)),
                                   static_cast<float>(-start * std::cos(angle)), 0};

    CaseRunner runner(scene, settings);
    Crossings crossings;
    double worstTension = 0, worstLength = 0;
    auto x = runner.positions(), v = runner.velocities();
    for (int step = 1; crossings.count() < 3 && step < 200; ++step) {
        runner.step(frame);
        const auto xAfter = runner.positions(), vAfter = runner.velocities();
        crossings.add(step * double{frame}, xAfter[1].x());
        worstLength = std::max(worstLength, std::abs(xAfter[1].norm() - length));
        const Vector3d middle = (x[1] + xAfter[1]) / 2 - lag * vAfter[1];
        const double cosine = -middle.normalized().y();
        // `jacobi` loses energy like implicit Euler, so the expected tension is that of its remaining swing.
        const double speed = (v[1] + vAfter[1]).norm() / 2;
        const double highest = isSplit ? std::cos(angle) : cosine - speed * speed / (2 * gravity * length);
        const double tension = mass * gravity * (3 * cosine - 2 * highest);
        const Vector3d force = mass * ((vAfter[1] - v[1]) / double{frame} - toVector(scene.gravity));
        if (step > 1)
            worstTension = std::max(worstTension, std::abs(-force.dot(middle.normalized()) / tension - 1));
        x = xAfter;
        v = vAfter;
    }
    ASSERT_EQ(crossings.count(), 3u);
    const double period = 4 * std::sqrt(length / gravity) * std::comp_ellint_1(std::sin(angle / 2));
    expectWithin("period", crossings.period(), period, 0.002);
    RecordProperty("tension", std::to_string(worstTension));
    RecordProperty("length", std::to_string(worstLength));
    EXPECT_LE(worstTension, 0.01);
    EXPECT_LE(worstLength, 1e-4 * length);
}

namespace {

// A free block, stretched by 3 % along x and compressed across.
Scene stretchedBlock() {
    Scene scene = block(3, 0.1f, 1e5f);
    scene.gravity = {0, 0, 0};
    for (Particle& particle : scene.particles) {
        particle.position.x *= 1.03f;
        particle.position.y *= 0.99f;
        particle.position.z *= 0.99f;
    }
    return scene;
}

// Frames until half of the initial energy is left, interpolated; 0 if the list ends earlier.
double halfLifeIn(const std::vector<double>& energies) {
    for (std::size_t f = 1; f < energies.size(); ++f) {
        const double now = energies[f] / energies[0], before = energies[f - 1] / energies[0];
        if (now <= 0.5) return static_cast<double>(f) - (0.5 - now) / (before - now);
    }
    return 0;
}

// Energies after each frame if links resist stretching with the coefficient dampingTime x stiffness. To first
// order, this equals a force evaluated dampingTime later. The reference uses far shorter steps than the
// device.
std::vector<double> energiesWithDamping(const Scene& scene, double dampingTime, int frames) {
    reference::State state = reference::initialState(scene);
    std::vector<double> energies{reference::energy(scene, state).total()};
    constexpr int steps = 500; // per frame
    const double h = double{frame} / steps;
    for (int f = 0; f < frames; ++f) {
        for (int step = 0; step < steps; ++step) {
            for (const DistanceConstraint& c : scene.distances) {
                const Vector3d d = state.x[c.b] - state.x[c.a], n = d.normalized();
                const double stretching = n.dot(state.v[c.b] - state.v[c.a]);
                const Vector3d impulse = h * dampingTime * stretching / double{c.compliance} * n;
                state.v[c.a] += double{scene.particles[c.a].inverseMass} * impulse;
                state.v[c.b] -= double{scene.particles[c.b].inverseMass} * impulse;
            }
            reference::stepVerlet(scene, h, 1, state);
        }
        energies.push_back(reference::energy(scene, state).total());
    }
    return energies;
}

} // namespace

// Checks the drift of a free block's energy, relative to its largest kinetic energy.
TEST(Case15Energy, OfAFreeVibrationStaysForTenSeconds) {
    const Scene scene = stretchedBlock();
    const Settings settings{.substeps = 16, .theta = 0};
    ASSERT_TRUE(isUnclamped(scene, settings));
    const double h = double{frame} / settings.substeps;
    CaseRunner runner(scene, settings);
    const double before = reference::energy(scene, reference::initialState(scene)).total();
    double worst = 0, mostKinetic = 0;
    for (int step = 0; step < 600; ++step) {
        runner.step(frame);
        reference::State state{runner.positions(), runner.velocities(), 0};
        reference::State late = state; // v is half a substep behind x, late.x - x = h (v + h/2 a)
        reference::stepVerlet(scene, h, 1, late);
        for (std::size_t i = 0; i < state.x.size(); ++i) state.v[i] = (late.x[i] - state.x[i]) / h;
        const reference::Energy now = reference::energy(scene, state);
        mostKinetic = std::max(mostKinetic, now.kinetic);
        worst = std::max(worst, std::abs(now.total() - before));
    }
    RecordProperty("drift", std::to_string(worst / mostKinetic));
    EXPECT_LE(worst, 0.01 * mostKinetic);
}

// Solvers in PBD order damp every mode at the rate omega^2 h, like link damping with dampingTime h. A warm
// start changes only how well a sweep solves the equations.
TEST(Case15Energy, OfAFreeVibrationHalvesInThePredictedTimeWhereASolverDamps) {
    const Scene scene = stretchedBlock();
    std::vector<double> predicted;
    for (const Solver solver : {Solver::jacobi, Solver::gaussSeidel}) {
        SCOPED_TRACE(solverName(solver));
        const Settings settings = accurate(solver, 100);
        CaseRunner runner(scene, settings);
        std::vector<double> energies{reference::energy(scene, reference::initialState(scene)).total()};
        while (energies.back() > 0.4 * energies.front() && energies.size() < 200) {
            runner.step(frame);
            energies.push_back(
                reference::energy(scene, {.x = runner.positions(), .v = runner.velocities()}).total());
        }
        if (predicted.empty()) predicted = energiesWithDamping(scene, double{frame} / settings.substeps, 40);
        ASSERT_GT(halfLifeIn(predicted), 0);
        std::printf("case 15 %s: half-life %.2f frames, predicted %.2f\n", solverName(solver),
                    halfLifeIn(energies), halfLifeIn(predicted));
        expectWithin(std::string("half-life of a block: ") + solverName(solver), halfLifeIn(energies),
                     halfLifeIn(predicted), 0.05);
    }
}

// Energy halves in ln 2 / (theta omega^2 h) under `split`, and in ln 2 / (omega^2 h) under the implicit Euler
// of one spring.
TEST(Case15Energy, HalvesInThePredictedTimeWhereASolverDamps) {
    constexpr double omegaH = 0.08; // s = 0.0064
    const Scene scene = vibratingPair(omegaH);
    const double h = double{scene.dt};
    for (const Settings& settings :
         {Settings{.solver = Solver::split, .substeps = 1, .theta = 0.1f},
          Settings{.solver = Solver::split, .substeps = 1, .omega = 1.3f, .theta = 1},
          Settings{.solver = Solver::jacobi, .substeps = 1},
          Settings{.solver = Solver::gaussSeidel, .substeps = 1}}) {
        const double theta = settings.solver == Solver::split ? double{settings.theta} : 1;
        const double predicted = std::numbers::ln2 / (theta * omega * omega * h);
        CaseRunner runner(scene, settings);
        // Fits twice the slope of the logarithm of the amplitude, sampled where the spring is longest.
        std::optional<std::pair<double, double>> first;
        std::pair<double, double> last;
        double before = 0, now = 0;
        for (int step = 1; step * h < std::min(5.0, 4 * predicted); ++step) {
            runner.run(1);
            const auto x = runner.positions();
            const double next = (x[1] - x[0]).norm() - double{0.1f};
            if (step > 2 && now > before && now > next) {
                // Peak of the parabola through three samples.
                const double bend = before - 2 * now + next, tilt = (next - before) / 2;
                last = {(step - 1 - tilt / bend) * h, now - tilt * tilt / (2 * bend)};
                if (!first) first = last;
            }
            before = std::exchange(now, next);
        }
        ASSERT_TRUE(first);
        const double halfLife =
            std::numbers::ln2 * (last.first - first->first) / (2 * std::log(first->second / last.second));
        expectWithin(std::string("half-life: ") + solverName(settings.solver) + " " + std::to_string(theta),
                     halfLife, predicted, 0.05);
    }
}

INSTANTIATE_TEST_SUITE_P(Of, Case03HangingSpring, testing::ValuesIn(caseSolvers), solverOf);
INSTANTIATE_TEST_SUITE_P(Of, Case05Pendulum, testing::ValuesIn(caseSolvers), solverOf);
