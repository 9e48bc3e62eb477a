// Tests of particle-particle contacts on the device: momentum, rest, friction, and equal bits for any layout
// of the lists.
#include "common/share_band.h"
#include "sim/collision/contact_scenes.hpp"
#include "sim/compile/compile.hpp"
#include "sim/growing_run.hpp"
#include "sim/scenes.hpp"
#include "sinew/bodies.hpp"
#include "sinew/simulation.hpp"
#include "sinew/validate.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdio>
#include <memory>
#include <numbers>
#include <random>
#include <span>
#include <string>
#include <vector>

using namespace sinew;
using namespace sinew::sim;
using Eigen::Vector3d;

namespace {

constexpr float radius = test::ballRadius;
using test::ballAt, test::weightless;

// side^3 balls with `gap` between them, slightly displaced, above a floor within four walls.
Scene clutter(std::uint32_t side, float gap, float friction) {
    Scene scene;
    std::mt19937 random(7);
    std::uniform_real_distribution<float> off(-0.1f * radius, 0.1f * radius);
    const float pitch = 2 * radius + gap, half = 0.5f * static_cast<float>(side) * pitch;
    for (std::uint32_t i = 0; i < side * side * side; ++i) {
        const auto at = [&](std::uint32_t index) {
            return (static_cast<float>(index) + 0.5f) * pitch + off(random);
        };
        scene.particles.push_back(
            ballAt({at(i % side) - half, 0.2f + at(i / side / side), at(i / side % side) - half}));
    }
    scene.contacts.friction = friction;
    const float wall = -half - 0.05f;
    scene.planes = {{.friction = friction},
                    {.normal = {1, 0, 0}, .offset = wall, .friction = friction},
                    {.normal = {-1, 0, 0}, .offset = wall, .friction = friction},
                    {.normal = {0, 0, 1}, .offset = wall, .friction = friction},
                    {.normal = {0, 0, -1}, .offset = wall, .friction = friction}};
    return scene;
}

double deepest(const std::vector<Vector3d>& x) { // [radii]
    return test::deepestOf(x);
}

double rms(const std::vector<Vector3d>& v) {
    double sum = 0;
    for (const Vector3d& one : v) sum += one.squaredNorm();
    return std::sqrt(sum / static_cast<double>(v.size()));
}

// A column of balls on a floor.
Scene column(std::uint32_t count) {
    Scene scene;
    for (std::uint32_t i = 0; i < count; ++i)
        scene.particles.push_back(ballAt({0, radius * static_cast<float>(2 * i + 1), 0}));
    scene.planes = {{}};
    return scene;
}

// Three balls on a floor without friction, and one on top of them.
Scene pyramid(float friction) {
    Scene scene;
    const double side = 2 * double{radius}, out = side / std::sqrt(3.0);
    for (int i = 0; i < 3; ++i) {
        const double angle = 2 * std::numbers::pi * i / 3;
        scene.particles.push_back(ballAt(
            {static_cast<float>(out * std::cos(angle)), radius, static_cast<float>(out * std::sin(angle))}));
    }
    const double height = side * std::sqrt(2.0 / 3);
    scene.particles.push_back(ballAt({0, radius + static_cast<float>(height), 0}));
    scene.contacts.friction = friction;
    scene.planes = {{}};
    return scene;
}

// A fixed layer of touching balls, and balls that fly at it by `way` of their radii in a substep of 1 / 960
// s, above a pit, an edge, a top and points between. Each ball has a place of its own.
Scene bedUnder(std::span<const float> radii, float way) {
    Scene scene = weightless();
    constexpr float pitch = 2 * radius;
    constexpr int width = 12, depth = 4;
    const std::array<std::array<float, 2>, 6> places{{{0, 0},
                                                      {0.5f, 0},
                                                      {0.5f, 0.5f},
                                                      {0.1f, 0.2f},
                                                      {0.25f, 0.25f},
                                                      {0.4f, 0.05f}}}; // relative to the pit [pitches]
    float x = 0;
    for (const float ball : radii) {
        for (const auto& place : places) {
            for (int i = 0; i < width * depth; ++i)
                scene.particles.push_back(
                    test::fixedBallAt({x + pitch * (static_cast<float>(i % width) - 5.5f), 0,
                                       pitch * (static_cast<float>(i / width) - 1.5f)}));
            Particle flying =
                ballAt({x + pitch * place[0], 2 * radius + ball * (1 + 0.37f * way), pitch * place[1]},
                       {0, -960 * way * ball, 0});
            flying.radius = ball;
            scene.particles.push_back(flying);
            x += pitch * width + 0.5f;
        }
    }
    return scene;
}

Vector3d momentum(const Scene& scene, const std::vector<Vector3d>& v) {
    return test::momentumOf(scene, v);
}

std::uint64_t hashOf(const Scene& scene, const Settings& settings, int steps) {
    test::Runner runner(scene, settings);
    const Status status = runner.run(steps);
    EXPECT_EQ(status.nonFinite, 0u);
    EXPECT_EQ(status.contactRoom, 0u);
    return runner.stateHash();
}

} // namespace

