// Tests of sleep: bodies at rest fall asleep, keep their positions exactly and cost nothing; every wake
// condition works.
#include "common/layout.h"
#include "sim/collision/contact_scenes.hpp"
#include "sim/compile/compile.hpp"
#include "sim/runner.hpp"
#include "sim/scenes.hpp"
#include "sinew/bodies.hpp"
#include "sinew/start.hpp"
#include "sinew/validate.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <optional>
#include <random>
#include <regex>
#include <set>

using namespace sinew;
using namespace sinew::sim;
using Eigen::Vector3d;

namespace {

constexpr float radius = test::ballRadius;
using test::ballAt;

// Adds side^3 balls around (x, 0), slightly apart, that fall a short way onto a floor.
void addHeap(Scene& scene, std::uint32_t side, float x) {
    const float pitch = 2.3f * radius;
    test::addBalls(scene, side, pitch, 0.1f * radius,
                   {x, 0.02f + 0.5f * static_cast<float>(side) * pitch, 0});
}

Scene heap(std::uint32_t side = 5) {
    Scene scene;
    addHeap(scene, side, 0);
    scene.contacts.friction = 0.5f;
    scene.planes = {{.friction = 0.5f}};
    return scene;
}

const Settings sleeping{.substeps = 16, .sleeps = true};

// Number of steps until `sleepers` particles sleep, at most `most`; -1 if they do not.
int stepsUntilAsleep(test::Runner& runner, std::uint32_t sleepers, int most = 600) {
    for (int step = 1; step <= most; ++step) {
        const Status status = runner.run(1);
        EXPECT_EQ(status.nonFinite + status.contactRoom, 0u) << "step " << step;
        if (status.sleeping == sleepers) return step;
    }
    return -1;
}

std::uint32_t countOf(const Scene& scene) {
    return static_cast<std::uint32_t>(scene.particles.size());
}

double farthest(const std::vector<Vector3d>& a, const std::vector<Vector3d>& b) {
    double most = 0;
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
        most = std::max(most, (a[i] - b[i]).norm());
    return most;
}

// Work groups that the indirect dispatches of the next step would run, and those that direct ones always run.
struct Groups {
    std::uint64_t indirect = 0, direct = 0;
};

Groups groupsOf(test::Runner& runner) {
    const StepProgram& program = runner.simulation().program();
    Groups groups;
    for (const Pass& pass : program[List::step]) {
        if (pass.kind != PassKind::dispatch) continue;
        const std::uint32_t size = program.kernels[pass.kernel].interface.groupSize[0];
        if (!pass.isIndirect) {
            groups.direct += (pass.items - 1) / size + 1;
            continue;
        }
        const auto arguments = test::queue().download<layout::DispatchArguments>(
            runner.simulation().view(pass.uses.back().buffer));
        groups.indirect += arguments[pass.value].groupsX;
    }
    return groups;
}

// A heap at rest, and last a ball of five times the mass of one of it, which falls onto it from 1.6 m.
Scene heapBelowABall() {
    Settings never = sleeping;
    never.sleeps = false;
    Scene scene = heap(4);
    test::Runner settled(scene, never);
    settled.run(200);
    const auto x = settled.positions();
    double top = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        scene.particles[i].position = test::toFloats(x[i]);
        scene.particles[i].velocity = {};
        top = std::max(top, x[i].y());
    }
    scene.particles.push_back(ballAt({0.01f, static_cast<float>(top) + 1.6f, 0.005f}, {}, 5));
    return scene;
}

} // namespace

TEST(Sleep, ComesOverAHeapThatThenStaysWhereItIsBitForBit) {
    const Scene scene = heap();
    test::Runner runner(scene, sleeping);
    const int steps = stepsUntilAsleep(runner, countOf(scene));
    std::printf("asleep after %d steps\n", steps);
    ASSERT_GT(steps, 30) << "half a second";
    const auto x = runner.positions();
    runner.run(1);
    const std::uint64_t hash = runner.stateHash();
    for (const Vector3d& v : runner.velocities()) EXPECT_EQ(v, Vector3d::Zero());
    EXPECT_EQ(runner.run(100).sleeping, countOf(scene));
    EXPECT_EQ(runner.stateHash(), hash);
    EXPECT_EQ(farthest(runner.positions(), x), 0);
}

