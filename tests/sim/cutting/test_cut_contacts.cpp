// Tests of contacts and sleep after a cut: pieces touch each other across the cut, and a cut wakes bodies.
#include "sim/cutting/cut_body.hpp"
#include "sim/scenes.hpp"
#include "sinew/bodies.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <limits>

using namespace sinew;
using namespace sinew::sim;
using Eigen::Vector3d;
using test::CutBody;
using test::sweepOf;

namespace {

constexpr float spacing = 0.05f;
constexpr double radius = 0.5 * double{spacing};
constexpr std::uint32_t cells = 6;

// A cube whose lowest particles are one radius above a floor.
Scene standingCube(float youngModulus) {
    Scene scene{.name = "standing cube", .damping = 8};
    addLattice(scene, {.origin = {0, spacing / 2, 0},
                       .cells = {cells, cells, cells},
                       .spacing = spacing,
                       .youngModulus = youngModulus,
                       .radius = spacing / 2,
                       .isCuttable = true});
    scene.planes = {{.normal = {0, 1, 0}, .offset = 0, .friction = 0.6f}};
    scene.contacts.friction = 0.5f;
    return scene;
}

// Least distance between particles of different pieces, over the sum of their radii.
double leastGap(const std::vector<Vector3d>& x, const std::vector<std::uint32_t>& pieces) {
    double least = 9;
    for (std::size_t i = 0; i < x.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            if (pieces[i] != pieces[j]) least = std::min(least, (x[i] - x[j]).norm() / (2 * radius));
    return least;
}

double meanHeight(const std::vector<Vector3d>& x, const std::vector<std::uint32_t>& pieces,
                  std::uint32_t piece) {
    double sum = 0, count = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        if (pieces[i] != piece) continue;
        sum += x[i].y();
        ++count;
    }
    return sum / count;
}

// Cuts a body at rest horizontally through its middle.
Status cutAcross(CutBody& body) {
    const double height = body.runner().positions()[body.particleAt(3, 3, 3)].y() + 0.45 * body.spacing();
    return body.cut(sweepOf({Vector3d(0.15, height, 0.15), Vector3d::UnitY()}, 1, 2));
}

} // namespace

// Regression test: without contacts between separated particles, the upper half fell through the lower one.
TEST(CutContacts, CarryTheUpperHalfOfACubeThatIsCutAcrossAtRest) {
    CutBody body(standingCube(1e5f), {.substeps = 16});
    body.runner().run(90);
    const auto before = body.runner().positions();
    ASSERT_EQ(cutAcross(body).pieces, 2u);
    const auto pieces = body.pieces();
    const std::uint32_t upper = pieces[body.particleAt(3, 6, 3)], lower = pieces[body.particleAt(3, 0, 3)];
    ASSERT_NE(upper, lower);
    double most = test::kineticEnergy(body.scene(), body.runner().velocities());
    double gap = leastGap(body.runner().positions(), pieces);
    for (int step = 0; step < 90; ++step) {
        ASSERT_EQ(body.runner().run(1).nonFinite, 0u);
        most = std::max(most, test::kineticEnergy(body.scene(), body.runner().velocities()));
        gap = std::min(gap, leastGap(body.runner().positions(), pieces));
    }
    const auto after = body.runner().positions();
    const double sunk = meanHeight(before, pieces, upper) - meanHeight(after, pieces, upper);
    std::printf("after the cut: most kinetic energy %.2e J, least gap %.4f, upper half %.2e m lower\n", most,
                gap, sunk);
    const double halfSpeed = 0.1 / 2; // of each half; overlapping layers part at 0.1 m/s
    EXPECT_LT(most, 0.5 * test::massOf(body.scene()) * halfSpeed * halfSpeed) << "[J]";
    EXPECT_GT(gap, 0.97);
    EXPECT_LT(std::abs(sunk), 0.05 * double{spacing});
}