TEST(ParticleContacts, OfTwoBallsThatMeetHeadOnEndInTheirCommonVelocity) {
    Scene scene = weightless();
    scene.particles = {ballAt({-0.3f, 0, 0}, {2, 0, 0}, 1), ballAt({0.3f, 0, 0}, {-1, 0, 0}, 3)};
    test::Runner runner(scene, {.substeps = 16});
    runner.run(60);
    const auto v = runner.velocities(), x = runner.positions();
    for (const Vector3d& one : v) EXPECT_LE((one - Vector3d(-0.25, 0, 0)).norm(), 1e-5);
    const double apart = (x[0] - x[1]).norm() / double{radius};
    EXPECT_GE(apart, 2 * (1 - 1e-5));
    EXPECT_LE(apart, 2 * (1 + 1e-3)) << "no rebound";
}

TEST(ParticleContacts, OfBallsThatGrazeEachOtherKeepMomentum) {
    Scene scene = weightless();
    scene.contacts.friction = 0.3f;
    scene.particles = {ballAt({-0.3f, 0.01f, 0}, {2, 0, 0}, 1), ballAt({0.3f, 0, 0.01f}, {-1, 0.5f, 0}, 3)};
    test::Runner runner(scene, {.substeps = 16});
    const Vector3d before = momentum(scene, runner.velocities());
    runner.run(60);
    const auto v = runner.velocities();
    EXPECT_LE((momentum(scene, v) - before).norm(), 1e-6 * 5) << "of 5 kg m/s";
    EXPECT_LT(v[0].x(), 1.9) << "they have met";
}

TEST(ParticleContacts, PartBallsInOnePlaceWithoutMovingTheirCenter) {
    Scene scene = weightless();
    for (int i = 0; i < 5; ++i) scene.particles.push_back(ballAt({0, 0, i % 2 == 0 ? 0.0f : -0.0f}));
    test::Runner runner(scene, {.substeps = 16});
    runner.run(30);
    const auto x = runner.positions(), v = runner.velocities();
    Vector3d center = Vector3d::Zero();
    for (const Vector3d& one : x) center += one / 5;
    EXPECT_LE(center.norm(), 1e-5);
    EXPECT_LE(momentum(scene, v).norm(), 2e-6);
    EXPECT_LE(deepest(x), 0.02) << "[radii]";
    EXPECT_LE(rms(v), 2 * double{scene.contacts.recoverySpeed});
}

// Case 20: a column of four compresses by load h^2 D / omega, a few thousandths of a radius.
TEST(ParticleContacts, CarryAColumnOfFour) {
    test::Runner runner(column(4), {.substeps = 32});
    runner.run(120);
    const auto x = runner.positions();
    std::printf("deepest %.5f r, v rms %.2e m/s\n", deepest(x), rms(runner.velocities()));
    EXPECT_LE(deepest(x), 0.01) << "[radii]";
    EXPECT_LE(rms(runner.velocities()), 1e-4);
    EXPECT_NEAR(x[3].y(), 7 * double{radius}, 0.02 * double{radius});
}

// The contacts are inclined by asin(1 / sqrt 3) = 35.26 degrees. With a friction below tan 35.26 = 0.707, the
// base slides apart.
TEST(ParticleContacts, HoldAPyramidByFrictionAloneAboveItsCoefficient) {
    const auto sunk = [](float friction) {
        test::Runner runner(pyramid(friction), {.substeps = 32});
        const double before = runner.positions()[3].y();
        runner.run(60);
        const double by = (before - runner.positions()[3].y()) / double{radius};
        std::printf("friction %.2f: sunk by %.5f r\n", double{friction}, by);
        return by;
    };
    EXPECT_LE(sunk(0.78f), 0.05);
    EXPECT_GE(sunk(0.63f), 0.5);
}