// A pair that keeps its overlap pushes nothing, but one that is awake would wake the other: both are one
// island, though they come to rest at different times.
TEST(Sleep, ComesOverAPairThatKeepsItsOverlap) {
    Scene scene;
    scene.gravity = {};
    scene.damping = 2;
    for (const float x : {0.0f, 1.5f * radius}) {
        Particle ball = ballAt({x, 0, 0});
        ball.keepsRest = true;
        scene.particles.push_back(ball);
    }
    scene.particles[1].velocity = {0, 0, 0.5f * radius};
    test::Runner runner(scene, sleeping);
    const int steps = stepsUntilAsleep(runner, 2);
    std::printf("asleep after %d steps\n", steps);
    EXPECT_GT(steps, 30);
    EXPECT_EQ(runner.run(60).sleeping, 2u) << "they stay asleep";
}

// One margin is so small that even the last substep before sleep builds lists.
TEST(Sleep, CostsNoGroupButThoseOfAFewSmallPasses) {
    for (const float margin : {0.5f, 1e-7f}) {
        Settings settings = sleeping;
        settings.contactMargin = margin;
        test::Runner runner(heap(), settings);
        const Groups awake = groupsOf(runner);
        ASSERT_GT(stepsUntilAsleep(runner, 125), 0);
        runner.run(3);
        const Groups asleep = groupsOf(runner);
        std::printf("groups: awake %llu, asleep %llu, and %llu always\n",
                    static_cast<unsigned long long>(awake.indirect),
                    static_cast<unsigned long long>(asleep.indirect),
                    static_cast<unsigned long long>(asleep.direct));
        EXPECT_EQ(asleep.indirect, 0u) << margin;
        EXPECT_LE(asleep.direct, 3u) << "whether anything wakes, and whether anything was judged";
        EXPECT_GE(awake.indirect, 16u * 5);
    }
}

TEST(Sleep, EndsInTheSameBitsForAnyOrderAndMarginAndForm) {
    const Scene scene = heap();
    constexpr int steps = 150;
    const auto hash = [&](const Settings& settings) { return test::hashOfRun(scene, settings, steps); };
    Settings reversed = sleeping, narrow = sleeping, loads = sleeping;
    reversed.isReversed = true;
    narrow.contactMargin = 0.25f;
    loads.forms.usesTexels = false;
    EXPECT_EQ(hash(reversed), hash(sleeping));
    EXPECT_EQ(hash(narrow), hash(sleeping));
    EXPECT_EQ(hash(loads), hash(sleeping));
}

// Lists are not checked for particles that sleep. A large body that flies at a small one at rest had a frame
// that both shared, in which the sleeping one was expected to move, so that pairs were found late or never.
TEST(Sleep, OfASmallBodyEndsInTheSameBitsForAnyMarginWhereALargeOneHitsIt) {
    Scene scene = test::weightless();
    addLattice(scene, {.cells = {3, 3, 3}, .spacing = 0.05f, .youngModulus = 1e6f, .radius = 0.025f});
    const std::uint32_t small = countOf(scene);
    const std::size_t large = scene.bodies.size();
    addLattice(scene, {.origin = {-0.15f, 12.0f, -0.15f},
                       .cells = {8, 8, 8},
                       .spacing = 0.05f,
                       .youngModulus = 1e6f,
                       .radius = 0.025f});
    start(scene, large, {.velocity = {0, -15, 0}});
    std::optional<std::uint64_t> hash;
    for (const float margin : {0.3f, 0.5f, 0.8f}) {
        Settings settings{.substeps = 64, .contactMargin = margin, .contactRoom = 100, .sleeps = true};
        test::Runner runner(scene, settings);
        EXPECT_EQ(runner.run(44).sleeping, small) << "before the impact";
        EXPECT_EQ(runner.run(8).sleeping, 0u) << "after it";
        const std::uint64_t one = runner.stateHash();
        EXPECT_EQ(hash.value_or(one), one) << "margin " << margin;
        hash = one;
    }
}

