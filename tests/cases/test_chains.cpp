// Cases 6 to 8: chains that stretch, sag and swing.
#include "cases/cases.hpp"
#include "sim/model/coloring.hpp"

#include <algorithm>
#include <functional>
#include <numbers>

using namespace sinew;
using namespace sinew::sim;
using namespace sinew::test;

namespace {

constexpr float frame = 1.0f / 60;
constexpr double gravity = double{9.81f};

class Case07Catenary : public SolverCase {};
class Case08SwingingChain : public SolverCase {};

// A chain: `count` masses below each other, hanging from a fixed particle at the origin.
constexpr std::uint32_t count = 20;
constexpr double mass = 0.1, stiffness = 1000, spacing = 0.05;

// Extension at rest of 20 masses of 0.1 kg on springs of 1000 N/m [m].
double extensionOnDevice(const Settings& settings) {
    Scene scene = hangingChain(count, static_cast<float>(spacing), static_cast<float>(mass),
                               static_cast<float>(1 / stiffness));
    scene.damping = 7; // damps the slowest vibration, 7.8 rad/s, to 1e-6 in 4 s
    CaseRunner runner(scene, settings);
    runner.run(240);
    return -runner.positions().back().y() - count * spacing;
}

// Extension with the stiffness that each link reaches [m]. A solver in PBD order evaluates links after the
// displacement g h^2 by gravity, so the chain ends higher by g h^2.
double predictedExtension(const Settings& settings) {
    const Scene scene = hangingChain(count, static_cast<float>(spacing), static_cast<float>(mass),
                                     static_cast<float>(1 / stiffness));
    const double h = double{frame} / settings.substeps;
    double sum = settings.solver == Solver::split ? 0 : -gravity * h * h;
    for (std::size_t c = 0; c < count; ++c)
        sum += static_cast<double>(count - c) * mass * gravity / reachedStiffness(scene, settings, h, c);
    return sum;
}

constexpr double exactExtension = mass * gravity * count * (count + 1) / 2 / stiffness;

// Root of an increasing function between low and high.
double rootOf(const std::function<double(double)>& function, double low, double high) {
    for (int halving = 0; halving < 100; ++halving)
        (function((low + high) / 2) < 0 ? low : high) = (low + high) / 2;
    return low;
}

} // namespace

TEST(Case06HangingChain, StretchesAsTheStiffnessOfSplitSays) {
    for (const std::uint32_t substeps : {2u, 8u, 32u}) { // two substeps are clamped
        const Settings settings = accurate(Solver::split, substeps);
        expectWithin("extension, " + std::to_string(substeps) + " substeps", extensionOnDevice(settings),
                     predictedExtension(settings), 1e-3);
    }
    EXPECT_GT(predictedExtension(accurate(Solver::split, 2)), 1.1 * exactExtension);
    EXPECT_NEAR(predictedExtension(accurate(Solver::split, 8)), exactExtension, 1e-6);
}

TEST(Case06HangingChain, StretchesExactlyAtTheDefaults) {
    expectWithin("extension", extensionOnDevice({}), exactExtension, 0.01);
}

TEST(Case06HangingChain, StretchesAsTheStiffnessOfJacobiSays) {
    const Settings settings = accurate(Solver::jacobi, 32);
    const double extension = extensionOnDevice(settings);
    expectWithin("extension", extension, predictedExtension(settings), 1e-3);
    expectWithin("extension, of exact", extension, exactExtension, 0.01);
}

// At rest, a link has the length that its own color gave it, until a later color moves its ends by h^2 w
// times the tension of the neighbour of that color. A cold sweep therefore leaves the chain longer by this
// amount for each neighbour in a later color.
TEST(Case06HangingChain, StretchesAsTheOrderOfColorsSaysWhereGaussSeidelStartsCold) {
    const Scene scene = hangingChain(count, static_cast<float>(spacing), static_cast<float>(mass),
                                     static_cast<float>(1 / stiffness));
    const Coloring coloring = colorByParticles(scene, inverseMasses(scene));
    std::vector<std::size_t> colorOf(count);
    for (std::size_t color = 0; color < coloring.colorCount(); ++color)
        for (const std::uint32_t link : coloring.color(color)) colorOf[link] = color;
    for (const std::uint32_t substeps : {8u, 32u}) {
        const Settings settings{.solver = Solver::gaussSeidel, .substeps = substeps, .warmStart = 0};
        const double h = double{frame} / substeps;
        double predicted = exactExtension;
        for (std::size_t c = 0; c < count; ++c)
            for (const std::size_t next : {c - 1, c + 1}) // for c = 0, c - 1 wraps around and is skipped
                if (next < count && colorOf[next] > colorOf[c])
                    predicted += h * h / mass * static_cast<double>(count - next) * mass * gravity;
        const double extension = extensionOnDevice(settings);
        expectWithin("extension, cold, " + std::to_string(substeps) + " substeps", extension, predicted,
                     1e-3);
    }
}