TEST(ParticleContacts, KeepAFallingPileBelowItsStartAndOutOfItself) {
    test::Runner runner(clutter(6, 0.02f, 0.3f), {.substeps = 16});
    double most = 0, highest = 0, start = 0;
    for (const Vector3d& x : runner.positions()) start = std::max(start, x.y());
    for (int step = 0; step < 150; ++step) {
        const Status status = runner.run(1);
        ASSERT_EQ(status.nonFinite + status.contactRoom, 0u) << "step " << step;
        if (step % 5 != 0) continue;
        const auto x = runner.positions();
        most = std::max(most, deepest(x));
        for (const Vector3d& one : x) highest = std::max(highest, one.y());
    }
    std::printf("deepest %.3f r, at the end %.3f r, v rms %.2e m/s\n", most, deepest(runner.positions()),
                rms(runner.velocities()));
    EXPECT_LE(most, 0.3) << "[radii]";
    EXPECT_LE(highest, start);
    EXPECT_LE(deepest(runner.positions()), 0.1);
    EXPECT_LE(rms(runner.velocities()), 0.01) << "at rest after 2.5 s";
}

namespace {

template <typename T> std::vector<T> contentOf(test::Runner& runner, const std::string& label) {
    const std::vector<BufferSpec>& buffers = runner.simulation().program().buffers;
    const auto found = std::ranges::find(buffers, label, &BufferSpec::label);
    const auto index = static_cast<std::uint32_t>(found - buffers.begin());
    return test::queue().download<T>(runner.simulation().view({index}));
}

// A ball of radius 0.2 m and a tenth of the others' inverse mass, and small ones spread evenly around it.
// Every third touches it after a substep, by `depth`; all are near enough to be in its list.
Scene crowd(std::uint32_t count, float depth, float way) {
    constexpr float wide = 0.2f, small = 0.01f;
    Scene scene = weightless();
    scene.particles.push_back({.inverseMass = 0.1f, .radius = wide});
    for (std::uint32_t i = 0; i < count; ++i) {
        const double height = 1 - (2 * i + 1.0) / count, around = 2.399963 * i;
        const double across = std::sqrt(1 - height * height);
        const Vector3d n{across * std::cos(around), across * std::sin(around), height};
        const double end = double{wide} + double{small} + (i % 3 == 0 ? -double{depth} : 1e-3);
        const double speed = double{way} / double{scene.dt};
        scene.particles.push_back({.position = test::toFloats((end + double{way}) * n),
                                   .velocity = test::toFloats(-speed * n),
                                   .radius = small});
    }
    return scene;
}

} // namespace

// Its list is of several words of marks.
TEST(ParticleContacts, ShareABallAmongAllThatTouchItOfManyCandidates) {
    constexpr float depth = 5e-4f, way = 1e-3f;
    const Scene scene = crowd(150, depth, way);
    test::Runner runner(scene, {.substeps = 1, .contactRoom = 16});
    runner.run(1);
    const std::vector<Vector3d> x = runner.positions();
    constexpr double touching = 50, lambda = double{depth} / (touching * 0.1 + 1);
    Vector3d sum = Vector3d::Zero();
    for (std::size_t i = 1; i < x.size(); ++i) {
        const Vector3d n = test::toVector(scene.particles[i].position).normalized();
        const Vector3d end = test::toVector(scene.particles[i].position) - double{way} * n;
        const bool touches = i % 3 == 1;
        EXPECT_NEAR((x[i] - end - (touches ? lambda : 0) * n).norm(), 0, 1e-6) << "ball " << i;
        if (touches) sum -= lambda * n;
    }
    EXPECT_NEAR((x[0] - 0.1 * sum).norm(), 0, 1e-6);
}

namespace {

// A ball that ends the first step `depth` within another, and a third that stands beyond it, `gap` of their
// reach from touching. None touches another before.
Scene nearlyThree(float depth, double gap) {
    constexpr float way = 1e-3f;
    Scene scene = weightless();
    const float end = 2 * radius - depth, beyond = static_cast<float>((1 + gap) * 2 * double{radius});
    scene.particles = {ballAt({0, 0, 0}), ballAt({end + way, 0, 0}, {-way / scene.dt, 0, 0}),
                       ballAt({-beyond, 0, 0})};
    return scene;
}

} // namespace

