// Tests of voxel bodies that tear like sheets: only beyond the limit, at most a given number of cells a step,
// across the direction of the pull, and all the way through with a visible inside.
#include "sim/scenes.hpp"
#include "sim/surface/closed_surface.hpp"
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
using Eigen::Matrix3d;
using Eigen::Vector3d;
using test::ClosedSurface;
using test::CutBody;

namespace {

struct Pull {
    Vector3d along = Vector3d::UnitX();
    double strain = 0; // in the whole body
    double more = 0;   // additional strain in the middle, where a tear should begin
    float limit = 0.12f;
    std::uint32_t tearsPerStep = 1;
};

// A stretched cube of 1 m, held at its surface.
Scene pulled(std::uint32_t cells, const Pull& pull) {
    Scene scene{.name = "pulled", .gravity = {0, 0, 0}, .damping = 5};
    addLattice(scene, {.cells = {cells, cells, cells},
                       .spacing = 1 / static_cast<float>(cells),
                       .youngModulus = 1e4f,
                       .isCuttable = true,
                       .tearStrain = pull.limit,
                       .tearsPerStep = pull.tearsPerStep});
    for (std::uint32_t i = 0; i < scene.particles.size(); ++i) {
        Vec3& p = scene.particles[i].position;
        const auto isEnd = [](float x) { return x < 1e-4f || x > 1 - 1e-4f; };
        if (isEnd(p.x) || isEnd(p.y) || isEnd(p.z)) scene.fixed.push_back({i});
        const Vector3d from = test::toVector(p) - Vector3d::Constant(0.5);
        const double u = pull.along.dot(from), bump = std::exp(-from.squaredNorm() / (2 * 0.1 * 0.1));
        p = test::toFloats(from + (pull.strain * u + pull.more * u * bump) * pull.along);
    }
    return scene;
}

// A bar along y, stretched to `stretch` times its length between two held ends.
Scene bar(double stretch, float limit) {
    Scene scene{.name = "bar", .gravity = {0, 0, 0}, .damping = 2};
    const Lattice lattice{.cells = {4, 12, 4},
                          .spacing = 0.05f,
                          .youngModulus = 2e4f,
                          .isCuttable = true,
                          .tearStrain = limit,
                          .tearsPerStep = 8};
    addLatticeSkin(scene, lattice, addLattice(scene, lattice), {0.7f, 0.2f, 0.1f});
    for (std::uint32_t i = 0; i < scene.particles.size(); ++i) {
        Vec3& p = scene.particles[i].position;
        if (p.y < 0.01f || p.y > 0.59f) scene.fixed.push_back({i});
        p.y *= static_cast<float>(stretch);
    }
    return scene;
}

// Rest positions of lost links along the axes, which show the place of the tear.
std::vector<Vector3d> deadPlaces(const CutBody& body, const std::vector<test::LiveLink>& before) {
    std::set<std::pair<std::uint32_t, std::uint32_t>> live;
    for (const test::LiveLink& link : body.links()) live.insert({link.a, link.b});
    const std::uint32_t side = body.scene().grids[0].nodes[0];
    const auto at = [&](std::uint32_t i) -> Vector3d {
        return Vector3d(i % side, i / side % side, i / side / side) / static_cast<double>(side - 1);
    };
    std::vector<Vector3d> dead;
    for (const test::LiveLink& link : before) {
        const auto [low, high] = std::minmax(link.a, link.b);
        const std::uint32_t way = high - low;
        if (live.contains({link.a, link.b}) || (way != 1 && way != side && way != side * side)) continue;
        const std::uint32_t hit = body.hit(low, {way == 1, way == side, way == side * side});
        const double part = hit > 0 ? hit / 255.0 : 0.5;
        dead.push_back((1 - part) * at(low) + part * at(high));
    }
    return dead;
}

// Plane of the spread of points: its normal, with the standard deviation along it and the least one within
// the plane.
struct Spread {
    Vector3d normal = Vector3d::Zero();
    double along = 0, within = 0;
};

Spread spreadOf(const std::vector<Vector3d>& points) {
    Vector3d mean = Vector3d::Zero();
    for (const Vector3d& p : points) mean += p / static_cast<double>(points.size());
    Matrix3d spread = Matrix3d::Zero();
    for (const Vector3d& p : points)
        spread += (p - mean) * (p - mean).transpose() / static_cast<double>(points.size());
    const Eigen::SelfAdjointEigenSolver<Matrix3d> axes(spread);
    return {axes.eigenvectors().col(0), std::sqrt(std::max(0.0, axes.eigenvalues()[0])),
            std::sqrt(axes.eigenvalues()[1])};
}

} // namespace