// Before any particle sleeps, both runs are equal.
TEST(Sleep, ChangesNoBitOfWhatIsAwake) {
    Settings never = sleeping;
    never.sleeps = false;
    EXPECT_EQ(test::hashOfRun(heap(), sleeping, 30), test::hashOfRun(heap(), never, 30));
}

// Without gravity, resting bodies keep their positions exactly, asleep or not. After the impact, which passes
// from ball to ball, the motion must equal that without sleep.
TEST(Sleep, OfACloudThatIsStruckEndsInTheBitsOfOneThatNeverSlept) {
    for (const float restitution : {0.0f, 0.5f}) {
        Scene scene = test::weightless();
        test::addBalls(scene, 4, 2.1f * radius, 0.02f * radius, {});
        const std::uint32_t cloud = countOf(scene);
        scene.particles.push_back(ballAt({-4, 0.01f, 0.02f}, {5, 0, 0}, 3));
        scene.contacts.friction = 0.5f;
        scene.contacts.restitution = restitution;
        Settings never = sleeping;
        never.sleeps = false;
        test::Runner slept(scene, sleeping), awake(scene, never);
        bool slumbered = false;
        std::uint32_t least = cloud;
        for (int step = 0; step < 80; ++step) {
            const Status status = slept.run(1);
            awake.run(1);
            slumbered = slumbered || status.sleeping == cloud;
            if (slumbered) least = std::min(least, status.sleeping);
            ASSERT_EQ(slept.positions(), awake.positions()) << "step " << step;
            ASSERT_EQ(slept.velocities(), awake.velocities()) << "step " << step;
        }
        std::printf("e %.1f: of %u balls %u still sleep\n", double{restitution}, cloud, least);
        EXPECT_TRUE(slumbered);
        EXPECT_LE(least, cloud / 2);
    }
}

// The ball scatters the sleeping heap.
TEST(Sleep, EndsWhenABallFallsOntoAHeapWhichThenMovesAsIfItHadNeverSlept) {
    Settings never = sleeping;
    never.sleeps = false;
    const Scene scene = heapBelowABall();
    std::vector<Vector3d> x;
    for (const Particle& particle : scene.particles) x.push_back(test::toVector(particle.position));
    x.pop_back();
    test::Runner slept(scene, sleeping), awake(scene, never);
    std::uint32_t sleepers = 0;
    int since = -1; // number of steps awake
    double moved = 0, apart = 0, deep = 0, deepAwake = 0;
    for (int step = 0; step < 60 && since < 6; ++step) {
        const Status status = slept.run(1);
        awake.run(1);
        if (sleepers == x.size() && status.sleeping < sleepers && since < 0) since = 0;
        sleepers = status.sleeping;
        if (since < 0) continue;
        ++since;
        const auto a = slept.positions(), b = awake.positions();
        deep = std::max(deep, test::deepestOf(a));
        deepAwake = std::max(deepAwake, test::deepestOf(b));
        apart = farthest(a, b) / double{radius};
        moved = farthest(b, x) / double{radius};
    }
    std::printf(
        "woken for %d steps, %u still asleep: %.4f r from where all would be without sleep, moved by %.3f r; "
        "deepest %.4f r (%.4f)\n",
        since, sleepers, apart, moved, deep, deepAwake);
    EXPECT_EQ(since, 6) << "later each goes its own way, as heaps do";
    EXPECT_GE(moved, 0.5) << "or there is nothing to compare";
    EXPECT_LE(apart, 0.002 * moved);
    EXPECT_LE(deep, 1.02 * deepAwake) << "woken before it was touched";
    EXPECT_GT(stepsUntilAsleep(slept, countOf(scene)), 0) << "and sleeps again";
}

