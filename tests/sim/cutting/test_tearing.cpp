// Tests of sheets that tear: only beyond the limit, at most a given number of cells a step, and across the
// direction of the pull, for any orientation and resolution of the grid.
#include "sim/cutting/cut_body.hpp"
#include "sim/scenes.hpp"
#include "sinew/bodies.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>
#include <set>

using namespace sinew;
using namespace sinew::sim;
using Eigen::Vector2d;
using Eigen::Vector3d;
using test::CutBody;

namespace {

struct Pull {
    double angle = 0;  // of the direction of stretch
    double strain = 0; // in the whole sheet
    double more = 0;   // additional strain in the middle, where a tear should begin
    float limit = 0.12f;
    std::uint32_t tearsPerStep = 1;
    bool resistsBending = false;
};

// A stretched square of 1 m, held at its rim.
Scene pulled(std::uint32_t size, const Pull& pull) {
    Scene scene{.name = "pulled", .gravity = {0, 0, 0}, .damping = 5};
    ClothSheet sheet{.size = {size, size},
                     .spacing = 1 / static_cast<float>(size - 1),
                     .areaDensity = 0.3f,
                     .membraneStiffness = 100,
                     .bendingStiffness = pull.resistsBending ? 1e-5f : 0,
                     .isCuttable = true,
                     .tearStrain = pull.limit,
                     .tearsPerStep = pull.tearsPerStep};
    for (std::uint32_t i = 0; i < size * size; ++i)
        if (i % size == 0 || i % size == size - 1 || i < size || i >= size * (size - 1))
            sheet.pinned.push_back(i);
    addCloth(scene, sheet);
    const Vector2d along(std::cos(pull.angle), std::sin(pull.angle));
    for (Particle& particle : scene.particles) {
        const Vector2d from =
            Vector2d(double{particle.position.x}, double{particle.position.z}) - Vector2d(0.5, 0.5);
        const double u = along.dot(from), bump = std::exp(-from.squaredNorm() / (2 * 0.06 * 0.06));
        const Vector2d at = from + (pull.strain * u + pull.more * u * bump) * along;
        particle.position = test::toFloats(Vector3d(at.x(), 0, at.y()));
    }
    return scene;
}

// Rest positions of the middles of lost links.
std::vector<Vector2d> deadLinks(const CutBody& body, const std::vector<test::LiveLink>& before) {
    std::set<std::pair<std::uint32_t, std::uint32_t>> live;
    for (const test::LiveLink& link : body.links()) live.insert({link.a, link.b});
    const std::uint32_t size = body.scene().grids[0].nodes[0];
    const auto at = [&](std::uint32_t i) -> Vector2d {
        return Vector2d(static_cast<double>(i % size), static_cast<double>(i / size)) /
                   static_cast<double>(size - 1) -
               Vector2d(0.5, 0.5);
    };
    std::vector<Vector2d> dead;
    for (const test::LiveLink& link : before)
        if (!live.contains({link.a, link.b})) dead.push_back(0.5 * (at(link.a) + at(link.b)));
    return dead;
}

// Direction of the largest spread of points, with standard deviations along and across it.
struct Spread {
    double angle = 0, along = 0, across = 0;
};

Spread spreadOf(const std::vector<Vector2d>& points) {
    Vector2d mean = Vector2d::Zero();
    for (const Vector2d& p : points) mean += p / static_cast<double>(points.size());
    Eigen::Matrix2d spread = Eigen::Matrix2d::Zero();
    for (const Vector2d& p : points)
        spread += (p - mean) * (p - mean).transpose() / static_cast<double>(points.size());
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(spread);
    const Vector2d axis = axes.eigenvectors().col(1);
    return {std::atan2(axis.y(), axis.x()), std::sqrt(axes.eigenvalues()[1]),
            std::sqrt(std::max(0.0, axes.eigenvalues()[0]))};
}

// Angle between two lines [degrees].
double between(double a, double b) {
    const double turns = std::remainder(a - b, std::numbers::pi);
    return std::abs(turns) * 180 / std::numbers::pi;
}

} // namespace

TEST(Tearing, BeginsBeyondTheLimitAndNotBefore) {
    for (const double angle : {0.0, 0.5, 0.7854}) {
        CutBody below(pulled(17, {.angle = angle, .strain = 0.11})),
            beyond(pulled(17, {.angle = angle, .strain = 0.13}));
        const Status whole = below.runner().run(20);
        EXPECT_EQ(whole.linksCutInAll, 0u) << angle;
        EXPECT_EQ(whole.pieces, 1u);
        EXPECT_GT(beyond.runner().run(1).linksCut, 0u) << angle;
        EXPECT_EQ(beyond.oneSided(), 0u);
        EXPECT_EQ(beyond.pieces(), beyond.expectedPieces());
    }
}

