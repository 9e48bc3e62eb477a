// Cases 9 to 12 and 22: voxel bodies bend, vibrate, stretch, shear and carry waves like an isotropic solid of
// Poisson ratio 1/4, for all numbers of substeps. Lengths are given in cells of 5 cm, times in the time that
// a wave needs to cross a cell.
#include "cases/cases.hpp"
#include "sim/reference/implicit_step.hpp"
#include "sinew/bodies.hpp"
#include "sinew/substeps.hpp"

#include <algorithm>
#include <numbers>

using namespace sinew;
using namespace sinew::sim;
using namespace sinew::test;
using Eigen::Vector3d;

namespace {

constexpr double cell = Solid::cell, density = Solid::density, frame = double{1.0f / 60};
constexpr double shearShare = 0.4; // G / E at Poisson ratio 1/4

class Case09Cantilever : public SolverCase {};
class Case10Cantilever : public SolverCase {};
class Case11Elasticity : public SolverCase {};
class Case12Wave : public SolverCase {};
class Case22Substeps : public SolverCase {};

// Cells that a wave crosses in a substep, c h / a, chosen so that the solver is accurate. `split` has full
// stiffness up to 7.2^-1/2 = 0.373, where 18 links of 0.4 (c h / a)^2 use all of a particle's mass. The limit
// is the same on faces and edges, because link stiffness and particle mass fall together there. Measured: no
// link is clamped up to 0.372, all are from 0.374. The other solvers come close only with short substeps.
double cellsPerSubstep(Solver solver) {
    return solver == Solver::split ? 0.26 : 0.18;
}

// Wave speed sqrt(E / rho) that gives cellsPerSubstep() [m/s].
double waveSpeed(Solver solver, std::uint32_t substeps) {
    return cellsPerSubstep(solver) * cell * substeps / frame;
}

// Share of Young's modulus that the solver reaches. Every link of a full lattice has k w_a = k w_b = 0.4 c^2
// / a^2, also on faces and edges, where k and mass fall together.
double reachedShare(Solver solver) {
    const double stepsPerCell = cellsPerSubstep(solver);
    return solver != Solver::jacobi ? 1 : 1 / (1 + 0.8 * stepsPerCell * stepsPerCell);
}

// A beam along x, clamped at its left end; its length is 12 heights.
struct Beam {
    Solid body;
    std::uint32_t height; // cells
    double speed;
    double h() const { return height * cell; }
    double length() const { return 12 * h(); }
    std::uint32_t links() const { return 12 * height; }                  // cells along x
    double bendingShare() const { return 1 + 0.95 / (height * height); } // of EI, from the lattice's layers
    // First angular frequency of an Euler-Bernoulli beam with the full modulus.
    double slowest() const {
        return 1.8751 * 1.8751 * std::sqrt(bendingShare() / 12) * speed * h() / (length() * length());
    }
    double tip(const std::vector<Vector3d>& x) const {
        return body.mean(x, {links(), 0, 0}, {links(), height, height}).y();
    }
};

constexpr std::uint32_t beamSubsteps = 200;

Beam makeBeam(Solver solver) {
    const std::uint32_t height = solver == Solver::split ? 3 : 2; // the other solvers are slower
    const double speed = waveSpeed(solver, beamSubsteps);
    Beam beam{makeSolid("cantilever", {12 * height, height, height}, speed), height, speed};
    beam.body.fix({0, 0, 0}, {0, height, height});
    return beam;
}

} // namespace

// Tests the limit given at cellsPerSubstep(), on faces and edges too.
TEST(FullLattice, ClampsAllItsLinksAtTheSameSubstep) {
    constexpr std::uint32_t substeps = 100;
    for (const std::array<std::uint32_t, 3> cells :
         {std::array{3u, 3u, 3u}, std::array{8u, 8u, 8u}, std::array{4u, 12u, 4u}})
        for (const double factor : {0.998, 1.003}) {
            const Settings settings = accurate(Solver::split, substeps);
            const Solid body = makeSolid("body", cells, factor / std::sqrt(7.2) * cell * substeps / frame);
            const std::size_t clamped = factor > 1 ? body.scene.distances.size() : 0;
            EXPECT_EQ(inspectStiffness(body.scene, settings).clamped, clamped);
            EXPECT_EQ(isUnclamped(body.scene, settings), clamped == 0);
        }
}