// Substep by substep, with balls that are struck in one: those that wake lacked the gravity of that substep,
// g h = 0.0102 m/s.
TEST(Sleep, EndsWithTheGravityOfTheSubstepInWhichAHeapWakes) {
    const Settings never{.substeps = 1}, sleeps{.substeps = 1, .sleeps = true};
    Scene scene = heapBelowABall();
    const std::size_t ofHeap = scene.particles.size() - 1;
    scene.dt /= 16;
    for (const bool takesRecoils : {false, true}) {
        scene.contacts.takesRecoils = takesRecoils;
        test::Runner slept(scene, sleeps), awake(scene, never);
        bool slumbered = false;
        int since = 0; // number of substeps awake
        double apart = 0;
        for (int substep = 0; substep < 700 && since < 32; ++substep) {
            const std::uint32_t sleepers = slept.run(1).sleeping;
            awake.run(1);
            slumbered = slumbered || sleepers == ofHeap;
            if (!slumbered || sleepers == ofHeap) continue;
            ++since;
            apart = std::max(apart, farthest(slept.velocities(), awake.velocities()));
        }
        std::printf("recoils %d: velocities differ by at most %.5f m/s\n", takesRecoils, apart);
        EXPECT_EQ(since, 32);
        // Recoils begin at a speed, and enlarge what differs there.
        EXPECT_LT(apart, (takesRecoils ? 1 : 0.3) * 9.81 * double{scene.dt});
    }
}

TEST(Sleep, DoesNotComeOverABodyAtTheTopOfAThrow) {
    Scene scene;
    scene.particles = {ballAt({0, 1, 0}, {0, 4, 0})};
    scene.planes = {{}};
    test::Runner runner(scene, sleeping);
    for (int step = 0; step < 48; ++step) EXPECT_EQ(runner.run(1).sleeping, 0u) << "step " << step;
}

TEST(Sleep, DoesNotComeOverWhatCreeps) {
    Scene scene = test::weightless();
    scene.particles = {ballAt({}, {0.003f, 0, 0}),
                       ballAt({1, 0, 0}, {0.001f, 0, 0})}; // 0.03 r, 0.01 r in 0.5 s
    test::Runner runner(scene, sleeping);
    EXPECT_EQ(runner.run(120).sleeping, 1u);
    EXPECT_NEAR(runner.positions()[0].x(), 0.006, 1e-5);
}

TEST(Sleep, OfOneHeapGoesOnWhileAnotherWakes) {
    Scene scene = heap(5);
    addHeap(scene, 5, 3);
    scene.particles.push_back(ballAt({3, 20, 0}));
    test::Runner runner(scene, sleeping);
    ASSERT_GT(stepsUntilAsleep(runner, 250), 0);
    std::vector<Vector3d> before = runner.positions();
    std::uint32_t least = 250;
    for (int step = 0; step < 120; ++step) least = std::min(least, runner.run(1).sleeping);
    EXPECT_LT(least, 250u);
    EXPECT_GE(least, 125u);
    const auto after = runner.positions();
    double first = 0, second = 0;
    for (std::size_t i = 0; i < 125; ++i) first = std::max(first, (after[i] - before[i]).norm());
    for (std::size_t i = 125; i < 250; ++i) second = std::max(second, (after[i] - before[i]).norm());
    EXPECT_EQ(first, 0);
    EXPECT_GT(second, 0);
}

TEST(Sleep, EndsWithAnotherGravityAnotherStepAndByWish) {
    const Scene scene = heap(3);
    for (int reason = 0; reason < 3; ++reason) {
        test::Runner runner(scene, sleeping);
        ASSERT_GT(stepsUntilAsleep(runner, 27), 0);
        Step step{.dt = scene.dt, .gravity = scene.gravity};
        if (reason == 0) step.gravity.x = 0.5f;
        if (reason == 1) step.dt *= 0.5f;
        if (reason == 2) step.wakes = true;
        EXPECT_EQ(runner.step(step).sleeping, 0u) << "reason " << reason;
        step.wakes = false;
        EXPECT_EQ(runner.step(step).sleeping, 0u) << "reason " << reason;
    }
}