// The cube is so soft that neighbours overlap by a tenth before the cut. They part at 0.1 m/s.
TEST(CutContacts, OfNeighboursThatOverlapPartThemSlowly) {
    CutBody body(standingCube(3e4f), {.substeps = 16});
    body.runner().run(120);
    const auto before = body.runner().positions();
    const double overlap =
        1 - (before[body.particleAt(3, 2, 3)] - before[body.particleAt(3, 1, 3)]).norm() / (2 * radius);
    ASSERT_GT(overlap, 0.05);
    const double height = 0.5 * (before[body.particleAt(3, 2, 3)] + before[body.particleAt(3, 1, 3)]).y();
    ASSERT_GE(body.cut(sweepOf({Vector3d(0.15, height, 0.15), Vector3d::UnitY()}, 1, 2)).pieces, 2u);
    double most = 0;
    for (int step = 0; step < 60; ++step) {
        ASSERT_EQ(body.runner().run(1).nonFinite, 0u);
        for (const Vector3d& v : body.runner().velocities()) most = std::max(most, v.norm());
    }
    std::printf("overlap %.3f of touching, fastest after the cut %.3f m/s\n", overlap, most);
    EXPECT_LT(most, 0.5);
}

TEST(CutContacts, EndInTheSameBitsForAnyOrderAndMargin) {
    const Scene scene = standingCube(1e5f);
    const Settings settings[] = {{.substeps = 12},
                                 {.substeps = 12, .isReversed = true},
                                 {.substeps = 12, .contactMargin = 0.7f},
                                 {.substeps = 12, .forms = {.usesTexels = false}}};
    std::vector<std::uint64_t> hashes;
    for (const Settings& each : settings) {
        CutBody body(scene, each);
        body.runner().run(5);
        body.cut(sweepOf({Vector3d(0.15, 0.16, 0.15), Vector3d(0.1, 1, 0.2).normalized()}, 1, 2));
        body.runner().run(20);
        hashes.push_back(body.runner().stateHash());
    }
    for (const std::uint64_t hash : hashes) EXPECT_EQ(hash, hashes[0]);
}

// A pair may touch only after its last link died. An undone step restores the link and removes the contact.
TEST(CutContacts, OfAStepThatIsUndoneAreUndoneWithIt) {
    CutBody body(standingCube(1e5f), {.substeps = 12}), other(standingCube(1e5f), {.substeps = 12});
    body.runner().run(10);
    other.runner().run(10);
    // A step with a non-finite result is undone and leaves no trace.
    body.runner().writePosition(3, std::numeric_limits<float>::quiet_NaN());
    EXPECT_GT(cutAcross(body).nonFinite, 0u);
    body.runner().run(10);
    other.runner().run(10);
    EXPECT_EQ(body.runner().stateHash(), other.runner().stateHash());
    EXPECT_EQ(cutAcross(body).pieces, 2u);
    cutAcross(other);
    body.runner().run(10);
    other.runner().run(10);
    EXPECT_EQ(body.runner().stateHash(), other.runner().stateHash());
}

namespace {

// Two cubes at rest without gravity, which fall asleep after half a second.
Scene restingCubes() {
    Scene scene{.name = "resting cubes", .gravity = {0, 0, 0}};
    for (const float x : {0.0f, 1.0f})
        addLattice(scene, {.origin = {x, 0, 0},
                           .cells = {4, 4, 4},
                           .spacing = spacing,
                           .youngModulus = 1e5f,
                           .isCuttable = true});
    return scene;
}

const Settings sleeping{.substeps = 4, .sleeps = true};
constexpr std::uint32_t ofCube = 125;

Blade bladeAt(const std::vector<Vec3>& from, const std::vector<Vec3>& to) {
    return {.from = from, .to = to};
}

} // namespace

TEST(Cut, WakesTheBodyThatItCutsAndNoOther) {
    for (const bool isReversed : {false, true}) {
        Settings settings = sleeping;
        settings.isReversed = isReversed;
        test::Runner runner(restingCubes(), settings);
        ASSERT_EQ(runner.run(40).sleeping, 2 * ofCube);
        const std::vector<Vec3> far[] = {{{0, 5, 0}, {0, 5, 1}}, {{1, 5, 0}, {1, 5, 1}}};
        EXPECT_EQ(runner.cut(bladeAt(far[0], far[1])).sleeping, 2 * ofCube) << "a blade that meets nothing";
        const std::vector<Vec3> from{{-1, 0.11f, -1}, {-1, 0.11f, 1}},
            to{{0.5f, 0.11f, -1}, {0.5f, 0.11f, 1}};
        const Status status = runner.cut(bladeAt(from, to));
        EXPECT_EQ(status.sleeping, ofCube);
        EXPECT_EQ(status.pieces, 3u);
        EXPECT_EQ(runner.run(10).sleeping, ofCube);
        EXPECT_EQ(runner.run(40).sleeping, 2 * ofCube) << "and sleeps again";
    }
}

