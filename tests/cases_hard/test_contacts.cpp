// Hard cases 15, 25 and 26: contacts in extreme situations. Case 14 is in test_interlocked.cpp.
#include "cases_hard/trial.hpp"
#include "sim/collision/contact_scenes.hpp"
#include "sim/scenes.hpp"
#include "sinew/bodies.hpp"
#include "sinew/validate.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>
#include <utility>

using namespace sinew;
using namespace sinew::sim;
using namespace sinew::test;
using Eigen::Vector3d;

namespace {

constexpr double radius = double{ballRadius};

// Two cubes of 6^3 touching particles. The second lies further along x, and 0.3 cells aside along y and z.
Scene twoCubes() {
    constexpr float spacing = 2 * ballRadius, off = 0.3f * spacing;
    Scene scene = weightless();
    for (const float at : {-0.5f, 3 * spacing + 0.5f})
        addLattice(scene, {.name = at > 0 ? "right" : "left",
                           .origin = {at, at > 0 ? off : 0, at > 0 ? off : 0},
                           .cells = {5, 5, 5},
                           .spacing = spacing,
                           .youngModulus = 1e5f});
    for (Particle& particle : scene.particles) particle.radius = ballRadius;
    return scene;
}

// Balls in a plane, as close as possible without contact; the whole sheet is fixed if `isFixed`.
Scene sheetOfBalls(int side, bool isFixed) {
    Scene scene = weightless();
    const float pitch = 2.001f * ballRadius, middle = 0.5f * static_cast<float>(side - 1);
    for (int i = 0; i < side * side; ++i) {
        const Vec3 at{0, (static_cast<float>(i / side) - middle) * pitch,
                      (static_cast<float>(i % side) - middle) * pitch};
        scene.particles.push_back(isFixed ? fixedBallAt(at) : ballAt(at));
    }
    return scene;
}

std::uint64_t hashOf(const Scene& scene, const Settings& settings, int steps,
                     std::uint32_t* slowed = nullptr) {
    Runner runner(scene, settings);
    for (int step = 0; step < steps; ++step) {
        const Status status = runner.run(1);
        EXPECT_EQ(status.nonFinite + status.contactRoom, 0u) << "step " << step;
        if (slowed) *slowed += status.slowed;
    }
    return runner.stateHash();
}

} // namespace

// 300 m/s are 100 radii a step, and 6 to 25 radii a substep.
TEST(HardContacts, Case15AProjectilePassesNoSheetThatHolds) {
    std::mt19937 random(2);
    std::uniform_real_distribution<float> at(-0.3f, 0.3f), aside(-40, 40);
    for (const std::uint32_t substeps : {4u, 8u, 16u})
        for (int shot = 0; shot < 12; ++shot) {
            Scene scene = sheetOfBalls(11, true);
            const auto bullet = scene.particles.size();
            scene.particles.push_back(
                ballAt({-1 - 0.1f * static_cast<float>(shot), at(random), at(random)},
                       {300, shot < 6 ? 0 : aside(random), shot < 6 ? 0 : aside(random)}));
            Runner runner(scene, {.substeps = substeps});
            std::uint32_t slowed = 0;
            double farthest = -1;
            for (int step = 0; step < 3; ++step) {
                const Status status = runner.run(1);
                ASSERT_EQ(status.contactRoom, 0u);
                slowed += status.slowed;
                farthest = std::max(farthest, runner.positions()[bullet].x());
            }
            EXPECT_LE(farthest, 0) << substeps << " substeps, shot " << shot;
            EXPECT_EQ(slowed, 0u);
        }
}

TEST(HardContacts, Case15AProjectileGivesItsMomentumToASheetOfLooseBalls) {
    for (const std::uint32_t substeps : {8u, 16u, 32u}) {
        Scene scene = sheetOfBalls(9, false);
        scene.particles.push_back(ballAt({-1, 0, 0}, {300, 0, 0}));
        Runner runner(scene, {.substeps = substeps});
        ASSERT_EQ(runner.run(2).contactRoom, 0u);
        const auto v = runner.velocities();
        std::printf("%u substeps: struck ball %.1f m/s, projectile %.1f m/s\n", substeps, v[40].x(),
                    v.back().x());
        EXPECT_NEAR(v[40].x(), 150, 1);
        EXPECT_NEAR(v.back().x(), 150, 1);
        EXPECT_LE((momentumOf(scene, v) - Vector3d(300, 0, 0)).norm(), 300 * 1e-5);
        EXPECT_EQ(hashOf(scene, {.substeps = substeps, .isReversed = true}, 2), runner.stateHash());
    }
}

