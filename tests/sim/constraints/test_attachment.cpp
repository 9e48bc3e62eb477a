// Tests of attachments to moving points, and of tethers.
#include "sim/compile/compile.hpp"
#include "sim/constraints/agreement.hpp"
#include "sim/constraints/attachment.hpp"
#include "sim/runner.hpp"
#include "sim/scenes.hpp"
#include "sinew/bodies.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace sinew;
using namespace sinew::sim;
using Eigen::Vector3d;

namespace {

class Attached : public testing::TestWithParam<Solver> {
protected:
    Settings settings(std::uint32_t substeps = 16) const {
        return {.solver = GetParam(), .substeps = substeps};
    }
};

Scene attachedBlock(float compliance) {
    Scene scene = test::block(5, 0.1f, 1e5f);
    for (const std::uint32_t i : {0u, 17u, 200u})
        scene.attachments.push_back(
            {.particle = i, .anchor = scene.particles[i].position, .compliance = compliance});
    return scene;
}

} // namespace

TEST_P(Attached, StepsAgreeWithDouble) {
    for (const float compliance : {0.0f, 1e-3f}) {
        Scene scene = attachedBlock(compliance);
        test::addRoom(scene);
        scene.attachments[1].maxForce = 3;
        scene.attachments[2].maxSpeed = 0.7f;
        test::disturb(scene, 0.01f, 0.5f);
        test::expectAgreement(scene, GetParam(),
                              {{{0, 0.1f, 0}, {0.5f, 0.5f, 0}, {0.4f, 0.4f, 0.9f}}, {{0, 0.1f, 0.01f}}, {}});
    }
}

TEST_P(Attached, ARigidOneIsWhereItsPointIs) {
    Scene scene = attachedBlock(0);
    test::Runner runner(scene, settings());
    for (int step = 1; step <= 60; ++step) {
        const float angle = 0.1f * static_cast<float>(step);
        const Vec3 point{0.2f * std::sin(angle), 0.3f, 0.2f * std::cos(angle)};
        ASSERT_EQ(runner.step(scene.dt, std::vector<Vec3>{point}).nonFinite, 0u);
        EXPECT_LE((runner.positions()[0] - test::toVector(point)).norm(), 2e-6) << step;
    }
}

// XPBD of one particle is exact at rest: m g compliance below its anchor for any substep. The mean over ten
// periods cancels the remaining oscillation.
TEST_P(Attached, ASpringStretchesByItsLoad) {
    for (const std::uint32_t substeps : {1u, 4u, 32u}) {
        Scene scene = test::particleAt({0, -0.0981f, 0});
        scene.attachments = {{.particle = 0, .compliance = 1e-2f}};
        test::Runner runner(scene, settings(substeps));
        runner.run(300);
        double mean = 0;
        for (int step = 0; step < 377; ++step) {
            runner.step(scene.dt);
            mean += runner.positions()[0].y() / 377;
        }
        EXPECT_NEAR(mean, -0.0981, 5e-5) << substeps;
    }
}

TEST_P(Attached, NeverPullsHarderThanItsLimit) {
    Scene scene = test::particleAt({0, 0, 0});
    scene.gravity = {0, 0, 0};
    scene.attachments = {{.particle = 0, .maxForce = 2}};
    test::Runner runner(scene, settings());
    for (int step = 0; step < 6; ++step) runner.step(scene.dt, std::vector<Vec3>{{100, 0, 0}});
    EXPECT_NEAR(runner.velocities()[0].x(), 2 * 6 * double{scene.dt}, 1e-4); // F t / m
}

TEST_P(Attached, AFixedParticleStaysWhereItIs) {
    Scene scene = attachedBlock(0);
    scene.fixed = {{0}};
    test::Runner runner(scene, settings());
    const Vector3d before = runner.positions()[0];
    runner.step(scene.dt, std::vector<Vec3>{{1, 1, 1}});
    EXPECT_EQ(runner.positions()[0], before);
}

