// Tests the double reference against hand-computed numbers and physical laws, so that other tests can use it
// as the truth.
#include "sim/reference/reference.hpp"
#include "sim/scenes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

using namespace sinew;
using namespace sinew::sim;
using Eigen::Vector3d;
using reference::State;

namespace {

constexpr double frame = 1.0 / 60;

using StepFunction = std::function<void(const Scene&, const Settings&, double, State&)>;

const std::vector<std::pair<const char*, StepFunction>> solvers{{"gauss_seidel", reference::stepGaussSeidel},
                                                                {"jacobi", reference::stepJacobi},
                                                                {"split", reference::stepSplit}};

State run(const StepFunction& step, const Scene& scene, const Settings& settings, int steps) {
    State state = reference::initialState(scene);
    for (int s = 0; s < steps; ++s) step(scene, settings, frame, state);
    return state;
}

// Three equal masses on the x axis at 0, 1.2 and 2.5 with rigid links of length 1, without gravity.
Scene stretchedTriple() {
    Scene scene;
    scene.gravity = {0, 0, 0};
    for (const float x : {0.0f, 1.2f, 2.5f}) scene.particles.push_back({.position = {x, 0, 0}});
    scene.distances = {{0, 1, 1, 0}, {1, 2, 1, 0}};
    return scene;
}

void expectOnAxis(const State& state, const std::vector<double>& expected) {
    for (std::size_t i = 0; i < expected.size(); ++i) {
        EXPECT_NEAR(state.x[i].x(), expected[i], 1e-7) << i; // the scene stores 1.2 as a float
        EXPECT_EQ(state.x[i].tail<2>().norm(), 0);
    }
}

Vector3d momentumOf(const Scene& scene, const State& state) {
    Vector3d sum = Vector3d::Zero();
    for (std::size_t i = 0; i < state.v.size(); ++i)
        sum += state.v[i] / double{scene.particles[i].inverseMass};
    return sum;
}

} // namespace

TEST(Reference, GaussSeidelSeesWhatTheConstraintBeforeDid) {
    // The first link moves 0 and 1 to 0.1 and 1.1. The second then has the length 1.4.
    const State state = run(reference::stepGaussSeidel, stretchedTriple(), {.substeps = 1}, 1);
    expectOnAxis(state, {0.1, 1.3, 2.3});
    EXPECT_NEAR(state.v[1].x(), 0.1 / frame, 1e-5);
}

TEST(Reference, GaussSeidelTakesConstraintsInTheOrderItIsGiven) {
    const std::vector<std::uint32_t> order{1, 0};
    reference::GaussSeidel solver(stretchedTriple(), {.substeps = 1}, order);
    State state = reference::initialState(stretchedTriple());
    solver.step(frame, state);
    expectOnAxis(state, {0.175, 1.175, 2.35});
}

// The first substep ends at 0.1, 1.3, 2.3 with multipliers -0.1 and -0.2, and moves on to 0.2, 1.4, 2.1.
// Rigid links keep at most 0.3 of a multiplier. That would move the ends of a link by more than a twentieth
// of its length, so both start at -0.025.
TEST(Reference, WarmGaussSeidelStartsFromGuardedMultipliers) {
    const auto after = [](float warmStart) {
        return run(reference::stepGaussSeidel, stretchedTriple(), {.substeps = 2, .warmStart = warmStart}, 1);
    };
    expectOnAxis(after(0), {0.3, 1.2, 2.2});
    expectOnAxis(after(0.9f), {0.3125, 1.19375, 2.19375});
    // A share of 0.1 stays below the guard: -0.01 and -0.02.
    expectOnAxis(after(0.1f), {0.31, 1.195, 2.195});
    EXPECT_NEAR(after(0.1f).multipliers[0].lambda, 0.1 * -0.11, 1e-7);
}

TEST(Reference, WarmGaussSeidelKeepsItsMultipliersFromStepToStep) {
    const Scene scene = stretchedTriple();
    const Settings whole{.substeps = 2}, half{.substeps = 1};
    State once = reference::initialState(scene), twice = once;
    reference::stepGaussSeidel(scene, whole, frame, once);
    reference::stepGaussSeidel(scene, half, frame / 2, twice);
    reference::stepGaussSeidel(scene, half, frame / 2, twice);
    expectOnAxis(twice, {once.x[0].x(), once.x[1].x(), once.x[2].x()});
}

TEST(Reference, JacobiAveragesWhatBothLinksWant) {
    const State state = run(reference::stepJacobi, stretchedTriple(), {.substeps = 1}, 1);
    expectOnAxis(state, {0.1, 1.225, 2.35});
    const Settings halved{.substeps = 1, .weight = 0.25f, .overRelaxation = 0.5f};
    expectOnAxis(run(reference::stepJacobi, stretchedTriple(), halved, 1), {0.0125, 1.20625, 2.48125});
}