TEST(HardContacts, Case15TwoFastBallsHeadOnKeepTheSquareOfRestitutionOfTheirEnergy) {
    for (const float restitution : {0.0f, 0.5f, 1.0f})
        for (const float contactMargin : {0.5f, 0.2f, 3.0f}) {
            Scene scene = weightless();
            scene.contacts.restitution = restitution;
            scene.particles = {ballAt({-2, 0, 0}, {300, 0, 0}), ballAt({2.1f, 0, 0}, {-300, 0, 0})};
            const Settings settings{.substeps = 16, .contactMargin = contactMargin};
            Runner runner(scene, settings);
            const double before = kineticEnergy(scene, runner.velocities());
            ASSERT_EQ(runner.run(2).slowed, 0u);
            const double ratio = kineticEnergy(scene, runner.velocities()) / before;
            std::printf("e %.1f, margin %.1f: %.6f of the energy\n", double{restitution},
                        double{contactMargin}, ratio);
            EXPECT_NEAR(ratio, double{restitution} * double{restitution}, 1e-4);
            EXPECT_GE(runner.positions()[1].x() - runner.positions()[0].x(), 2 * radius * (1 - 1e-4));
            Settings reversed = settings;
            reversed.isReversed = true;
            EXPECT_EQ(hashOf(scene, reversed, 2), runner.stateHash());
        }
}

namespace {

// Kinetic energy at the start, and its maximum after any of 60 steps [J].
std::pair<double, double> energyOfASecond(const Scene& scene, std::uint32_t substeps) {
    Runner runner(scene, {.substeps = substeps, .contactRoom = 128});
    const double before = kineticEnergy(scene, runner.velocities());
    double most = 0;
    for (int step = 0; step < 60; ++step) {
        const Status status = runner.run(1);
        EXPECT_EQ(status.nonFinite + status.contactRoom, 0u) << "step " << step;
        most = std::max(most, kineticEnergy(scene, runner.velocities()));
    }
    return {before, most};
}

} // namespace

// Regression test. Particles in contact that approached faster than half a radius a substep were once stopped
// in place while links kept pulling. This stored energy in the links with every substep (1e5 J and more in a
// collapsed stack).
TEST(HardContacts, Case15BodiesThatPressIntoEachOtherFastGainNoEnergy) {
    for (const float friction : {0.0f, 0.5f})
        for (const std::uint32_t substeps : {4u, 8u, 16u}) {
            Scene scene = twoCubes();
            const std::size_t half = scene.particles.size() / 2;
            scene.contacts.friction = friction;
            for (std::size_t i = 0; i < scene.particles.size(); ++i)
                scene.particles[i].velocity.x = i < half ? 30.0f : -30.0f;
            const auto [before, most] = energyOfASecond(scene, substeps);
            std::printf("friction %.1f, %2u substeps: %.0f J at first, at most %.0f J\n", double{friction},
                        substeps, before, most);
            EXPECT_LE(most, 1.01 * before);
        }
}

TEST(HardContacts, Case15ABodyThatPressesFastIntoOneThatHoldsGainsNoEnergy) {
    for (const std::uint32_t substeps : {4u, 8u, 16u}) {
        Scene scene = twoCubes();
        const std::size_t half = scene.particles.size() / 2;
        for (std::size_t i = 0; i < scene.particles.size(); ++i) {
            if (i < half)
                scene.particles[i].velocity.x = 30;
            else
                scene.particles[i].inverseMass = 0;
        }
        const auto [before, most] = energyOfASecond(scene, substeps);
        std::printf("%2u substeps: %.0f J at first, at most %.0f J\n", substeps, before, most);
        EXPECT_LE(most, 1.02 * before);
    }
}