TEST(Sleep, EndsWithTheAnchorThatMoves) {
    Scene scene = test::hangingChain(6, 0.1f, 0.1f, 1e-5f);
    const std::uint32_t links = countOf(scene) - 1;
    scene.particles.push_back({.position = {2, 0, 0}});
    scene.particles.push_back({.position = {4, 0, 0}});
    scene.attachments = {{.particle = links + 1, .anchor = {2, 0, 0}, .compliance = 1e-4f},
                         {.particle = links + 2, .anchor = {4, 0, 0}, .compliance = 1e-4f}};
    scene.damping = 5;
    test::Runner runner(scene, sleeping);
    ASSERT_GT(stepsUntilAsleep(runner, links + 2), 0);
    const auto before = runner.positions();
    const std::vector<Vec3> anchors{{2, 0, 0}, {4.1f, 0, 0}};
    EXPECT_EQ(runner.step(scene.dt, anchors).sleeping, links + 1) << "all but what the second holds";
    EXPECT_EQ(stepsUntilAsleep(runner, links + 2) > 30, true);
    const auto after = runner.positions();
    EXPECT_NEAR(after.back().x() - before.back().x(), 0.1, 0.002);
    for (std::size_t i = 0; i + 1 < after.size(); ++i) EXPECT_EQ(after[i], before[i]);
}

// A ball on a distant fixed plate, and one on a plate that sinks after four seconds.
TEST(Sleep, EndsWithTheColliderThatMovesBelowIt) {
    Scene scene;
    scene.particles = {ballAt({0, 0.16f, 0}), ballAt({0, 0.2601f, 0}), ballAt({3, 0.16f, 0})};
    scene.contacts.friction = 0.5f;
    const Collider plate{.shape = ColliderShape::box,
                         .halfExtents = {0.3f, 0.1f, 0.3f},
                         .friction = 0.5f,
                         .pose = {.position = {3, 0, 0}}};
    Collider lift = plate;
    lift.path = {{.time = 4, .pose = {}}, {.time = 5, .pose = {.position = {0, -0.2f, 0}}}};
    scene.colliders = {plate, lift};
    test::Runner runner(scene, sleeping);
    ASSERT_GT(stepsUntilAsleep(runner, 3, 230), 0);
    std::uint32_t least = 3;
    for (int step = 0; step < 320; ++step) least = std::min(least, runner.run(1).sleeping);
    EXPECT_EQ(least, 1u) << "the upper ball wakes with the lower one";
    const auto x = runner.positions();
    EXPECT_NEAR(x[0].y(), -0.05, 1e-3);
    EXPECT_NEAR(x[1].y(), 0.05, 1e-3);
    EXPECT_NEAR(x[2].y(), 0.15, 1e-3);
}

TEST(Sleep, ComesOverALatticeOnAFloorAndEndsWhenABallHitsIt) {
    for (const bool usesGrids : {true, false}) {
        Scene scene = test::block(3, 0.1f, 2e5f, 0.01f);
        for (Particle& particle : scene.particles) particle.radius = 0.05f;
        const std::uint32_t nodes = countOf(scene);
        scene.particles.push_back(ballAt({0.15f, 12, 0.15f}));
        scene.planes = {{.friction = 0.5f}};
        scene.contacts.friction = 0.5f;
        scene.damping = 2;
        Settings settings = sleeping;
        settings.forms.usesGrids = usesGrids;
        test::Runner runner(scene, settings);
        ASSERT_GT(stepsUntilAsleep(runner, nodes), 0) << "grids " << usesGrids;
        const auto before = runner.positions();
        bool woke = false;
        for (int step = 0; step < 200 && !woke; ++step) woke = runner.run(1).sleeping == 0;
        EXPECT_TRUE(woke);
        EXPECT_EQ(stepsUntilAsleep(runner, nodes + 1) > 0, true);
        EXPECT_GT((runner.positions()[0] - before[0]).norm(), 0);
    }
}

