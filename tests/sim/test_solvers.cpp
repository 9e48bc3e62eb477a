// Compares steps on the device with the same steps in double (reference R3), to bound the error of float32
// and the GPU.
#include "sim/compile/compile.hpp"
#include "sim/constraints/agreement.hpp"
#include "sim/model/coloring.hpp"
#include "sim/scenes.hpp"
#include "sinew/bodies.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

using namespace sinew;
using namespace sinew::sim;

namespace {

constexpr float frame = 1.0f / 60;
constexpr std::uint32_t sizes[] = {1, 2, 63, 64, 65, 129};

// Largest difference after these steps, relative to the body's size; velocities count with their displacement
// in a frame.
double difference(const Scene& scene, const Settings& settings, const std::vector<float>& steps) {
    test::Runner runner(scene, settings);
    reference::State state = reference::initialState(scene);
    for (const float dt : steps) {
        runner.step(dt);
        test::stepReference(scene, settings, dt, state);
    }
    return test::differenceOf(runner, state, scene, frame);
}

Scene disturbed(Scene scene, bool isInRoom) {
    if (isInRoom) test::addRoom(scene);
    test::disturb(scene, 0.02f, 0.5f);
    scene.damping = 0.7f;
    return scene;
}

// A hub with 40 rigid spokes, free or fixed.
Scene star(bool isFixed) {
    Scene scene{.name = "star"};
    scene.particles.push_back({.position = {0, 1, 0}, .inverseMass = 0.1f});
    for (std::uint32_t i = 1; i <= 40; ++i) {
        const float angle = 0.157f * static_cast<float>(i);
        scene.particles.push_back({.position = {std::cos(angle), 1, std::sin(angle)}});
        scene.distances.push_back({i % 2 == 0 ? 0 : i, i % 2 == 0 ? i : 0, 1, 0});
    }
    if (isFixed) scene.fixed = {{0}};
    return scene;
}

// Bodies of all kinds and particles without links in one scene.
Scene mixture() {
    Scene scene = test::block(2, 0.1f, 1e5f);
    scene.particles.push_back({.position = {0.5f, 0.5f, 0.5f}});
    addCloth(scene, {.origin = {0, 0.6f, 0}, .size = {5, 4}, .spacing = 0.1f, .pinned = {0, 4}});
    addLattice(scene, {.origin = {1, 0, 0}, .cells = {1, 2, 3}, .spacing = 0.15f, .youngModulus = 1e4f});
    const auto first = static_cast<std::uint32_t>(scene.particles.size());
    for (std::uint32_t i = 0; i < 3; ++i) {
        scene.particles.push_back({.position = {0.2f * static_cast<float>(i), 1, 1}, .inverseMass = 3});
    }
    scene.distances.push_back({first + 1, first, 0.15f, 1e-3f});
    scene.name = "mixture";
    return scene;
}

std::vector<Settings> settingsOf(Solver solver) {
    if (solver == Solver::split) {
        return {{.substeps = 1, .omega = 1, .theta = 0},
                {.substeps = 4, .omega = 2, .theta = 0.1f},
                {.substeps = 5, .omega = 1.3f, .theta = 1}};
    }
    if (solver == Solver::gaussSeidel) {
        return {{.solver = solver, .substeps = 1, .iterations = 3, .warmStart = 0},
                {.solver = solver, .substeps = 4, .warmStart = 0},
                {.solver = solver, .substeps = 4},
                {.solver = solver, .substeps = 5, .iterations = 2, .warmStart = 0.6f}};
    }
    return {{.solver = solver, .substeps = 1, .iterations = 3},
            {.solver = solver, .substeps = 4, .iterations = 1, .overRelaxation = 1.3f},
            {.solver = solver, .substeps = 3, .iterations = 2, .weight = 0.2f}};
}

void expectOneStepAgrees(const Scene& scene, Solver solver) {
    for (const Settings& settings : settingsOf(solver)) {
        SCOPED_TRACE(scene.name + ", " + std::to_string(scene.planes.size()) + " planes, " +
                     solverName(solver) + ", " + std::to_string(settings.substeps) + " substeps");
        EXPECT_LE(difference(scene, settings, {frame}), 1e-5);
    }
}

class OneStep : public testing::TestWithParam<Solver> {};

} // namespace

TEST_P(OneStep, OfAChainOfAnySizeAgreesWithDouble) {
    for (const std::uint32_t size : sizes) {
        for (const bool isInRoom : {false, true}) {
            Scene scene = disturbed(test::chain(size, {1e-4f, true}), isInRoom);
            if (size > 2) scene.fixed = {{size / 2}};
            expectOneStepAgrees(scene, GetParam());
        }
    }
}