TEST_P(Case09Cantilever, SagsAsTimoshenkoSays) {
    Beam beam = makeBeam(GetParam());
    const double length = beam.length(), h = beam.h(), share = reachedShare(GetParam());
    // A load that bends the beam by 3 % of its length.
    const double gravity = 0.03 * beam.speed * beam.speed * h * h / (1.5 * length * length * length);
    beam.body.scene.gravity = {0, static_cast<float>(-gravity), 0};
    beam.body.scene.damping = static_cast<float>(2 * beam.slowest()); // critical damping
    const Settings settings = accurate(GetParam(), beamSubsteps);
    ASSERT_TRUE(isUnclamped(beam.body.scene, settings));
    CaseRunner runner(beam.body.scene, settings);
    runner.run(static_cast<int>(9 / beam.slowest() / frame)); // the error has decayed to 0.1 %
    const double sag = -beam.tip(runner.positions());

    const double q = density * gravity * h * h, modulus = share * density * beam.speed * beam.speed;
    const double bending =
        q * std::pow(length, 4) / (8 * modulus * beam.bendingShare() * std::pow(h, 4) / 12);
    const double kappa = 10 * 1.25 / (12 + 11 * 0.25);
    const double shear = q * length * length / (2 * kappa * shearShare * modulus * h * h);
    expectWithin("sag", sag, bending + shear, 0.03);
    EXPECT_LT(sag, 0.05 * length);
    if (GetParam() == Solver::split) {
        const double truth = -beam.tip(reference::staticEquilibrium(beam.body.scene).x);
        expectWithin("sag, of the equilibrium in double", sag, truth, 0.003);
    }
}

TEST_P(Case10Cantilever, VibratesWithItsFirstFrequency) {
    Beam beam = makeBeam(GetParam());
    constexpr double beta = 1.8751, sigma = 0.7341;
    const auto initialX = beam.body.initial();
    for (std::size_t i = 0; i < initialX.size(); ++i) {
        // Start in the first mode with 2 % of the length at the tip; cross sections stay plane.
        const double s = beta * (initialX[i].x() / beam.length() + 0.5), amplitude = 0.01 * beam.length();
        const double shape = std::cosh(s) - std::cos(s) - sigma * (std::sinh(s) - std::sin(s));
        const double slope = std::sinh(s) + std::sin(s) - sigma * (std::cosh(s) - std::cos(s));
        Vec3& position = beam.body.scene.particles[i].position;
        position.y += static_cast<float>(amplitude * shape);
        position.x -= static_cast<float>(amplitude * slope * beta / beam.length() * initialX[i].y());
    }
    const Settings settings = accurate(GetParam(), beamSubsteps);
    ASSERT_TRUE(isUnclamped(beam.body.scene, settings));
    CaseRunner runner(beam.body.scene, settings);
    Crossings crossings;
    for (int step = 1; crossings.count() < 2 && step < 200; ++step) {
        runner.run(1);
        crossings.add(step * frame, beam.tip(runner.positions()));
    }
    ASSERT_EQ(crossings.count(), 2u);
    const double predicted = std::sqrt(reachedShare(GetParam())) * beam.slowest();
    expectWithin("frequency", 2 * std::numbers::pi / crossings.period(), predicted, 0.03);
}