TEST(TearingBodies, BeginToTearBeyondTheLimitAndNotBefore) {
    for (const Vector3d& way : {Vector3d(1, 0, 0), Vector3d(1, 1, 0), Vector3d(1, -2, 3)}) {
        const Vector3d along = way.normalized();
        CutBody below(pulled(6, {.along = along, .strain = 0.11})),
            beyond(pulled(6, {.along = along, .strain = 0.13}));
        const Status whole = below.runner().run(10);
        EXPECT_EQ(whole.linksCutInAll, 0u) << way.transpose();
        EXPECT_EQ(whole.pieces, 1u);
        EXPECT_GT(beyond.runner().run(1).linksCut, 0u) << way.transpose();
        EXPECT_EQ(beyond.oneSided(), 0u);
        EXPECT_EQ(beyond.looseLinks(), 0u) << "rule K";
        EXPECT_EQ(beyond.pieces(), beyond.expectedPieces());
    }
}

// A plane through a cell crosses at most 16 of its links of 18 directions; rule K removes some around them.
TEST(TearingBodies, TearSoManyCellsAStepAtMost) {
    for (const std::uint32_t most : {1u, 3u, 100u}) {
        CutBody body(
            pulled(8, {.along = Vector3d(1, 2, 0.5).normalized(), .strain = 0.2, .tearsPerStep = most}));
        std::uint32_t inAll = 0, largest = 0;
        for (int step = 0; step < 6; ++step) {
            const Status status = body.runner().run(1);
            EXPECT_LE(status.linksCut, 40 * most);
            largest = std::max(largest, status.linksCut);
            inAll += status.linksCut;
            EXPECT_EQ(status.linksCutInAll, inAll);
        }
        EXPECT_GE(largest, 6 * std::min(most, 8u)) << "as many as may";
    }
}

TEST(TearingBodies, TearAcrossThePullHoweverTheGridLies) {
    for (const Vector3d& way : {Vector3d(1, 0, 0), Vector3d(1, 0.2, 0), Vector3d(2, 1, 0), Vector3d(1, 1, 0),
                                Vector3d(1, 1, 1), Vector3d(3, 1, 0.5)}) {
        const Vector3d along = way.normalized();
        CutBody body(pulled(16, {.along = along, .strain = 0.105, .more = 0.06, .tearsPerStep = 2}),
                     {.substeps = 8});
        const auto before = body.links();
        Spread spread;
        int steps = 0;
        for (; steps < 80 && spread.within < 0.12; steps += 5) {
            body.runner().run(5);
            const auto dead = deadPlaces(body, before);
            if (dead.size() > 10) spread = spreadOf(dead);
        }
        const double off =
            std::acos(std::min(1.0, std::abs(spread.normal.dot(along)))) * 180 / std::numbers::pi;
        std::printf(
            "pulled along (%.1f %.1f %.1f): tear %4.1f degrees off, %.3f m wide at least, %.3f m thick, "
            "after %d steps\n",
            way.x(), way.y(), way.z(), off, spread.within * 4, spread.along * std::sqrt(12.0), steps);
        EXPECT_GE(spread.within, 0.12);
        EXPECT_LT(off, 10);
        EXPECT_LT(spread.along, 0.35 * spread.within);
    }
}

// The bar tears through into two closed pieces, which shrink back to their length and keep all of the volume.
TEST(TearingBodies, TearABarInTwoAndShowItsInside) {
    CutBody body(bar(1.35, 0.3f), {.substeps = 16});
    Status status;
    for (int step = 0; step < 90; ++step) {
        status = body.runner().run(1);
        ASSERT_EQ(status.nonFinite, 0u);
    }
    EXPECT_GE(status.pieces, 2u);
    EXPECT_EQ(body.oneSided(), 0u);
    EXPECT_EQ(body.looseLinks(), 0u);
    EXPECT_EQ(body.pieces(), body.expectedPieces());
    const auto x = body.runner().positions();
    double gap = 0; // between layers of particles, from the lower to the upper end
    std::vector<double> heights;
    for (const Vector3d& p : x) heights.push_back(p.y());
    std::ranges::sort(heights);
    for (std::size_t i = 1; i < heights.size(); ++i) gap = std::max(gap, heights[i] - heights[i - 1]);
    const ClosedSurface surface(body);
    const double cell = std::pow(body.spacing(), 3), rest = 1.35 * 4 * 12 * 4 * cell; // volume in the scene
    const auto volumes = surface.volumes(cell);
    std::printf(
        "%u pieces, %u links dead, gap of %.3f m, %zu open edges, volume %.5f of all, inside %.5f m^2\n",
        status.pieces, status.linksCutInAll, gap, surface.openEdges(), surface.volume() / rest,
        surface.area(ClosedSurface::Part::inside));
    EXPECT_GT(gap, 0.1) << "the ends have come apart [m]";
    EXPECT_EQ(surface.openEdges(), 0u);
    EXPECT_NEAR(surface.volume() / rest, 1, 1e-3);
    EXPECT_GE(volumes.size(), 2u);
    EXPECT_GE(surface.area(ClosedSurface::Part::inside), 2 * 0.04 * 0.99)
        << "both sides of the cross-section";
}

TEST(TearingBodies, EndInTheSameBitsInReversedOrderAndRepeatAStepThatWasUndone) {
    std::vector<std::uint64_t> hashes;
    for (const bool isReversed : {false, true}) {
        CutBody body(pulled(8, {.along = Vector3d(1, 2, 3).normalized(), .strain = 0.16, .tearsPerStep = 3}),
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