TEST_P(Attached, AResetPutsThePointsBack) {
    Scene scene = attachedBlock(1e-3f);
    test::Runner runner(scene, settings());
    runner.run(10);
    const std::uint64_t hash = runner.stateHash();
    runner.step(scene.dt, std::vector<Vec3>{{1, 1, 1}});
    runner.reset();
    runner.run(10);
    EXPECT_EQ(runner.stateHash(), hash);
}

INSTANTIATE_TEST_SUITE_P(Of, Attached, testing::Values(Solver::jacobi, Solver::split, Solver::gaussSeidel),
                         [](const auto& parameter) { return solverName(parameter.param); });

TEST(Anchors, FollowTheirTargetsNoFasterThanTheyMay) {
    constraints::attachment::Anchors anchors({{.anchor = {1, 0, 0}, .maxSpeed = 2}, {.anchor = {0, 5, 0}}});
    const std::vector<Vec3> targets{{2, 0, 0}};
    anchors.advance(targets, 0.1f);
    EXPECT_EQ(anchors.values()[0].x, 1);
    EXPECT_FLOAT_EQ(anchors.values()[1].x, 1.2f);
    EXPECT_EQ(anchors.values()[3].y, 5);
    anchors.advance(targets, 0.1f);
    EXPECT_FLOAT_EQ(anchors.values()[0].x, 1.2f);
    EXPECT_FLOAT_EQ(anchors.values()[1].x, 1.4f);
    anchors.advance(std::vector<Vec3>{{std::numeric_limits<float>::quiet_NaN(), 0, 0}, {0, -3e38f, 0}}, 0.1f);
    EXPECT_FLOAT_EQ(anchors.values()[1].x, 1.4f) << "what is no number is no target";
    EXPECT_EQ(anchors.values()[3].y, -3e38f);
    anchors.reset();
    EXPECT_EQ(anchors.values()[1].x, 1);
}

namespace {

class Tethered : public Attached {};

} // namespace

TEST_P(Tethered, StepsAgreeWithDouble) {
    Scene scene{.name = "tethered sheet"};
    addCloth(scene,
             {.origin = {0, 1, 0}, .size = {12, 12}, .spacing = 0.1f, .tethers = 2, .pinned = {0, 11}});
    test::disturb(scene, 0.03f,
                  2); // at half of the spacing, 1e-7 grows to 6e-6 within a step, in double as well
    test::expectAgreement(scene, GetParam());
}

TEST_P(Tethered, KeepAHeavySheetFromStretching) {
    const auto lowest = [&](std::uint32_t tethers) {
        Scene scene;
        addCloth(scene, {.size = {24, 24}, .spacing = 0.04f, .tethers = tethers, .pinned = {0, 23}});
        scene.damping = 2;
        test::Runner runner(scene, settings(4));
        EXPECT_EQ(runner.run(240).nonFinite, 0u);
        const auto x = runner.positions();
        double worst = 0; // largest growth of a particle's distance from the first corner
        for (std::size_t i = 1; i < x.size(); ++i)
            worst = std::max(worst, (x[i] - x[0]).norm() /
                                        (test::toVector(scene.particles[i].position) - x[0]).norm());
        return worst;
    };
    EXPECT_LE(lowest(2), 1.01) << "the second of two taut tethers moves a particle off the first a little";
    EXPECT_GT(lowest(0), 1.1) << "the same sheet without tethers at so few substeps";
}

INSTANTIATE_TEST_SUITE_P(Of, Tethered, testing::Values(Solver::jacobi, Solver::split, Solver::gaussSeidel),
                         [](const auto& parameter) { return solverName(parameter.param); });

TEST(Tethers, GoTheShortestWayOverLinksToTheNearestAnchors) {
    Scene scene = test::chain(6);
    scene.fixed = {{0}, {5}};
    addTethers(scene, {.count = 6, .perParticle = 2, .slack = 0.01f});
    ASSERT_EQ(scene.tethers.size(), 8u);
    for (const Tether& tether : scene.tethers) {
        const double links =
            std::abs(static_cast<double>(tether.particle) - static_cast<double>(tether.anchor));
        EXPECT_NEAR(double{tether.length}, 0.101 * links, 1e-6);
    }
    Scene loose = test::chain(4);
    addTethers(loose, {.count = 4});
    EXPECT_TRUE(loose.tethers.empty());
}
