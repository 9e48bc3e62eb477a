// Cases 11 and 19 for bodies with cell volumes: they have the requested modulus and Poisson ratio, and keep
// their volume under pressure. Only `split` supports cell volumes; for the other solvers, the cases press a
// lattice of links.
#include "cases/cases.hpp"
#include "sim/reference/cells.hpp"
#include "sim/reference/elasticity.hpp"
#include "sim/reference/implicit_step.hpp"
#include "sinew/bodies.hpp"

#include <algorithm>
#include <cstdio>
#include <numbers>

using namespace sinew;
using namespace sinew::sim;
using namespace sinew::test;
using Eigen::Vector3d;

namespace {

constexpr double cell = Solid::cell, density = Solid::density, frame = double{1.0f / 60};
class Case11Volumes : public testing::TestWithParam<float> {}; // by Poisson ratio
class Case19Compression : public testing::TestWithParam<float> {};
class Case19Lattice : public SolverCase {};

// Cells that a wave of speed sqrt(E / rho) crosses in a substep with full stiffness. Beside the links, cells
// use lambda_v / mu / 3 of the links' part of a particle's mass, and some more for the change of shape.
// Measured on bars 3 to 8 cells wide, links and cells have full stiffness up to 0.373 at Poisson ratio 0.25,
// 0.32 at 0.35, 0.20 at 0.45 (links alone to 0.23) and 0.097 at 0.49 (links alone to 0.12). The cases use
// about half of that, because compression lowers the limits.
double cellsPerSubstep(double poissonRatio) {
    const double ratio = 2 * poissonRatio / (1 - 2 * poissonRatio) - 1;
    return ratio > 0 ? 0.21 / std::sqrt(1 + ratio / 3) : 0.26;
}

double waveSpeed(float poissonRatio, std::uint32_t substeps) {
    return cellsPerSubstep(double{poissonRatio}) * cell * substeps / frame;
}

Settings settingsOf(std::uint32_t substeps) {
    return {.substeps = substeps, .omega = 2, .theta = 0};
}

std::string percent(const testing::TestParamInfo<float>& ratio) {
    return std::to_string(std::lround(100 * ratio.param));
}

double volumeOf(const Solid& body, const std::vector<Vector3d>& x) {
    Scene withVolumes = body.scene;
    withVolumes.grids[0].recoveryPressure = 1; // cells of a plain lattice would be omitted without it
    double sum = 0, count = 0;
    for (const reference::Cell& each : reference::cellsOf(withVolumes)) {
        sum += reference::volumeRatio(each, reference::cornersOf(each, x));
        ++count;
    }
    return sum / count;
}

} // namespace

// A bar that hangs from its upper end. Compares the stress by the weight below with the strain of the layers
// in the middle third.
TEST_P(Case11Volumes, GiveTheModulusAndThePoissonRatioAskedFor) {
    constexpr std::uint32_t width = 4, height = 16, substeps = 32, low = 6, high = 10;
    Solid body = makeSolid("bar", {width, height, width}, waveSpeed(GetParam(), substeps), GetParam());
    body.fix({0, height, 0}, {width, height, width});
    const double length = height * cell, gravity = 0.002 * body.speed * body.speed / (length / 2);
    body.scene.gravity = {0, static_cast<float>(-gravity), 0};
    const double slowest = std::numbers::pi / 2 * body.speed / length;
    body.scene.damping = static_cast<float>(2 * slowest);
    ASSERT_TRUE(isUnclamped(body.scene, settingsOf(substeps)));
    CaseRunner runner(body.scene, settingsOf(substeps));
    runner.run(static_cast<int>(16 / slowest / frame));

    const auto measure = [&](const std::string& how, const std::vector<Vector3d>& x) {
        const double strain = (body.mean(x, {0, high, 0}, {width, high, width}).y() -
                               body.mean(x, {0, low, 0}, {width, low, width}).y()) /
                                  ((high - low) * cell) -
                              1;
        const double thinning = 1 - (body.mean(x, {width, low, 0}, {width, high, width}).x() -
                                     body.mean(x, {0, low, 0}, {0, high, width}).x()) /
                                        (width * cell);
        const double stress = density * gravity * (low + high) / 2 * cell;
        expectWithin("Young's modulus, " + how, stress / strain / body.modulus(), 1, 0.01);
        RecordProperty("Poisson's ratio, " + how, std::to_string(thinning / strain));
        EXPECT_NEAR(thinning / strain, double{GetParam()}, 0.01) << how;
    };
    measure("device", runner.positions());
    measure("equilibrium in double", reference::staticEquilibrium(body.scene).x);
}