// The share of a ball falls evenly while another comes near, so that it does not jump where that one touches.
TEST(ParticleContacts, ShareABallWithOneThatHardlyMissesItWhateverTheMargin) {
    constexpr float depth = 5e-4f;
    constexpr double band = double{SHARE_BAND};
    for (const double gap : {0.0, 0.1, 0.5, 0.9, 1.1, 20.0}) { // [bands]
        const Scene scene = nearlyThree(depth, gap * band + 1e-6);
        const double apart = 1 + gap * band;
        const double weight = std::max(0.0, 1 - (apart * apart - 1) / (band * (2 + band)));
        std::vector<std::uint64_t> hashes;
        for (const float margin : {0.001f, 0.05f, 0.5f, 2.0f}) { // 0.001: an eighth of the band
            test::Runner runner(scene, {.substeps = 1, .contactMargin = margin});
            runner.run(1);
            const double moved = -runner.positions()[0].x();
            EXPECT_NEAR(moved, double{depth} / (2 + weight), 2e-7) << gap << " bands, margin " << margin;
            hashes.push_back(runner.stateHash());
            EXPECT_EQ(hashes.back(), hashes.front()) << gap << " bands, margin " << margin;
        }
    }
}

namespace {

// Balls that fall into a narrow box.
Scene heap(std::uint32_t seed) {
    constexpr float half = 0.2f, height = 7.17f;
    Scene scene;
    addParticles(scene, {.center = {0, 0.5f * height + 0.1f, 0},
                         .random = 500,
                         .size = {2 * half, height, 2 * half},
                         .seed = seed,
                         .radius = radius,
                         .mass = 0.5235988f});
    scene.contacts.friction = 0.3f;
    scene.planes = {{.friction = 0.3f}};
    for (const float side : {1.0f, -1.0f}) {
        scene.planes.push_back({.normal = {side, 0, 0}, .offset = -half, .friction = 0.3f});
        scene.planes.push_back({.normal = {0, 0, side}, .offset = -half, .friction = 0.3f});
    }
    return scene;
}

} // namespace

// With shares that jump where a contact opens, these three heaps tremble for ever, with 0.1 to 3 mJ.
TEST(ParticleContacts, ComeToRestInAHighHeap) {
    for (const std::uint32_t seed : {6u, 7u, 11u}) {
        const Scene scene = heap(seed);
        test::Runner runner(scene, {.substeps = 8, .contactRoom = 16});
        double most = 0;
        for (const int steps : {225, 5, 5, 5}) {
            runner.run(steps);
            most = std::max(most, test::kineticEnergy(scene, runner.velocities()));
        }
        std::printf("heap %u: kinetic energy %.1e J, deepest %.2f r\n", seed, most,
                    deepest(runner.positions()));
        EXPECT_LE(most, 1e-6) << "[J], seed " << seed;
    }
}

// Friction forgets a pair in the substep in which the two part.
TEST(ParticleContacts, RememberNothingOfCandidatesThatDoNotTouch) {
    test::Runner runner(clutter(6, 0.02f, 0.3f), {.substeps = 16});
    std::size_t remembered = 0;
    for (int step = 0; step < 60; ++step) {
        runner.run(1);
        const auto lists = contentOf<std::array<std::uint32_t, 2>>(runner, "pairs.lists");
        const auto contacts = contentOf<std::array<float, 2>>(runner, "pairs.contacts");
        const auto memory = contentOf<std::array<float, 4>>(runner, "pairs.memory");
        const auto touching = contentOf<std::array<float, 4>>(runner, "contacts.touching");
        for (std::size_t i = 0; i < lists.size(); ++i)
            for (std::uint32_t element = lists[i][0]; element < lists[i][0] + lists[i][1]; ++element) {
                const auto other = std::bit_cast<std::uint32_t>(contacts[element][0]);
                const auto at = [&](std::size_t p) {
                    return Vector3d(double{touching[p][0]}, double{touching[p][1]}, double{touching[p][2]});
                };
                const bool isRemembered = memory[element][0] != 0 || memory[element][1] != 0;
                remembered += isRemembered ? 1 : 0;
                const double apart = (at(i) - at(other)).norm() - double{contacts[element][1]};
                ASSERT_FALSE(isRemembered && apart > 1e-6) << "step " << step << ", " << i << ", " << other;
            }
    }
    EXPECT_GT(remembered, 1000u);
}