// The default warm start removes the error of the cold sweep.
TEST(Case06HangingChain, StretchesExactlyWhereGaussSeidelStartsWarm) {
    expectWithin("extension", extensionOnDevice({.solver = Solver::gaussSeidel, .substeps = 32}),
                 exactExtension, 0.01);
}

// Averaging halves the corrections of a particle with two links, but not those of the last particle, which
// has one link. Link c therefore carries m g h^2 (1 + 2 (N - c)).
TEST(Case06HangingChain, StretchesNearlyTwiceAsFarWhereJacobiAverages) {
    const Settings settings{.solver = Solver::jacobi, .substeps = 32};
    const double h = double{frame} / settings.substeps, alpha = 1 / (stiffness * h * h);
    double predicted = -gravity * h * h;
    for (std::size_t c = 1; c <= count; ++c) {
        const double load = mass * gravity * h * h * static_cast<double>(1 + 2 * (count - c));
        predicted += load * ((c == 1 ? 1 : 2) / mass + alpha);
    }
    const double extension = extensionOnDevice(settings);
    expectWithin("extension", extension, predicted, 1e-3);
    RecordProperty("of exact", std::to_string(extension / exactExtension));
}

// 64 rigid links with a total length of 6 m between two points 5 m apart; the start is a V.
TEST_P(Case07Catenary, SagsAsACoshDoes) {
    constexpr std::uint32_t links = 64;
    constexpr double length = 6, span = 5;
    const double depth = std::sqrt(length * length - span * span) / 2; // depth of the V
    Scene scene{.name = "catenary"};
    for (std::uint32_t i = 0; i <= links; ++i) {
        const double along = static_cast<double>(i) / links;
        scene.particles.push_back(
            {.position = {static_cast<float>(span * (along - 0.5)),
                          static_cast<float>(-2 * depth * std::min(along, 1 - along)), 0},
             .inverseMass = 20});
        if (i > 0) scene.distances.push_back({i - 1, i, static_cast<float>(length / links), 0});
    }
    scene.fixed = {{0}, {links}};
    scene.damping = 4;
    CaseRunner runner(scene, {.solver = GetParam(), .substeps = 64});
    runner.run(240);

    const double a = 1 / rootOf([](double b) { return 2 / b * std::sinh(span * b / 2) - length; }, 1e-3, 2);
    const double sag = a * (std::cosh(span / (2 * a)) - 1);
    expectWithin("sag", -runner.positions()[links / 2].y(), sag, 0.005);
    double speed = 0;
    for (const Eigen::Vector3d& v : runner.velocities()) speed = std::max(speed, v.norm());
    EXPECT_LE(speed, 0.01) << "not at rest yet";
}

// 40 rigid links with a total length of 4 m. The last particle has half the mass of the others because it
// stands for half a link. The start is the first mode, J0(j01 sqrt(z / L)), with z measured from the free
// end.
TEST_P(Case08SwingingChain, SwingsWithTheZeroOfABesselFunction) {
    constexpr std::uint32_t links = 40;
    constexpr double length = 4, zero = 2.404825557695773;
    Scene scene = hangingChain(links, static_cast<float>(length / links), 0.1f, 0);
    scene.particles.back().inverseMass *= 2;
    for (Particle& particle : scene.particles) {
        const double z = std::max(0.0, 1 + double{particle.position.y} / length);
        particle.position.x = static_cast<float>(0.05 * std::cyl_bessel_j(0, zero * std::sqrt(z)));
    }
    scene.particles[0].position.x = 0;
    CaseRunner runner(scene, {.solver = GetParam(), .substeps = 64});
    Crossings crossings;
    for (int step = 1; crossings.count() < 2 && step < 250; ++step) {
        runner.run(1);
        crossings.add(step * double{frame}, runner.positions().back().x());
    }
    ASSERT_EQ(crossings.count(), 2u);
    expectWithin("frequency", 2 * std::numbers::pi / crossings.period(),
                 zero / 2 * std::sqrt(gravity / length), 0.01);
}

INSTANTIATE_TEST_SUITE_P(Of, Case07Catenary, testing::ValuesIn(caseSolvers), solverOf);
INSTANTIATE_TEST_SUITE_P(Of, Case08SwingingChain, testing::ValuesIn(caseSolvers), solverOf);