namespace {

struct Moduli {
    double young, poisson, shear; // E and C44 over the requested modulus
};

// A bar that hangs from its upper end. Compares the stress by the weight below with the strain of the layers
// in the middle third.
Moduli stretchBar(Solver solver, Moduli moduli) {
    constexpr std::uint32_t width = 4, height = 16, substeps = 16;
    const double speed = waveSpeed(solver, substeps);
    Solid body = makeSolid("bar", {width, height, width}, speed);
    body.fix({0, height, 0}, {width, height, width});
    const double length = height * cell,
                 gravity = 0.002 * speed * speed / (length / 2); // 0.2 % strain in the middle
    body.scene.gravity = {0, static_cast<float>(-gravity), 0};
    const double slowest = std::numbers::pi / 2 * speed / length;
    body.scene.damping = static_cast<float>(2 * slowest);
    const Settings settings = accurate(solver, substeps);
    EXPECT_TRUE(isUnclamped(body.scene, settings));
    CaseRunner runner(body.scene, settings);
    runner.run(static_cast<int>(16 / slowest / frame));
    const auto x = runner.positions();

    constexpr std::uint32_t low = 6, high = 10;
    const double strain = (body.mean(x, {0, high, 0}, {width, high, width}).y() -
                           body.mean(x, {0, low, 0}, {width, low, width}).y()) /
                              ((high - low) * cell) -
                          1;
    const double thinning = 1 - (body.mean(x, {width, low, 0}, {width, high, width}).x() -
                                 body.mean(x, {0, low, 0}, {0, high, width}).x()) /
                                    (width * cell);
    const double stress =
        density * gravity * (low + high) / 2 * cell; // the mean stress of the layers is that of their middle
    moduli.young = stress / strain / (density * speed * speed * reachedShare(solver));
    moduli.poisson = thinning / strain;
    return moduli;
}

// A slab fixed at its lower face and loaded along it. Layers in the middle of its length are in pure shear.
Moduli shearSlab(Solver solver, Moduli moduli) {
    constexpr std::uint32_t width = 32, height = 4, depth = 2, substeps = 16, middle = width / 2;
    const double speed = waveSpeed(solver, substeps);
    Solid body = makeSolid("slab", {width, height, depth}, speed);
    body.fix({0, 0, 0}, {width, 0, depth});
    const double thickness = height * cell, gravity = 0.002 * shearShare * speed * speed / (thickness / 2);
    body.scene.gravity = {static_cast<float>(gravity), 0, 0};
    const double slowest = std::numbers::pi / 2 * std::sqrt(shearShare) * speed / thickness;
    body.scene.damping = static_cast<float>(2 * slowest);
    const Settings settings = accurate(solver, substeps);
    EXPECT_TRUE(isUnclamped(body.scene, settings));
    CaseRunner runner(body.scene, settings);
    runner.run(static_cast<int>(16 / slowest / frame));
    const auto x = runner.positions(), before = body.initial();
    const auto shift = [&](std::uint32_t layer) {
        const std::array<std::uint32_t, 3> low{middle - 2, layer, 0}, high{middle + 2, layer, depth};
        return (body.mean(x, low, high) - body.mean(before, low, high)).x();
    };
    const double angle = (shift(3) - shift(1)) / (2 * cell);
    const double stress =
        density * gravity * 2 * cell; // half of the slab lies above the middle of those layers
    moduli.shear = stress / angle / (density * speed * speed * reachedShare(solver));
    return moduli;
}

} // namespace

TEST_P(Case11Elasticity, HasTheModulusAskedForPoissonRatioAQuarterAndNoDirection) {
    const Moduli moduli = shearSlab(GetParam(), stretchBar(GetParam(), {}));
    expectWithin("Young's modulus", moduli.young, 1, 0.01);
    expectWithin("Poisson's ratio", moduli.poisson, 0.25, 0.01 / 0.25);
    // C11 - C12 = E / (1 + nu)
    expectWithin("isotropy", 2 * moduli.shear * (1 + moduli.poisson) / moduli.young, 1, 0.02);
}