// Blocks on a grid, whose state has slots without particles, and blocks of listed links. Particles touch
// those of the other body and none of their own.
TEST(ParticleContacts, LayABlockOntoABlock) {
    constexpr float spacing = 0.1f;
    Scene scene = test::block(2, spacing, 2e5f);
    const std::size_t lower = scene.particles.size();
    addLattice(scene, {.name = "upper",
                       .origin = {0, 0.32f, 0},
                       .cells = {2, 2, 2},
                       .spacing = spacing,
                       .youngModulus = 2e5f});
    for (Particle& particle : scene.particles) particle.radius = spacing / 2;
    scene.planes = {{.friction = 0.5f}};
    scene.contacts.friction = 0.5f; // else the upper block slides off the balls
    scene.damping = 2;
    std::vector<double> gaps;
    for (const bool usesGrids : {true, false}) {
        Settings settings{.substeps = 32};
        settings.forms.usesGrids = usesGrids;
        test::Runner runner(scene, settings);
        ASSERT_EQ(runner.run(60).nonFinite, 0u);
        const double ringing = rms(runner.velocities());
        ASSERT_EQ(runner.run(120).nonFinite, 0u);
        const auto x = runner.positions();
        double top = 0, bottom = 1;
        for (std::size_t i = 0; i < x.size(); ++i) {
            if (i < lower)
                top = std::max(top, x[i].y());
            else
                bottom = std::min(bottom, x[i].y());
        }
        gaps.push_back(bottom - top);
        EXPECT_NEAR(bottom - top, double{spacing}, 0.02 * double{spacing});
        EXPECT_NEAR(top, 0.2, 0.01) << "not blown up by contacts of its own";
        EXPECT_LE(rms(runner.velocities()), 0.25 * ringing) << "elastic bodies ring, and less and less";
    }
    std::printf("gaps %.5f and %.5f m\n", gaps[0], gaps[1]);
    EXPECT_EQ(hashOf(scene, {.substeps = 8, .isReversed = true}, 30), hashOf(scene, {.substeps = 8}, 30));
}

// A substep moves a ball from the outside to behind a layer. In a pit, four contacts share the impulse that
// stops it.
class BedOfBalls : public testing::TestWithParam<float> {};

TEST_P(BedOfBalls, HoldsABallAtAnyWayOfASubstep) {
    const float way = GetParam();
    const std::array<float, 3> radii{radius, 1.7f * radius, 4 * radius};
    const Scene scene = bedUnder(radii, way);
    test::Runner runner(scene, {.substeps = 16});
    runner.run(way < 1 ? 6 : 3);
    const auto x = runner.positions(), v = runner.velocities();
    for (std::size_t i = 0; i < x.size(); ++i) {
        if (scene.particles[i].inverseMass == 0) continue;
        const double ball = double{scene.particles[i].radius} / double{radius};
        EXPECT_GE(x[i].y(), 0.3 * double{radius}) << "ball of " << ball << " radii at " << i;
        EXPECT_LE(v[i].norm(), 960 * double{way} * ball * double{radius})
            << "ball of " << ball << " radii at " << i;
    }
}

INSTANTIATE_TEST_SUITE_P(Ways, BedOfBalls,
                         testing::Values(0.5f, 0.6f, 0.7f, 0.8f, 0.9f, 0.95f, 1.0f, 1.2f, 2.0f, 5.0f, 20.0f,
                                         100.0f));

TEST(ParticleContacts, EndInTheSameBitsForAnyMarginRoomOrderAndForm) {
    for (const float friction : {0.0f, 0.3f}) {
        const Scene scene = clutter(6, 0.02f, friction);
        const Settings settings{.substeps = 8};
        const std::uint64_t hash = hashOf(scene, settings, 40);
        Settings narrow = settings, roomy = settings, reversed = settings, loads = settings;
        narrow.contactMargin = 0.25f;
        roomy.contactRoom = 40;
        reversed.isReversed = true;
        loads.forms.usesTexels = false;
        EXPECT_EQ(hashOf(scene, narrow, 40), hash) << "another margin";
        EXPECT_EQ(hashOf(scene, roomy, 40), hash) << "more room";
        EXPECT_EQ(hashOf(scene, reversed, 40), hash) << "reversed";
        EXPECT_EQ(hashOf(scene, loads, 40), hash) << "without texels";
    }
}