namespace {

// `layers` sheets at rest above each other on a table of triangles.
Scene clothOnTable(std::uint32_t layers) {
    Scene scene;
    addMeshCollider(scene, {.vertices = {{-1, 0, -1}, {-1, 0, 1}, {1, 0, 1}, {1, 0, -1}},
                            .triangles = {{0, 1, 2}, {0, 2, 3}},
                            .thickness = 0.01f});
    for (std::uint32_t layer = 0; layer < layers; ++layer)
        addCloth(scene, {.origin = {-0.1f + 0.01f * static_cast<float>(layer),
                                    0.0201f + 0.0201f * static_cast<float>(layer), -0.1f},
                         .size = {5, 5},
                         .spacing = 0.05f,
                         .areaDensity = 0.3f,
                         .membraneStiffness = 300,
                         .thickness = 0.02f});
    scene.contacts.friction = 0.5f;
    scene.damping = 2;
    return scene;
}

const Settings roomy{.substeps = 16, .contactRoom = 96, .sleeps = true};

} // namespace

TEST(Sleep, ComesOverClothOnAMeshAndEndsWhenABallFallsOntoIt) {
    Scene scene = clothOnTable(2);
    const std::uint32_t cloth = countOf(scene) - 4;
    scene.particles.push_back(ballAt({0.02f, 6, 0.01f}, {}, 0.005f));
    test::Runner runner(scene, roomy);
    ASSERT_GT(stepsUntilAsleep(runner, cloth, 70), 30) << "half a second";
    const auto before = runner.positions();
    bool woke = false;
    int steps = 0;
    for (; steps < 150 && !woke; ++steps) {
        const Status status = runner.run(1);
        ASSERT_EQ(status.nonFinite + status.contactRoom, 0u);
        woke = status.sleeping == 0;
        if (status.sleeping != cloth) continue;
        const auto x = runner.positions();
        for (std::size_t i = 0; i + 1 < before.size(); ++i) ASSERT_EQ(x[i], before[i]);
    }
    EXPECT_TRUE(woke) << "both sheets";
    const auto after = runner.positions();
    EXPECT_GE(after.back().y(), 0.02 + 2 * 0.02) << "the ball is above both";
    EXPECT_EQ(stepsUntilAsleep(runner, cloth + 1) > 0, true) << "all rest again";
    const auto x = runner.positions();
    for (std::size_t i = 4; i + 1 < x.size(); ++i) EXPECT_GE(x[i].y(), 0.0195) << "particle " << i;
}

// Tests several placements: for most, contacts between the sheets keep moving them by hundredths of a
// millimetre.
TEST(Sleep, ComesOverClothWhereverItLies) {
    std::mt19937 random(1);
    std::uniform_int_distribution<int> nudge(-4, 4);
    for (int trial = 0; trial < 8; ++trial) {
        Scene scene = clothOnTable(2);
        const std::uint32_t cloth = countOf(scene) - 4;
        for (std::size_t i = 4; i < scene.particles.size(); ++i) {
            scene.particles[i].position.x += 1e-6f * static_cast<float>(trial * nudge(random));
            scene.particles[i].position.z += 1e-6f * static_cast<float>(trial * nudge(random));
        }
        test::Runner runner(scene, roomy);
        const int steps = stepsUntilAsleep(runner, cloth, 70);
        EXPECT_GT(steps, 30) << "trial " << trial;
    }
}