// Volume ratio of a bar pressed by `strain` of its height between two planes without friction.
namespace {

double volumeWhenPressed(float poissonRatio, double strain, Solver solver = Solver::split) {
    constexpr std::uint32_t width = 3, height = 6, substeps = 32;
    const Settings settings = accurate(solver, substeps);
    // The other solvers have full stiffness only with short substeps, like in cases 9 to 12.
    const double speed =
        solver == Solver::split ? waveSpeed(poissonRatio, substeps) : 0.18 * cell * substeps / frame;
    Solid body = makeSolid("pressed bar", {width, height, width}, speed, poissonRatio);
    const auto half = static_cast<float>((1 - strain) * height * cell / 2);
    for (Particle& particle : body.scene.particles) particle.position.y *= static_cast<float>(1 - strain);
    body.scene.planes = {{.normal = {0, 1, 0}, .offset = -half}, {.normal = {0, -1, 0}, .offset = -half}};
    const double slowest = std::numbers::pi / 2 * body.speed / (height * cell);
    body.scene.damping = static_cast<float>(2 * slowest);
    EXPECT_TRUE(isUnclamped(body.scene, settings));
    CaseRunner runner(body.scene, settings);
    runner.run(static_cast<int>(20 / slowest / frame));
    const auto x = runner.positions();
    EXPECT_NEAR(body.mean(x, {0, height, 0}, {width, height, width}).y(), double{half}, 1e-3 * cell);
    return volumeOf(body, x);
}

} // namespace

TEST_P(Case19Compression, ChangesTheVolumeByOneMinusTwoNuTimesTheStrain) {
    constexpr double strain = 0.01;
    const double change = 1 - volumeWhenPressed(GetParam(), strain),
                 expected = (1 - 2 * double{GetParam()}) * strain;
    RecordProperty("change", std::to_string(change));
    EXPECT_NEAR(change, expected, 0.05 * expected);
}

// A lattice of links alone loses half of the strain as volume, even with links of full stiffness.
TEST_P(Case19Lattice, LosesHalfOfTheStrainOfItsVolume) {
    constexpr double strain = 0.01;
    const double change = 1 - volumeWhenPressed(0.25f, strain, GetParam());
    std::printf("case 19 %s: %.4g %% of the volume lost\n", solverName(GetParam()), 100 * change);
    EXPECT_NEAR(change, strain / 2, 0.05 * strain / 2);
}

namespace {

// Volume of the affine state of least energy: the material's own answer to this strain, without a solver.
double leastEnergyVolume(float poissonRatio, double strain) {
    const Solid body = makeSolid("pressed bar", {3, 6, 3}, waveSpeed(poissonRatio, 1), poissonRatio);
    const reference::Problem problem(body.scene);
    const auto rest = reference::initialState(body.scene).x;
    const auto energy = [&](double across) {
        auto x = rest;
        for (Vector3d& position : x) position = position.cwiseProduct(Vector3d(across, 1 - strain, across));
        return reference::elasticEnergy(problem, x);
    };
    double low = 1, high = 1.2; // golden section search
    while (high - low > 1e-7) {
        const double third = 0.381966 * (high - low);
        if (energy(low + third) < energy(high - third)) {
            high -= third;
        } else {
            low += third;
        }
    }
    return (1 - strain) * low * low;
}

} // namespace

// At the largest Poisson ratio, the volume changes by at most 0.5 % up to a compression of 15 %. At 20 % it
// loses 0.64 %, because links yield more than Hooke's law.
TEST(Case19Volumes, KeepTheVolumeOfABarThatIsPressedHard) {
    for (const double strain : {0.15, 0.2}) {
        const double change = 1 - volumeWhenPressed(0.49f, strain),
                     expected = 1 - leastEnergyVolume(0.49f, strain);
        testing::Test::RecordProperty("change at " + std::to_string(strain), std::to_string(change));
        EXPECT_NEAR(change, expected, 0.05 * expected) << strain;
        EXPECT_LE(change, strain < 0.2 ? 0.005 : 0.0065) << strain;
    }
}

INSTANTIATE_TEST_SUITE_P(Of, Case11Volumes, testing::Values(0.25f, 0.35f, 0.45f, 0.49f), percent);
INSTANTIATE_TEST_SUITE_P(Of, Case19Compression, testing::Values(0.25f, 0.45f), percent);
INSTANTIATE_TEST_SUITE_P(Of, Case19Lattice, testing::Values(Solver::jacobi, Solver::gaussSeidel), solverOf);