// Hard case 29: a step that lacks capacity is undone and reported, and a simulation with larger capacity
// repeats it. No contact is lost.
TEST(ParticleContacts, ThatHaveNoRoomAreSaidAndRepeatedToTheSameBits) {
    const Scene scene = clutter(5, 0.02f, 0.3f);
    constexpr int steps = 50;
    const std::uint64_t hash = hashOf(scene, {.substeps = 8, .contactRoom = 64}, steps);
    const auto run = test::runGrowing(scene, {.substeps = 8}, steps);
    EXPECT_EQ(run.growths, 1) << "what is needed is said exactly";
    EXPECT_EQ(run.hash, hash);
}

// A hanging, tethered chain with damped links, and a ball that is dragged through loose balls on a floor.
TEST(ParticleContacts, StandBesideAttachmentsTethersAndInternalDamping) {
    Scene scene = test::hangingChain(6, 0.15f, 0.5f, 1e-4f);
    for (Particle& particle : scene.particles) particle.radius = radius;
    addTethers(scene, {.first = 0, .count = 7});
    scene.dampingTime = 0.002f;
    const auto dragged = static_cast<std::uint32_t>(scene.particles.size());
    scene.particles.push_back(ballAt({-0.4f, -1.15f + radius, 0}));
    for (int i = 0; i < 6; ++i)
        scene.particles.push_back(ballAt({-0.25f + 0.11f * static_cast<float>(i), -1.15f + radius, 0.02f}));
    scene.attachments = {
        {.particle = dragged, .anchor = scene.particles[dragged].position, .compliance = 1e-4f}};
    scene.planes = {{.offset = -1.15f, .friction = 0.4f}};
    scene.contacts = {.friction = 0.4f, .restitution = 0.3f};
    const auto run = [&](const Settings& settings) {
        auto runner = std::make_unique<test::Runner>(scene, settings);
        for (int step = 0; step < 90; ++step) {
            const Vec3 target{-0.4f + 0.01f * static_cast<float>(step), -1.15f + radius, 0};
            const Status status = runner->step(scene.dt, std::span(&target, 1));
            EXPECT_EQ(status.nonFinite + status.contactRoom, 0u) << "step " << step;
        }
        return runner;
    };
    const auto runner = run({.substeps = 16});
    const auto x = runner->positions();
    std::printf("dragged to %.4f m (0.49), deepest %.4f r\n", x[dragged].x(), deepest(x));
    EXPECT_NEAR(x[dragged].x(), 0.49, 0.02);
    EXPECT_LE(deepest(x), 0.05);
    for (std::size_t i = dragged + 1; i < x.size(); ++i)
        EXPECT_TRUE(x[i].x() > x[dragged].x() || std::abs(x[i].z()) > radius)
            << "ball " << i << " is in the way";
    for (std::size_t i = 1; i <= 6; ++i)
        EXPECT_LE((x[i] - x[0]).norm(), 0.15 * static_cast<double>(i) * 1.01) << "tethered";
    EXPECT_EQ(run({.substeps = 16, .isReversed = true})->stateHash(), runner->stateHash());
    EXPECT_EQ(run({.substeps = 16, .contactMargin = 0.2f})->stateHash(), runner->stateHash());
}

TEST(ParticleContacts, AreRefusedBySolversWithoutAFormForThem) {
    for (const Solver solver : {Solver::jacobi, Solver::gaussSeidel}) {
        const auto complaints = validate(column(2), {.solver = solver});
        ASSERT_EQ(complaints.size(), 1u);
        EXPECT_NE(complaints[0].find("does not support particles that touch"), std::string::npos);
        EXPECT_TRUE(validate(column(1), {.solver = solver}).empty()) << "one cannot touch";
    }
}

TEST(ParticleContacts, LeaveASceneWithoutThemAlone) {
    Scene scene = column(3);
    for (Particle& particle : scene.particles) particle.radius = 0;
    const StepProgram program = compile(scene, {.substeps = 2});
    for (const BufferSpec& buffer : program.buffers) {
        EXPECT_EQ(buffer.label.find("grid"), std::string::npos) << buffer.label;
        EXPECT_TRUE(buffer.label == "contact_offsets" || buffer.label.find("contact") == std::string::npos);
    }
    EXPECT_TRUE(std::ranges::none_of(program[List::step], &Pass::isIndirect));
}