// A pulse with a standard deviation of 6 cells runs along a bar. Measures when its peak passes a section 80
// cells further.
TEST_P(Case12Wave, ArrivesAtTheSpeedOfSound) {
    constexpr std::uint32_t width = 2, length = 160, substeps = 4, probe = 120;
    const double speed = waveSpeed(GetParam(), substeps), sigma = 6 * cell, amplitude = 0.03 * cell;
    Solid body = makeSolid("long bar", {length, width, width}, speed);
    const double wave = std::sqrt(reachedShare(GetParam())) * speed;
    for (Particle& particle : body.scene.particles) {
        const double s = (double{particle.position.x} + 40 * cell) / sigma;
        const double shift = amplitude * std::exp(-s * s / 2), strain = -s / sigma * shift;
        particle.velocity.x = static_cast<float>(-wave * strain);
        particle.position.x += static_cast<float>(shift);
        particle.position.y *= static_cast<float>(1 - strain / 4);
        particle.position.z *= static_cast<float>(1 - strain / 4);
    }
    const Settings settings = accurate(GetParam(), substeps);
    ASSERT_TRUE(isUnclamped(body.scene, settings));
    CaseRunner runner(body.scene, settings);
    const double start = body.mean(makeSolid("long bar", {length, width, width}, speed).initial(),
                                   {probe, 0, 0}, {probe, width, width})
                             .x();
    double before = 0, now = 0, arrival = 0;
    for (int step = 1; arrival == 0 && step < 1000; ++step) {
        runner.run(1);
        const double next = body.mean(runner.positions(), {probe, 0, 0}, {probe, width, width}).x() - start;
        if (now > amplitude / 2 && next < now) { // peak of the parabola through three samples
            arrival = (step - 1 - (next - before) / 2 / (before - 2 * now + next)) * frame;
        }
        before = std::exchange(now, next);
    }
    expectWithin("arrival", arrival, 80 * cell / wave, 0.02);
}

// A cube held at one side, which sags by a few percent. It is soft enough for full stiffness with 16
// substeps.
TEST_P(Case22Substeps, DoNotChangeTheShapeAtRest) {
    constexpr double speed = 0.05 * cell * 16 / frame; // c h / a = 0.05 at 16 substeps
    std::vector<Vector3d> shapes[2];
    Solid body = makeSolid("cube", {3, 3, 3}, speed);
    const auto before = body.initial();
    body.fix({0, 0, 0}, {0, 3, 3});
    body.scene.gravity = {0, static_cast<float>(-0.02 * speed * speed / (3 * cell)), 0};
    const double slowest = 0.6 * speed / (3 * cell);
    body.scene.damping = static_cast<float>(2 * slowest);
    for (const std::size_t run : {0, 1}) {
        const Settings settings = accurate(GetParam(), run == 0 ? 16 : 128);
        ASSERT_TRUE(isUnclamped(body.scene, settings));
        CaseRunner runner(body.scene, settings);
        runner.run(static_cast<int>(10 / slowest / frame));
        shapes[run] = runner.positions();
    }
    double deflection = 0, difference = 0;
    for (std::size_t i = 0; i < before.size(); ++i) {
        deflection = std::max(deflection, (shapes[1][i] - before[i]).norm());
        difference = std::max(difference, (shapes[0][i] - shapes[1][i]).norm());
    }
    EXPECT_GT(deflection, 0.01 * 3 * cell);
    RecordProperty("difference by deflection", std::to_string(difference / deflection));
    EXPECT_LE(difference, 0.005 * deflection);
}

INSTANTIATE_TEST_SUITE_P(Of, Case09Cantilever, testing::ValuesIn(caseSolvers), solverOf);
INSTANTIATE_TEST_SUITE_P(Of, Case10Cantilever, testing::ValuesIn(caseSolvers), solverOf);
INSTANTIATE_TEST_SUITE_P(Of, Case11Elasticity, testing::ValuesIn(caseSolvers), solverOf);
INSTANTIATE_TEST_SUITE_P(Of, Case12Wave, testing::ValuesIn(caseSolvers), solverOf);
INSTANTIATE_TEST_SUITE_P(Of, Case22Substeps, testing::ValuesIn(caseSolvers), solverOf);
