// Particles that overlap at load part at a limited speed on the device. Their search on the host is compared
// with brute force.
#include "sim/collision/contact_scenes.hpp"
#include "sim/collision/overlaps.hpp"
#include "sim/compile/compile.hpp"
#include "sim/runner.hpp"
#include "sim/scenes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <memory>
#include <random>

using namespace sinew;
using namespace sinew::sim;
using namespace sinew::test;
using Eigen::Vector3d;

namespace {

constexpr double radius = double{ballRadius};

// A heap of balls whose neighbours overlap by 10 to 50 % of the sum of their radii.
Scene heap(std::uint32_t side, float friction = 0) {
    Scene scene = weightless();
    scene.contacts.friction = friction;
    addBalls(scene, side, 1.4f * ballRadius, 0.2f * ballRadius);
    return scene;
}

std::uint64_t hashOf(const Scene& scene, const Settings& settings, int steps) {
    Runner runner(scene, settings);
    const Status status = runner.run(steps);
    EXPECT_EQ(status.nonFinite + status.contactRoom, 0u);
    return runner.stateHash();
}

double fastest(const std::vector<Vector3d>& v) {
    double most = 0;
    for (const Vector3d& one : v) most = std::max(most, one.norm());
    return most;
}

bool hasBuffer(const StepProgram& program, const std::string& part) {
    return std::ranges::any_of(program.buffers, [&](const BufferSpec& buffer) {
        return buffer.label.find(part) != std::string::npos;
    });
}

} // namespace

TEST(OverlapAtLoad, OfTwoBallsEndsAtTheSpeedOfRecoveryWhateverTheSubsteps) {
    for (const float speed : {0.1f, 0.5f})
        for (const std::uint32_t substeps : {4u, 16u, 64u}) {
            Scene scene = weightless();
            scene.contacts.recoverySpeed = speed;
            scene.particles = {ballAt({0, 0, 0}, {}, 1), ballAt({ballRadius, 0, 0}, {}, 3)};
            Runner runner(scene, {.substeps = substeps});
            double most = 0;
            const int steps = static_cast<int>(radius / double{speed} * 60) + 6;
            for (int step = 0; step < steps; ++step) {
                runner.run(1);
                const auto v = runner.velocities();
                most = std::max(most, (v[0] - v[1]).norm());
            }
            EXPECT_NEAR(most, double{speed}, 1e-3 * double{speed}) << substeps;
            EXPECT_EQ(deepestOf(runner.positions()), 0) << substeps;
            EXPECT_LE(momentumOf(scene, runner.velocities()).norm(), 1e-6 * double{speed});
        }
}

// The bound is the energy of a heap of n^3 balls that expands evenly while neighbours part at 2 v_rec. That
// is twice the allowed speed, since recovery presses the inner balls, which push on.
TEST(OverlapAtLoad, OfAHeapEndsWithTheEnergyOfItsSpeedOfRecovery) {
    constexpr std::uint32_t side = 6;
    const auto energyOf = [](float speed, double& deepest) {
        Scene scene = heap(side);
        scene.contacts.recoverySpeed = speed;
        Runner runner(scene, {.substeps = 16, .contactRoom = 64});
        EXPECT_GE(deepestOf(runner.positions()), 0.9);
        double most = 0;
        for (int step = 0; step < 90; ++step) {
            runner.run(1);
            most = std::max(most, kineticEnergy(scene, runner.velocities()));
        }
        deepest = deepestOf(runner.positions());
        EXPECT_LE(momentumOf(scene, runner.velocities()).norm(), 1e-3);
        std::printf(
            "v_rec %g m/s: kinetic energy at most %.3f J, fastest %.2f m/s, deepest at the end %.4f r\n",
            double{speed}, most, fastest(runner.velocities()), deepest);
        return most;
    };
    double deepest = 0;
    for (const float speed : {0.25f, 0.5f}) {
        const double mass = side * side * side, parting = 2 * double{speed};
        EXPECT_LE(energyOf(speed, deepest), 0.5 * mass * parting * parting * (side * side - 1) / 4) << "[J]";
        EXPECT_LE(deepest, 0.01) << "[radii]";
    }
    EXPECT_GE(energyOf(1e6f, deepest), 1e4) << "[J] without";
}

// The remaining overlap persists when lists are rebuilt, a step is undone, and another simulation takes over.
TEST(OverlapAtLoad, EndsInTheSameBitsForAnyMarginRoomOrderAndForm) {
    for (const float friction : {0.0f, 0.3f}) {
        Scene scene = heap(5, friction);
        scene.gravity = {0, -9.81f, 0};
        scene.planes = {{.offset = -0.3f, .friction = friction}};
        const Settings settings{.substeps = 8, .contactRoom = 64};
        const std::uint64_t hash = hashOf(scene, settings, 25);
        Settings narrow = settings, roomy = settings, reversed = settings, loads = settings;
        narrow.contactMargin = 0.2f;
        roomy.contactRoom = 80;
        reversed.isReversed = true;
        loads.forms.usesTexels = false;
        EXPECT_EQ(hashOf(scene, narrow, 25), hash) << "another margin";
        EXPECT_EQ(hashOf(scene, roomy, 25), hash) << "more room";
        EXPECT_EQ(hashOf(scene, reversed, 25), hash) << "reversed";
        EXPECT_EQ(hashOf(scene, loads, 25), hash) << "without texels";
    }
}

