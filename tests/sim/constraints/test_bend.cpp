// Tests of bends: stiffness in N m and N m^2, momentum, agreement with double.
#include "sim/compile/compile.hpp"
#include "sim/constraints/agreement.hpp"
#include "sim/runner.hpp"
#include "sim/scenes.hpp"
#include "sinew/bodies.hpp"
#include "sinew/substeps.hpp"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>

using namespace sinew;
using namespace sinew::sim;
using Eigen::Vector3d;

namespace {

class Bend : public testing::TestWithParam<Solver> {};

Scene bentSheet(std::uint32_t size, float compliance) {
    Scene scene{.name = "bent sheet of " + std::to_string(size)};
    addCloth(scene, {.origin = {0, 1, 0},
                     .size = {size, size},
                     .spacing = 0.1f,
                     .stretchCompliance = compliance,
                     .shearCompliance = 10 * compliance,
                     .bendingStiffness = 0.05f,
                     .pinned = {0, size - 1}});
    return scene;
}

// A clamped rod: a row of particles along x, the first two of them fixed.
Scene rod(std::uint32_t cells, float length, float weightPerLength, float stiffness) {
    Scene scene{.name = "rod"};
    const float spacing = length / static_cast<float>(cells);
    for (std::uint32_t i = 0; i <= cells; ++i) {
        const float share = i == cells ? 0.5f : 1;
        scene.particles.push_back({.position = {spacing * static_cast<float>(i), 0, 0},
                                   .inverseMass = 9.81f / (weightPerLength * spacing * share)});
        if (i > 0) scene.distances.push_back({i - 1, i, spacing, 1e-5f});
        if (i > 1) scene.bends.push_back({i - 2, i - 1, i, bendComplianceOfRod(stiffness, spacing)});
    }
    scene.fixed = {{0}, {1}};
    return scene;
}

} // namespace

TEST_P(Bend, StepsOfASheetAgreeWithDouble) {
    for (const bool isInRoom : {false, true}) {
        Scene scene = bentSheet(12, 1e-4f);
        if (isInRoom) test::addRoom(scene);
        test::disturb(scene, 0.02f, 0.5f);
        test::expectAgreement(scene, GetParam());
    }
}

TEST_P(Bend, StepsWithoutLinksAgreeWithDouble) {
    Scene scene = test::chain(130);
    scene.distances.clear();
    for (std::uint32_t i = 2; i < 130; ++i) scene.bends.push_back({i - 2, i - 1, i, i % 2 == 0 ? 0 : 1e-2f});
    test::disturb(scene, 0.02f, 0.5f);
    test::expectAgreement(scene, GetParam());
}

namespace {

// Sag of a clamped rod under its weight over that of the discrete rod. The ideal deflection q L^4 / (8 EI) is
// 4 cm. The clamp contains the first cell and takes part of it, which the sum over joints includes exactly.
double sagOfRod(std::uint32_t cells, const Settings& settings) {
    constexpr double length = 1, weight = 1, deflection = 0.04;
    const double stiffness = weight / (8 * deflection);
    Scene scene = rod(cells, length, weight, static_cast<float>(stiffness));
    scene.damping = 12;
    test::Runner runner(scene, settings);
    EXPECT_EQ(runner.run(100).nonFinite, 0u);
    // Exact sag of the discrete rod: the moment M of the weights turns each joint by M s / EI.
    double sag = 0;
    const double s = length / cells;
    for (std::uint32_t joint = 1; joint < cells; ++joint) {
        double moment = 0;
        for (std::uint32_t i = joint + 1; i <= cells; ++i)
            moment += weight * s * (i == cells ? 0.5 : 1) * (i - joint) * s;
        sag += moment * s / stiffness * (cells - joint) * s;
    }
    EXPECT_NEAR(sag / deflection, 1, cells >= 16 ? 0.15 : 0.3) << "the discrete rod is near the rod";
    return -runner.positions().back().y() / sag;
}

} // namespace

TEST(BendOfSplit, LetsAClampedRodSagAsItsStiffnessSays) {
    EXPECT_EQ(inspectStiffness(rod(16, 1, 1, 3.125f), {.substeps = 128}).soft, 0u);
    EXPECT_NEAR(sagOfRod(16, {.substeps = 128}), 1, 0.01);
}

// One sweep a substep adds a compliance of at most h^2 (w_a + 4 w_b + w_c). Reports count it, and short
// substeps remove it.
TEST(BendOfGaussSeidel, LetsAClampedRodSagAsItsStiffnessSaysInShortSubsteps) {
    const Settings coarse{.solver = Solver::gaussSeidel, .substeps = 32},
        fine{.solver = Solver::gaussSeidel, .substeps = 128};
    const double softest = inspectStiffness(rod(8, 1, 1, 3.125f), coarse).softest, sag = sagOfRod(8, coarse);
    EXPECT_GT(sag, 1.02);
    EXPECT_LE(sag, 1 / softest);
    EXPECT_NEAR(sagOfRod(8, fine), 1, 0.01);
}

TEST(BendOfSplit, KeepsMomentum) {
    Scene scene = bentSheet(8, 1e-4f);
    scene.fixed.clear();
    scene.gravity = {0, 0, 0};
    test::disturb(scene, 0.03f, 1);
    const auto momenta = [&](const test::Runner& runner) {
        const auto x = runner.positions(), v = runner.velocities();
        Eigen::Matrix<double, 6, 1> sum = Eigen::Matrix<double, 6, 1>::Zero();
        for (std::size_t i = 0; i < x.size(); ++i) {
            const double mass = 1 / double{scene.particles[i].inverseMass};
            sum.head<3>() += mass * v[i];
            sum.tail<3>() += mass * x[i].cross(v[i]);
        }
        return sum;
    };
    test::Runner runner(scene, {.substeps = 16, .theta = 0});
    const auto before = momenta(runner);
    runner.run(60);
    EXPECT_LE((momenta(runner) - before).norm(), 2e-5 * test::massOf(scene));
}

TEST(Bend, LeavesAFlatSheetFlat) {
    Scene scene = bentSheet(8, 0);
    scene.gravity = {0, 0, 0};
    test::Runner runner(scene, {.substeps = 8});
    const auto before = runner.positions();
    runner.run(30);
    double moved = 0;
    for (std::size_t i = 0; i < before.size(); ++i)
        moved = std::max(moved, (runner.positions()[i] - before[i]).norm());
    EXPECT_LE(moved, 1e-6);
}

TEST(Bend, IsInTheProgramOnlyWhereTheSceneHasOne) {
    const auto has = [](const Scene& scene, Solver solver) {
        return describe(compile(scene, {.solver = solver, .substeps = 2})).find("bends") != std::string::npos;
    };
    for (const Solver solver : {Solver::split, Solver::jacobi, Solver::gaussSeidel}) {
        EXPECT_TRUE(has(bentSheet(4, 0), solver));
        EXPECT_FALSE(has(test::sheet(4), solver));
    }
}

INSTANTIATE_TEST_SUITE_P(Of, Bend, testing::Values(Solver::jacobi, Solver::split, Solver::gaussSeidel),
                         [](const auto& parameter) { return solverName(parameter.param); });
