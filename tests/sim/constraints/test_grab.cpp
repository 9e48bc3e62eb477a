// Tests of grabs: a grab holds its particles, pulls with bounded force and speed, and releases them without a
// trace.
#include "sim/collision/contact_scenes.hpp"
#include "sim/compile/compile.hpp"
#include "sim/runner.hpp"
#include "sim/scenes.hpp"
#include "sinew/bodies.hpp"
#include "sinew/validate.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <limits>

using namespace sinew;
using namespace sinew::sim;
using Eigen::Vector3d;

namespace {

constexpr std::uint32_t chosen = 21; // inside a block of 3^3 cells

// A block of `mass` [kg] whose wave speed does not depend on the mass.
Scene blockOf(float mass) {
    Scene scene{.name = "held"};
    addLattice(scene,
               {.cells = {3, 3, 3}, .spacing = 0.1f, .youngModulus = mass * 1e5f, .density = mass / 0.027f});
    return scene;
}

Settings settings(Solver solver) {
    return {.solver = solver, .substeps = 16, .iterations = solver == Solver::jacobi ? 8u : 1u, .grabs = 2};
}

Vec3 placeOf(const Scene& scene, std::uint32_t particle) {
    return scene.particles[particle].position;
}

Step stepOf(const Scene& scene, std::span<const Grab> grabs) {
    return {.dt = scene.dt, .gravity = scene.gravity, .grabs = grabs};
}

Vector3d centerOf(const std::vector<Vector3d>& x) {
    Vector3d sum = Vector3d::Zero();
    for (const Vector3d& one : x) sum += one;
    return sum / static_cast<double>(x.size());
}

// Velocity of the centre of mass [m/s].
Vector3d speedOf(const Scene& scene, const std::vector<Vector3d>& v) {
    Vector3d momentum = Vector3d::Zero();
    for (std::size_t i = 0; i < v.size(); ++i) momentum += v[i] / double{scene.particles[i].inverseMass};
    return momentum / test::massOf(scene);
}

double farthest(const std::vector<Vector3d>& a, const std::vector<Vector3d>& b) {
    double most = 0;
    for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, (a[i] - b[i]).norm());
    return most;
}

class Held : public ::testing::TestWithParam<Solver> {};

std::string nameOf(const ::testing::TestParamInfo<Solver>& info) {
    return ::testing::PrintToString(info.param);
}

} // namespace

// A block with all gains on its centre of mass hangs g / stiffness below the target.
TEST_P(Held, HangsBelowTheHandByGravityOverStiffness) {
    const Scene scene = blockOf(2);
    test::Runner runner(scene, settings(GetParam()));
    const Grab grab{.particle = chosen, .radius = 1, .target = placeOf(scene, chosen)};
    const Vector3d start = centerOf(runner.positions());
    for (int s = 0; s < 180; ++s) runner.step(stepOf(scene, std::array{grab}));
    const double sag = start.y() - centerOf(runner.positions()).y();
    std::printf("%s: sags %.5f m (%.5f)\n", solverName(GetParam()), sag, 9.81 / 400);
    EXPECT_NEAR(sag, 9.81 / 400, 0.01 * 9.81 / 400);
}

TEST_P(Held, TakingHoldMovesNothing) {
    Scene scene = blockOf(2);
    scene.gravity = {0, 0, 0};
    test::Runner runner(scene, settings(GetParam())), free(scene, settings(GetParam()));
    Vec3 beside = placeOf(scene, chosen);
    beside.x += 0.03f;
    const Grab grab{.particle = chosen, .radius = 0.15f, .target = beside};
    for (int s = 0; s < 5; ++s) runner.step(stepOf(scene, std::array{grab}));
    free.run(5);
    EXPECT_LE(farthest(runner.positions(), free.positions()), 1e-6);
}

TEST_P(Held, LightAndHeavyBodiesMoveAlike) {
    std::vector<std::vector<Vector3d>> ends;
    for (const float mass : {0.01f, 1.0f, 1000.0f}) {
        const Scene scene = blockOf(mass);
        test::Runner runner(scene, settings(GetParam()));
        Grab grab{.particle = chosen, .radius = 0.15f, .target = placeOf(scene, chosen)};
        for (int s = 0; s < 60; ++s) {
            runner.step(stepOf(scene, std::array{grab}));
            grab.target.x += 0.02f;
        }
        ends.push_back(runner.positions());
    }
    EXPECT_LE(farthest(ends[0], ends[1]), 1e-3);
    EXPECT_LE(farthest(ends[2], ends[1]), 1e-3);
    EXPECT_NEAR(centerOf(ends[1]).x(), 0.15 + 60 * 0.02, 0.2) << "it followed";
}