TEST(Cut, LetsPiecesSleepEachForItself) {
    test::Runner runner(restingCubes(), sleeping);
    const std::vector<Vec3> from{{-1, 0.11f, -1}, {-1, 0.11f, 1}}, to{{0.5f, 0.11f, -1}, {0.5f, 0.11f, 1}};
    EXPECT_EQ(runner.cut(bladeAt(from, to)).pieces, 3u);
    ASSERT_EQ(runner.run(50).sleeping, 2 * ofCube);
    const RayCut corner{.from = {0, 0.2f, 0}, .to = {0, 0.201f, 0}, .radius = 0.2f * spacing};
    const Status status = runner.cut({}, corner);
    EXPECT_EQ(status.pieces, 4u);
    EXPECT_EQ(status.sleeping, 2 * ofCube - 2 * 25) << "the two layers above the first cut are awake";
}

// A grab takes only particles linked to its target particle, not those across a cut, and uses the mass of the
// piece.
TEST(Cut, LetsAHandHoldOnePieceAlone) {
    for (const bool isReversed : {false, true}) {
        const Scene scene = restingCubes();
        test::Runner runner(scene, {.substeps = 8, .grabs = 1, .isReversed = isReversed});
        const std::vector<Vec3> from{{-1, 0.11f, -1}, {-1, 0.11f, 1}},
            to{{0.5f, 0.11f, -1}, {0.5f, 0.11f, 1}};
        ASSERT_EQ(runner.cut(bladeAt(from, to)).pieces, 3u);
        const auto before = runner.positions();
        std::uint32_t held = 0;
        for (std::uint32_t i = 0; i < ofCube; ++i)
            if (std::abs(before[i].y() - 0.15) < 0.01 && std::abs(before[i].x() - 0.1) < 0.01 &&
                std::abs(before[i].z() - 0.1) < 0.01)
                held = i;
        ASSERT_NE(held, 0u);
        const Vec3& place = scene.particles[held].position;
        Grab grab{.particle = held, .radius = 0.12f, .target = place, .maxAcceleration = 1};
        runner.step({.dt = scene.dt, .gravity = scene.gravity, .grabs = std::span(&grab, 1)});
        grab.target.y += 5; // far away, so that the grab pulls with its largest force
        grab.maxSpeed = 100;
        for (int step = 0; step < 30; ++step)
            ASSERT_EQ(runner.step({.dt = scene.dt, .gravity = scene.gravity, .grabs = std::span(&grab, 1)})
                          .nonFinite,
                      0u);
        const auto x = runner.positions();
        double upper = 0, lower = 0;
        for (std::uint32_t i = 0; i < ofCube; ++i)
            (before[i].y() > 0.11 ? upper : lower) += x[i].y() - before[i].y();
        std::printf("held half went %.4f m, the other %.2e m\n", upper / 50, lower / 75);
        EXPECT_NEAR(upper / 50, 0.5 * 1 * 0.5 * 0.5, 0.02) << "at 1 m/s^2 for half a second";
        EXPECT_LT(std::abs(lower / 75), 1e-5);
    }
}

TEST(Topology, ThatIsLoadedWakesAll) {
    test::Runner runner(restingCubes(), sleeping);
    const vk::Buffer topology = runner.saveTopology();
    ASSERT_EQ(runner.run(40).sleeping, 2 * ofCube);
    runner.loadTopology(topology);
    EXPECT_EQ(runner.run(1).sleeping, 0u);
    EXPECT_EQ(runner.run(40).sleeping, 2 * ofCube);
}