TEST(OverlapAtLoad, IsRememberedByAnUndoneStepAndByASimulationWithMoreRoom) {
    const Scene scene = heap(4);
    constexpr int steps = 12;
    const std::uint64_t hash = hashOf(scene, {.substeps = 8, .contactRoom = 64}, steps);
    Settings settings{.substeps = 8, .contactRoom = 1}; // still has capacity for the initial overlaps
    auto runner = std::make_unique<Runner>(scene, settings);
    int growths = 0, done = 0;
    for (int step = 0; done < steps && step < 2 * steps; ++step) {
        if (step == 5) runner->writePosition(3, std::numeric_limits<float>::quiet_NaN());
        const Status status = runner->run(1);
        if (status.contactRoom > 0) {
            settings.contactRoom = status.contactRoom;
            auto larger = std::make_unique<Runner>(scene, settings);
            larger->takeOver(*runner);
            runner = std::move(larger);
            ++growths;
        } else if (status.nonFinite == 0) {
            ++done;
        }
    }
    EXPECT_EQ(done, steps);
    EXPECT_GE(growths, 1);
    EXPECT_EQ(runner->stateHash(), hash);
}

TEST(OverlapAtLoad, CostsNothingWhereNothingOverlaps) {
    Scene scene = weightless();
    scene.particles = {ballAt({0, 0, 0}), ballAt({2.0001f * ballRadius, 0, 0}),
                       ballAt({0, 1.9999f * ballRadius, 0})}; // overlaps by less than a substep's recovery
    const StepProgram program = compile(scene, {.substeps = 4});
    EXPECT_FALSE(hasBuffer(program, "pairs.memory"));
    constexpr std::uint32_t hasRecovery = 4; // constant_id in count_contacts.comp
    EXPECT_TRUE(usesKernel(scene, "count_contacts", {.substeps = 4}, {{hasRecovery, 0}}));
    scene.particles[1].position.x = 1.9f * ballRadius;
    EXPECT_TRUE(hasBuffer(compile(scene, {.substeps = 4}), "pairs.memory"));
    EXPECT_TRUE(usesKernel(scene, "count_contacts", {.substeps = 4}, {{hasRecovery, 1}}));
}

// Linked particles that never touch and pairs of fixed particles do not recover.
TEST(OverlapAtLoad, OfLinkedOrFixedParticlesIsNone) {
    Scene scene = chain(8);
    for (Particle& particle : scene.particles) particle.radius = 0.06f;
    scene.particles.push_back(fixedBallAt({0, 3, 0}));
    scene.particles.push_back(fixedBallAt({0.02f, 3, 0}));
    EXPECT_FALSE(hasBuffer(compile(scene, {.substeps = 4}), "pairs.memory"));
}

TEST(Overlaps, AreThoseOfBruteForceForRadiiOfEverySize) {
    using collision::overlaps::Overlap;
    std::mt19937 random(3);
    std::size_t pairs = 0;
    for (int configuration = 0; configuration < 60; ++configuration) {
        std::uniform_real_distribution<float> at(-0.5f, 0.5f), size(0.01f, 0.06f);
        std::vector<std::array<float, 3>> x(256);
        std::vector<float> radii(256), inverseMasses(256, 1);
        for (std::size_t i = 0; i < x.size(); ++i) {
            x[i] = {at(random), at(random), configuration % 3 == 0 ? 0 : at(random)};
            radii[i] = random() % 30 == 0 ? 0.4f : random() % 10 == 0 ? -1 : size(random);
            if (random() % 4 == 0) inverseMasses[i] = 0;
        }
        const collision::contact_lists::Exclusions none;
        const float least = 0.01f;
        const auto found = collision::overlaps::find({.positions = x,
                                                      .radii = radii,
                                                      .inverseMasses = inverseMasses,
                                                      .exclusions = none,
                                                      .least = least,
                                                      .limit = 256});
        ASSERT_EQ(found.size(), x.size());
        for (std::uint32_t i = 0; i < x.size(); ++i) {
            std::vector<std::uint32_t> expected, others;
            for (std::uint32_t j = 0; j < x.size(); ++j) {
                const double distance = (Vector3d(double{x[i][0]}, double{x[i][1]}, double{x[i][2]}) -
                                         Vector3d(double{x[j][0]}, double{x[j][1]}, double{x[j][2]}))
                                            .norm();
                if (i != j && radii[i] >= 0 && radii[j] >= 0 && inverseMasses[i] + inverseMasses[j] > 0 &&
                    double{radii[i]} + double{radii[j]} - distance > double{least})
                    expected.push_back(j);
            }
            for (const Overlap& overlap : found[i]) others.push_back(overlap.other);
            ASSERT_EQ(others, expected) << "particle " << i << " of configuration " << configuration;
            pairs += others.size();
        }
    }
    EXPECT_GT(pairs, 10'000u) << "too thin to show anything";
}