// Hard case 28 with a grab.
TEST_P(Held, ATargetThatJumpsPullsNoHarderAndNoFasterThanItMay) {
    Scene scene = blockOf(27);
    scene.gravity = {0, 0, 0};
    test::Runner runner(scene, settings(GetParam()));
    Grab grab{.particle = chosen,
              .radius = 0.15f,
              .target = placeOf(scene, chosen),
              .maxAcceleration = 60,
              .maxSpeed = 4};
    double fastest = 0, pull = 0;
    Vector3d before = Vector3d::Zero();
    for (int s = 0; s < 240; ++s) {
        if (s == 10) grab.target.x += 9;
        const Status status = runner.step(stepOf(scene, std::array{grab}));
        ASSERT_EQ(status.nonFinite, 0u);
        const Vector3d v = speedOf(scene, runner.velocities());
        fastest = std::max(fastest, v.norm());
        pull = std::max(pull, (v - before).norm() / double{scene.dt});
        before = v;
    }
    std::printf("%s: fastest %.2f m/s, most %.1f m/s^2\n", solverName(GetParam()), fastest, pull);
    EXPECT_LE(fastest, 2 * 4);
    const double most = GetParam() == Solver::jacobi ? 1.4 : 1.01; // averaging does not conserve momentum
    EXPECT_LE(pull, most * 60);
    EXPECT_NEAR(runner.positions()[chosen].x(), double{placeOf(scene, chosen).x} + 9, 0.05) << "it followed";
}

TEST_P(Held, WhatIsLetGoFallsFreely) {
    const Scene scene = blockOf(1);
    test::Runner runner(scene, settings(GetParam()));
    const Grab grab{.particle = chosen, .radius = 0.15f, .target = placeOf(scene, chosen)};
    for (int s = 0; s < 120; ++s) runner.step(stepOf(scene, std::array{grab}));
    const double before = centerOf(runner.velocities()).y();
    for (int s = 0; s < 30; ++s) runner.step(stepOf(scene, {}));
    EXPECT_NEAR(centerOf(runner.velocities()).y() - before, -9.81 * 0.5, 0.02);
}

TEST_P(Held, OthersAndWhatNeverMovesStayFree) {
    Scene scene = blockOf(1);
    addLattice(scene, {.origin = {0.4f, 0, 0}, .cells = {3, 3, 3}, .spacing = 0.1f, .youngModulus = 1e5f});
    scene.fixed = {{0}};
    scene.gravity = {0, 0, 0};
    test::Runner runner(scene, settings(GetParam()));
    Grab grab{.particle = chosen, .radius = 2, .target = placeOf(scene, chosen)};
    const std::vector<Vector3d> start = runner.positions();
    for (int s = 0; s < 20; ++s) {
        grab.target.y += 0.01f;
        runner.step(stepOf(scene, std::array{grab}));
    }
    const std::vector<Vector3d> end = runner.positions();
    EXPECT_EQ(end[0], start[0]) << "fixed";
    EXPECT_GT(end[chosen].y(), start[chosen].y() + 0.02);
    for (std::size_t i = 64; i < start.size(); ++i)
        EXPECT_LE((end[i] - start[i]).norm(), 1e-6) << "particle " << i << " of the other block";
}

TEST_P(Held, TwoHandsPullApartAndHaveTheSameBitsInAnyOrder) {
    std::vector<std::uint64_t> hashes;
    for (const bool isReversed : {false, true, false}) {
        const Scene scene = blockOf(1);
        Settings both = settings(GetParam());
        both.isReversed = isReversed;
        test::Runner runner(scene, both);
        std::array grabs{Grab{.particle = 0, .radius = 0.15f, .target = placeOf(scene, 0)},
                         Grab{.particle = 3, .radius = 0.15f, .target = placeOf(scene, 3)}};
        for (int s = 0; s < 40; ++s) {
            runner.step(stepOf(scene, std::span(grabs).first(s < 5 ? 1 : 2)));
            grabs[0].target.x -= 0.002f;
            grabs[1].target.x += 0.002f;
        }
        const auto x = runner.positions();
        EXPECT_GT(x[3].x() - x[0].x(), 0.31) << "pulled apart";
        hashes.push_back(runner.stateHash());
    }
    EXPECT_EQ(hashes[1], hashes[0]);
    EXPECT_EQ(hashes[2], hashes[0]);
}

TEST_P(Held, WhatIsNoNumberOrNoParticleIsNotHeld) {
    const Scene scene = blockOf(1);
    test::Runner free(scene, settings(GetParam()));
    free.run(10);
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const float inf = std::numeric_limits<float>::infinity();
    const Vec3 place = placeOf(scene, chosen);
    for (const Grab& grab : {Grab{.particle = chosen, .radius = nan, .target = place},
                             Grab{.particle = chosen, .radius = 1, .target = {nan, 0, 0}},
                             Grab{.particle = chosen, .radius = 1, .target = {0, 2e9f, 0}},
                             Grab{.particle = chosen, .radius = 1, .target = place, .stiffness = inf},
                             Grab{.particle = chosen, .radius = 1, .target = place, .maxSpeed = nan},
                             Grab{.particle = 64, .radius = 1, .target = place},
                             Grab{.particle = ~0u, .radius = 1, .target = place}}) {
        test::Runner runner(scene, settings(GetParam()));
        for (int s = 0; s < 10; ++s) runner.step(stepOf(scene, std::array{grab}));
        EXPECT_EQ(runner.stateHash(), free.stateHash());
    }
    test::Runner runner(scene, settings(GetParam())); // all gains 0, or at their maximum
    const float most = std::numeric_limits<float>::max();
    for (int s = 0; s < 10; ++s)
        for (const Vec3& target : {place, Vec3{1e9f, -1e9f, 0}})
            EXPECT_EQ(runner
                          .step(stepOf(scene, std::array{Grab{.particle = chosen,
                                                              .target = target,
                                                              .stiffness = most,
                                                              .damping = most,
                                                              .maxAcceleration = most,
                                                              .maxSpeed = inf}}))
                          .nonFinite,
                      0u);
}