// A ball that falls beside the cloth causes new lists. Sleeping particles must stay listed with the faces
// below them.
TEST(Sleep, OfClothOnAMeshEndsByWishWhereItCameToRest) {
    Scene scene = clothOnTable(2);
    const std::uint32_t cloth = countOf(scene) - 4;
    scene.particles.push_back(ballAt({0.7f, 6, 0.6f}, {}, 0.05f));
    std::set<std::uint64_t> hashes;
    for (const float margin : {0.5f, 0.15f}) {
        Settings settings = roomy;
        settings.contactMargin = margin;
        test::Runner runner(scene, settings);
        ASSERT_GT(stepsUntilAsleep(runner, cloth, 70), 30);
        const auto before = runner.positions();
        runner.run(15);
        Step step{.dt = scene.dt};
        step.wakes = true;
        EXPECT_EQ(runner.step(step).sleeping, 0u);
        runner.run(5);
        const auto after = runner.positions();
        double farthestOff = 0;
        for (std::size_t i = 4; i + 1 < after.size(); ++i)
            farthestOff = std::max(farthestOff, (after[i] - before[i]).norm());
        std::printf("cloth woken: %.2e m from where it slept\n", farthestOff);
        EXPECT_LE(farthestOff, 5e-4);
        hashes.insert(runner.stateHash());
    }
    EXPECT_EQ(hashes.size(), 1u) << "another margin";
}

TEST(Sleep, OfClothEndsInTheSameBitsInAnyOrder) {
    Scene scene = clothOnTable(2);
    scene.particles.push_back(ballAt({0.02f, 5, 0.01f}, {}, 0.005f));
    Settings reversed = roomy;
    reversed.isReversed = true;
    EXPECT_EQ(test::hashOfRun(scene, roomy, 80), test::hashOfRun(scene, reversed, 80));
}

TEST(Sleep, SurvivesAStepThatIsUndone) {
    const Scene scene = heap(3);
    test::Runner runner(scene, sleeping);
    ASSERT_GT(stepsUntilAsleep(runner, 27), 0);
    runner.run(3);
    const std::uint64_t before = runner.stateHash();
    Step wild{.dt = scene.dt, .gravity = {0, std::numeric_limits<float>::quiet_NaN(), 0}};
    EXPECT_GT(runner.step(wild).nonFinite, 0u);
    EXPECT_EQ(runner.stateHash(), before) << "undone";
    EXPECT_EQ(runner.run(1).sleeping, 27u) << "gravity is what it was";
    EXPECT_EQ(runner.stateHash(), before);
}

TEST(Sleep, IsRefusedBySolversWithoutAFormForIt) {
    for (const Solver solver : {Solver::jacobi, Solver::gaussSeidel}) {
        const auto complaints = validate(Settings{.solver = solver, .sleeps = true});
        ASSERT_EQ(complaints.size(), 1u);
        EXPECT_NE(complaints[0].find("settings.sleeps"), std::string::npos) << complaints[0];
    }
}

TEST(Sleep, IsSaidWhereAStepIsDescribed) {
    const StepProgram program = compile(heap(3), {.substeps = 2, .sleeps = true});
    std::size_t indirect = 0, direct = 0;
    for (const Pass& pass : program[List::step]) {
        if (pass.kind != PassKind::dispatch) continue;
        indirect += pass.isIndirect && pass.uses.back().buffer == program.sleep.arguments ? 1 : 0;
        direct += pass.isIndirect ? 0 : 1;
    }
    const std::string text = describe(program);
    const std::regex line(
        "sleep: of (\\d+) dispatches (\\d+) run .* (\\d+) whole .* (\\d+) at .* (\\d+) always");
    std::smatch said;
    ASSERT_TRUE(std::regex_search(text, said, line)) << text;
    const auto number = [&](std::size_t i) { return std::stoul(said[i]); };
    EXPECT_EQ(number(2) + number(3), indirect);
    EXPECT_GE(number(2), 2u * 4) << "in each substep: moving, watching, counting, parting";
    EXPECT_EQ(number(5), direct);
    EXPECT_EQ(number(1), number(2) + number(3) + number(4) + number(5));
    EXPECT_FALSE(std::regex_search(describe(compile(heap(3), {.substeps = 2})), line));
}

TEST(Sleep, LeavesASceneThatDoesNotAskForItAlone) {
    const StepProgram program = compile(heap(3), {.substeps = 2});
    for (const BufferSpec& buffer : program.buffers)
        EXPECT_EQ(buffer.label.find("sleep"), std::string::npos) << buffer.label;
}