// The search along paths has room for 256 particles that are fast against the motion that all share. With
// more, all of them are slowed down and counted, and none is lost.
TEST(HardContacts, Case15MoreFastParticlesThanThereIsRoomForAreSlowedDownAndCounted) {
    const auto swarm = [](std::uint32_t count, float speed) {
        Scene scene = weightless();
        for (std::uint32_t i = 0; i < count; ++i)
            scene.particles.push_back(
                ballAt({0, 0.11f * static_cast<float>(i % 20), 0.11f * static_cast<float>(i / 20)},
                       {i % 2 == 0 ? speed : -speed, 0, 0}));
        return scene;
    };
    const auto slowedOf = [&](const Scene& scene) {
        std::uint32_t slowed = 0, reversed = 0;
        const std::uint64_t hash = hashOf(scene, {.substeps = 16}, 2, &slowed);
        EXPECT_EQ(hashOf(scene, {.substeps = 16, .isReversed = true}, 2, &reversed), hash);
        EXPECT_EQ(reversed, slowed);
        return slowed;
    };
    EXPECT_EQ(slowedOf(swarm(256, 60)), 0u);
    EXPECT_EQ(slowedOf(swarm(257, 60)), 257u) << "once: then they are slow enough";
    EXPECT_EQ(slowedOf(swarm(257, 40)), 0u) << "a radius a substep is 48 m/s";
}

// validate() rejects a start that no contact list could hold, with the number and place of the particles.
// ContactLists tests particles that meet during the run, which undo their step.
TEST(HardContacts, Case25TenThousandCoincidentParticlesAreSaidToBeTooMany) {
    Scene scene;
    scene.particles.assign(10'000, ballAt({0.1f, 0.2f, 0.3f}));
    const std::vector<std::string> complaints = validate(scene, {.substeps = 2, .contactRoom = 4});
    ASSERT_EQ(complaints.size(), 1u);
    EXPECT_NE(complaints[0].find("10000 particles that touch each other at (0.1, 0.2, 0.3) m"),
              std::string::npos)
        << complaints[0];
}

TEST(HardContacts, Case25TwoHundredCoincidentParticlesPartRepeatably) {
    Scene scene = weightless();
    scene.particles.assign(200, ballAt({-0.0f, 0.2f, -0.3f}));
    const double bound = 0.5 * 200 * std::pow(10 * double{scene.contacts.recoverySpeed}, 2);
    const Trial trial = runTrial(scene, {.substeps = 8, .contactRoom = 256}, {.steps = 60, .work = bound});
    std::printf("200 in one place: kinetic energy at most %.2f J, deepest after 1 s %.3f r\n",
                *std::max_element(trial.kineticEnergy.begin(), trial.kineticEnergy.end()),
                deepestOf(trial.x.back()));
    EXPECT_LE(deepestOf(trial.x.back()), 1);
}

// Pairs on cell borders, at -0.0 and far outside of the other particles part as they do in the middle.
// ContactLists.EqualBruteForceOnTwelveHundredConfigurations compares the lists there with brute force.
TEST(HardContacts, Case26PairsOnBordersAndFarOutsidePartLikeAnyOther) {
    Scene scene = weightless();
    const std::vector<Vec3> places{
        {0, 0, 0},     {-0.0f, 4, -0.0f}, {0.2f * 7, 0, 0}, {-0.2f * 7, -0.4f, 0.6f},
        {50, -50, 50}, {-60, 30, -0.0f},  {0, 0, 64}};
    for (const Vec3& at : places) { // the pair meets along x at 2 m/s
        scene.particles.push_back(ballAt({at.x, at.y, at.z}, {1, 0, 0}));
        scene.particles.push_back(ballAt({at.x + 0.125f, at.y, at.z}, {-1, 0, 0}, 1));
    }
    const Trial trial = runTrial(scene, {.substeps = 8}, {.steps = 30});
    for (std::size_t p = 0; p < places.size(); ++p)
        EXPECT_LE((trial.v.back()[2 * p] - trial.v.back()[2 * p + 1]).norm(), 0.02) << "pair " << p;
}