INSTANTIATE_TEST_SUITE_P(Solvers, Held, ::testing::Values(Solver::split, Solver::jacobi, Solver::gaussSeidel),
                         nameOf);

TEST(Grabs, CostsNothingWhereThereIsNone) {
    const Scene scene = blockOf(1);
    EXPECT_TRUE(test::usesKernel(scene, "solve_grabs", settings(Solver::split)));
    EXPECT_FALSE(test::usesKernel(scene, "solve_grabs"));
    EXPECT_FALSE(test::usesKernel(scene, "open_grabs"));
}

TEST(Grabs, ThatHoldsNothingChangesNoBit) {
    const Scene scene = test::block(4, 0.1f, 1e5f, 0.3f);
    Settings with{.substeps = 8, .grabs = 1}, without{.substeps = 8};
    EXPECT_EQ(test::hashOfRun(scene, with, 20), test::hashOfRun(scene, without, 20));
}

TEST(Grabs, MoreThanThereCanBeAreRefusedByName) {
    const auto sentences = validate(blockOf(1), {.grabs = 9});
    ASSERT_EQ(sentences.size(), 1u);
    EXPECT_NE(sentences[0].find("settings.grabs"), std::string::npos) << sentences[0];
}

// A grab pulls a ball out of a sleeping heap. The balls in contact with it wake too, and fall.
TEST(Grabs, WakesWhatItHolds) {
    Scene scene;
    test::addBalls(scene, 4, 2.3f * test::ballRadius, 0.1f * test::ballRadius, {0, 0.3f, 0});
    scene.contacts.friction = 0.5f;
    scene.planes = {{.friction = 0.5f}};
    test::Runner runner(scene, {.substeps = 16, .sleeps = true, .grabs = 1});
    const auto count = static_cast<std::uint32_t>(scene.particles.size());
    int steps = 0;
    while (runner.run(1).sleeping < count && ++steps < 600) {
    }
    ASSERT_LT(steps, 600);
    const std::vector<Vector3d> asleep = runner.positions();
    std::uint32_t top = 0;
    for (std::uint32_t i = 0; i < count; ++i)
        if (asleep[i].y() > asleep[top].y()) top = i;
    Grab grab{.particle = top, .radius = 0, .target = test::toFloats(asleep[top])};
    EXPECT_LT(runner.step(stepOf(scene, std::array{grab})).sleeping, count);
    for (int s = 0; s < 60; ++s) {
        grab.target.y += 0.01f;
        runner.step(stepOf(scene, std::array{grab}));
    }
    EXPECT_NEAR(runner.positions()[top].y(), asleep[top].y() + 0.6, 0.05);
    for (int s = 0; s < 600 && runner.step(stepOf(scene, {})).sleeping < count; ++s) {
    }
    EXPECT_EQ(runner.step(stepOf(scene, {})).sleeping, count) << "all sleep again when it is let go";
}

// The contact capacity is exceeded during a grab; the larger simulation that takes over continues the grab.
TEST(Grabs, HoldsOnWhenASimulationWithMoreRoomTakesOver) {
    Scene scene;
    test::addBalls(scene, 5, 2.6f * test::ballRadius, 0.2f * test::ballRadius, {0, 0.6f, 0});
    scene.planes = {{.friction = 0.5f}};
    const Settings roomy{.substeps = 8, .contactRoom = 64, .grabs = 1};
    Settings tight = roomy;
    tight.contactRoom = 2;
    test::Runner whole(scene, roomy), first(scene, tight), second(scene, roomy);
    Grab grab{.particle = 62, .radius = 0, .target = placeOf(scene, 62)};
    bool isSecond = false;
    for (int s = 0; s < 40; ++s) {
        grab.target.x += 0.005f;
        const std::array grabs{grab};
        const Step step = stepOf(scene, grabs);
        whole.step(step);
        if (isSecond) {
            second.step(step);
        } else if (first.step(step).contactRoom > 0) {
            isSecond = true;
            second.takeOver(first);
            second.step(step); // the grab has already moved in this step
        }
    }
    EXPECT_TRUE(isSecond) << "room did not run out";
    EXPECT_LE(farthest(whole.positions(), second.positions()), 0.02);
}