TEST(Reference, SplitStartsWithHalfAClampedKick) {
    // kappa = omega / (2 n w) = 0.25 at the middle; the kick is half of 0.25 x 0.2 and of 0.25 x 0.3.
    const Settings settings{.substeps = 1, .omega = 1, .theta = 0};
    expectOnAxis(run(reference::stepSplit, stretchedTriple(), settings, 1), {0.025, 1.2125, 2.4625});
}

TEST(Reference, FallsExactly) {
    const Scene scene = test::particleAt({0.3f, 0, -2}, {1, 4, 0.5f});
    const Vector3d path = test::toVector(scene.particles[0].velocity) + 0.5 * test::toVector(scene.gravity);
    for (const auto& [name, step] : solvers) {
        const State state = run(step, scene, {.substeps = 7}, 60);
        EXPECT_LE((state.x[0] - test::toVector(scene.particles[0].position) - path).norm(),
                  1e-12 * path.norm())
            << name;
    }
}

// The static stretch is m g / k. XPBD, and jacobi with one link, are exact for any number of iterations.
TEST(Reference, HangsAsItsLoadSays) {
    Scene scene;
    scene.damping = 20;
    scene.particles = {{}, {.position = {0, -0.1f, 0}, .inverseMass = 100}};
    scene.distances = {{0, 1, 0.1f, 1.0f / 128}};
    scene.fixed = {{0}};
    for (const auto& [name, step] : solvers) {
        for (const std::uint32_t iterations : {1u, 5u}) {
            const State state = run(step, scene, {.substeps = 8, .iterations = iterations}, 240);
            const double load = 0.01 * double{9.81f} / 128;
            EXPECT_NEAR((-state.x[1].y() - double{0.1f}) / load, 1, 1e-9) << name << ' ' << iterations;
            EXPECT_EQ(state.x[0], Vector3d::Zero());
        }
    }
}

TEST(Reference, KeepsMomentumWhereItsMethodDoes) {
    Scene scene = test::block(2, 0.1f, 1e5f);
    test::disturb(scene, 0.02f, 1);
    scene.gravity = {0, 0, 0};
    const Vector3d before = momentumOf(scene, reference::initialState(scene));
    for (const auto& [name, step] : solvers) {
        const State state = run(step, scene, {.substeps = 8}, 30);
        const double drift = (momentumOf(scene, state) - before).norm() / test::massOf(scene);
        if (std::string(name) == "jacobi") {
            EXPECT_GT(drift, 1e-6) << "averaging breaks Newton's third law where n_i != n_j";
        } else {
            EXPECT_LE(drift, 1e-13) << name;
        }
    }
}

TEST(Reference, SticksBelowTheFrictionAngleAndSlidesAbove) {
    for (const auto& [name, step] : solvers) {
        for (const double degrees : {26.0, 28.0}) { // friction 0.5 holds up to 26.57 degrees
            const double angle = degrees * std::numbers::pi / 180;
            Scene scene = test::particleAt({0, 0, 0});
            scene.planes = {
                {.normal = {static_cast<float>(std::sin(angle)), static_cast<float>(std::cos(angle)), 0},
                 .friction = 0.5f}};
            const double path = run(step, scene, {.substeps = 10}, 60).x[0].norm();
            const double acceleration = std::max(0.0, 9.81 * (std::sin(angle) - 0.5 * std::cos(angle)));
            EXPECT_NEAR(path, acceleration / 2, 0.01 * acceleration / 2 + 1e-6) << name << ' ' << degrees;
        }
    }
}

TEST(Reference, ReboundsWithItsRestitution) {
    for (const auto& [name, step] : solvers) {
        Scene scene = test::particleAt({0, 0.5f, 0});
        scene.particles[0].contactOffset = 0.1f;
        scene.planes = {{.offset = 0.1f, .restitution = 0.5f}};
        State state = reference::initialState(scene);
        double speed = 0; // largest upward speed
        for (int s = 0; s < 30; ++s) {
            step(scene, {.substeps = 100}, frame, state);
            speed = std::max(speed, state.v[0].y());
            EXPECT_GE(state.x[0].y(), 0.2 - 1e-9) << name;
        }
        // The speed is read at the end of the frame of the impact, after some gravity.
        EXPECT_NEAR(speed, 0.5 * std::sqrt(2 * 9.81 * 0.3), 9.81 * frame) << name;
    }
}

TEST(Reference, PreparedGaussSeidelEqualsTheFreeFunction) {
    Scene scene = test::sheet(6, 1e-4f);
    test::addRoom(scene);
    test::disturb(scene, 0.02f, 1);
    const Settings settings{.substeps = 3, .iterations = 4};
    reference::GaussSeidel prepared(scene, settings);
    State a = reference::initialState(scene), b = a;
    for (const double dt : {frame, 2 * frame, frame / 4}) {
        prepared.step(dt, a);
        reference::stepGaussSeidel(scene, settings, dt, b);
    }
    EXPECT_EQ(a.x, b.x);
    EXPECT_EQ(a.v, b.v);
}