TEST_P(OneStep, OfARigidChainAgreesWithDouble) {
    expectOneStepAgrees(disturbed(test::chain(65), false), GetParam());
}

TEST_P(OneStep, OfASoftChainAgreesWithDouble) {
    expectOneStepAgrees(disturbed(test::chain(65, {1e-2f}), false), GetParam());
    expectOneStepAgrees(disturbed(test::chain(65, {1e9f}), true), GetParam());
}

TEST_P(OneStep, OfABlockAgreesWithDouble) {
    expectOneStepAgrees(disturbed(test::block(3, 0.1f, 1e5f), false), GetParam());
    expectOneStepAgrees(disturbed(test::block(4, 0.1f, 1e6f), true), GetParam());
}

TEST_P(OneStep, OfAPinnedSheetAgreesWithDouble) {
    expectOneStepAgrees(disturbed(test::sheet(8), false), GetParam());
    expectOneStepAgrees(disturbed(test::sheet(9, 1e-4f), true), GetParam());
}

TEST_P(OneStep, OfABlockOfUnequalLinksAgreesWithDouble) {
    for (const bool isInRoom : {false, true}) {
        Scene scene = disturbed(test::block(3, 0.1f, 1e5f), isInRoom);
        scene.grids.clear();
        for (std::size_t c = 0; c < scene.distances.size(); ++c) {
            scene.distances[c].restLength *= 1 + 0.0001f * static_cast<float>(c);
        }
        expectOneStepAgrees(scene, GetParam());
    }
}

TEST_P(OneStep, OfAStarAgreesWithDouble) {
    for (const bool isFixed : {false, true})
        expectOneStepAgrees(disturbed(star(isFixed), isFixed), GetParam());
}

TEST_P(OneStep, OfAMixtureOfBodiesAgreesWithDouble) {
    for (const bool isInRoom : {false, true}) expectOneStepAgrees(disturbed(mixture(), isInRoom), GetParam());
}

INSTANTIATE_TEST_SUITE_P(Of, OneStep, testing::Values(Solver::jacobi, Solver::split, Solver::gaussSeidel),
                         [](const auto& parameter) { return solverName(parameter.param); });

namespace {

class SeveralSteps : public testing::TestWithParam<Solver> {};

} // namespace

TEST_P(SeveralSteps, OfChangingLengthAgreeWithDouble) {
    const Settings settings{.solver = GetParam(), .substeps = 4};
    const std::vector<float> steps{frame, frame / 4, frame * 2};
    EXPECT_LE(difference(disturbed(test::block(3, 0.1f, 1e5f), false), settings, steps), 1e-5);
    EXPECT_LE(difference(disturbed(test::sheet(8, 1e-4f), true), settings, steps), 1e-5);
}

// Rounding is 1e-7 of the size a step. Colliding and rigidly linked particles amplify it over the steps by
// less than 100 here. (A warm start damps so little that the torn sheets amplify it by 1000; a difference of
// 1e-7 grows as much in double.)
TEST_P(SeveralSteps, KeepCloseToDouble) {
    const Settings settings{.solver = GetParam(), .substeps = 4, .warmStart = 0};
    // A sweep in colors rounds a position once a color, not once a substep.
    const std::vector<float> steps(GetParam() == Solver::gaussSeidel ? 8 : 16, frame);
    EXPECT_LE(difference(disturbed(test::block(3, 0.1f, 1e5f), false), settings, steps), 1e-5);
    EXPECT_LE(difference(disturbed(test::sheet(8, 1e-4f), false), settings, steps), 1e-5);
    EXPECT_LE(difference(disturbed(test::block(3, 0.1f, 1e5f), true), settings, steps), 1e-4);
    EXPECT_LE(difference(disturbed(test::sheet(8, 1e-4f), true), settings, steps), 1e-4);
}

TEST(WarmGaussSeidel, KeepsABlockCloseToDoubleForManySteps) {
    const Settings settings{.solver = Solver::gaussSeidel, .substeps = 4};
    const std::vector<float> steps(16, frame);
    EXPECT_LE(difference(disturbed(test::block(3, 0.1f, 1e5f), false), settings, steps), 1e-5);
    EXPECT_LE(difference(disturbed(test::block(3, 0.1f, 1e5f), true), settings, steps), 1e-4);
}

INSTANTIATE_TEST_SUITE_P(Of, SeveralSteps,
                         testing::Values(Solver::jacobi, Solver::split, Solver::gaussSeidel),
                         [](const auto& parameter) { return solverName(parameter.param); });