// A straight cut through a cell crosses at most 2 edges and both diagonals.
TEST(Tearing, OfAStepIsAtMostSoManyCells) {
    for (const std::uint32_t most : {1u, 3u, 100u}) {
        CutBody body(pulled(17, {.angle = 0.3, .strain = 0.2, .tearsPerStep = most}));
        std::uint32_t inAll = 0, largest = 0;
        for (int step = 0; step < 10; ++step) {
            const Status status = body.runner().run(1);
            EXPECT_LE(status.linksCut, 5 * most);
            largest = std::max(largest, status.linksCut);
            inAll += status.linksCut;
            EXPECT_EQ(status.linksCutInAll, inAll);
        }
        EXPECT_GE(largest, 3 * std::min(most, 10u)) << "as many as may";
    }
}

TEST(Tearing, GrowsAcrossThePullHoweverTheGridLiesAndHoweverFineItIs) {
    for (const std::uint32_t size : {25u, 41u})
        for (const double degrees : {0.0, 15.0, 30.0, 45.0, 75.0}) {
            if (size > 25 && degrees != 15 && degrees != 45) continue; // enough cases for fine sheets
            const double angle = degrees * std::numbers::pi / 180;
            CutBody body(pulled(size, {.angle = angle, .strain = 0.09, .more = 0.06}), {.substeps = 16});
            const auto before = body.links();
            Spread spread;
            int steps = 0;
            for (; steps < 60 && spread.along < 0.12; steps += 5) {
                body.runner().run(5);
                const auto dead = deadLinks(body, before);
                if (dead.size() > 8) spread = spreadOf(dead);
            }
            const double off = between(spread.angle, angle + std::numbers::pi / 2);
            std::printf("%ux%u, pulled at %2.0f degrees: tear %4.1f degrees off, %.3f m long and %.3f m wide "
                        "after %d steps\n",
                        size, size, degrees, off, spread.along * std::sqrt(12.0),
                        spread.across * std::sqrt(12.0), steps);
            EXPECT_GE(spread.along, 0.12);
            EXPECT_LT(off, 10);
            EXPECT_LT(spread.across, 0.25 * spread.along);
        }
}

TEST(Tearing, EndsInTheSameBitsInReversedOrderAndRepeatsAStepThatWasUndone) {
    std::vector<std::uint64_t> hashes;
    for (const bool isReversed : {false, true}) {
        CutBody body(pulled(17, {.angle = 0.3, .strain = 0.16, .tearsPerStep = 3, .resistsBending = true}),
                     {.substeps = 8, .isReversed = isReversed});
        body.runner().run(3);
        const auto saved = body.runner().save();
        body.runner().run(4);
        const auto words = body.words();
        hashes.push_back(body.runner().stateHash());
        body.runner().load(saved);
        EXPECT_NE(body.words(), words);
        body.runner().run(4);
        EXPECT_EQ(body.words(), words);
        EXPECT_EQ(body.runner().stateHash(), hashes.back());
        body.runner().writePosition(20, std::numeric_limits<float>::quiet_NaN());
        EXPECT_GT(body.runner().run(1).nonFinite, 0u);
        EXPECT_EQ(body.words(), words) << "undone";
    }
    EXPECT_EQ(hashes[0], hashes[1]);
}

TEST(Tearing, LeavesStrokesOfABladeWhatTheyAre) {
    CutBody tearing(pulled(17, {.limit = 5})), other(pulled(17, {.limit = 0}));
    for (CutBody* body : {&tearing, &other}) {
        const std::vector<Vec3> at[] = {{{-0.6f, -1, 0.01f}, {-0.6f, 1, 0.01f}},
                                        {{-0.1f, -1, 0.01f}, {-0.1f, 1, 0.01f}},
                                        {{0.6f, -1, 0.01f}, {0.6f, 1, 0.01f}}};
        body->cut({.from = at[0], .to = at[1]});
        body->runner().run(3);
        EXPECT_EQ(body->cut({.from = at[1], .to = at[2], .isCarried = true}).pieces, 2u);
    }
    EXPECT_EQ(tearing.words(), other.words());
    EXPECT_EQ(tearing.runner().stateHash(), other.runner().stateHash());
}
