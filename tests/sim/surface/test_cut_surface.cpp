// Tests of cut surfaces: they are closed, two-sided and on the blade's path, and each side moves with its
// piece.
#include "common/layout.h"
#include "sim/scenes.hpp"
#include "sim/surface/closed_surface.hpp"
#include "sinew/bodies.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cstdio>
#include <limits>
#include <numeric>
#include <random>

using namespace sinew;
using namespace sinew::sim;
using Eigen::Vector3d;
using test::ClosedSurface;
using test::CutBody;
using test::CutPlane;
using test::sweepOf;
using Part = test::ClosedSurface::Part;

namespace {

constexpr float spacing = 0.05f;
const double cell = std::pow(double{spacing}, 3);

Scene cube(std::uint32_t cells, std::vector<float> fill = {}, float youngModulus = 1e5f) {
    Scene scene{.name = "cube", .gravity = {0, 0, 0}};
    const Lattice lattice{.origin = {0.1f, 0.5f, -0.2f},
                          .cells = {cells, cells, cells},
                          .spacing = spacing,
                          .fill = std::move(fill),
                          .youngModulus = youngModulus,
                          .isCuttable = true};
    addLatticeSkin(scene, lattice, addLattice(scene, lattice), {0.7f, 0.2f, 0.1f});
    return scene;
}

Vector3d middle(const CutBody& body) {
    Vector3d sum = Vector3d::Zero();
    const auto count = static_cast<std::uint32_t>(body.scene().particles.size());
    for (std::uint32_t i = 0; i < count; ++i) sum += body.at(i);
    return sum / count;
}

// Checks the invariants of a surface; returns the number of parts with a volume.
std::size_t expectClosed(const ClosedSurface& surface, double volume, const char* what) {
    EXPECT_EQ(surface.openEdges(), 0u) << what;
    EXPECT_NEAR(surface.volume() / volume, 1, 1e-6) << what;
    const auto volumes = surface.volumes(cell);
    EXPECT_NEAR(std::accumulate(volumes.begin(), volumes.end(), 0.0) / volume, 1, 1e-6) << what;
    for (const double part : volumes) EXPECT_GT(part, 0) << what << ": no part is inside out";
    return volumes.size();
}

Vector3d random(std::mt19937& numbers) {
    std::uniform_real_distribution<double> uniform(-1, 1);
    const double x = uniform(numbers), y = uniform(numbers), z = uniform(numbers);
    return {x, y, z};
}

} // namespace

TEST(CutSurface, OfAnUncutBodyIsItsSkin) {
    CutBody body(cube(4));
    body.runner().run(1);
    const ClosedSurface surface(body);
    EXPECT_EQ(surface.triangles().size(), body.scene().skins[0].triangles.size());
    EXPECT_EQ(expectClosed(surface, 64 * cell, "uncut"), 1u);
    EXPECT_EQ(surface.area(Part::inside), 0);
}

// Planes of special orientation, and 20 random ones.
TEST(CutSurface, OfAPlaneIsClosedAndHasItsArea) {
    struct Case {
        const char* name;
        Vector3d at, normal; // from the middle [cells]
        double area;         // [cells^2]; 0 = not compared
    };
    const Case cases[] = {{"between layers", {0, 0, 0.5}, {0, 0, 1}, 36},
                          {"near a layer", {0, 0, 0.93}, {0, 0, 1}, 36},
                          {"through a layer", {0, 0, 1}, {0, 0, 1}, 36},
                          {"x = y", {0, 0, 0}, {1, -1, 0}, 36 * std::sqrt(2.0)},
                          {"x = -y", {0, 0, 0}, {1, 1, 0}, 36 * std::sqrt(2.0)},
                          {"x + y + z = 0", {0, 0, 0}, {1, 1, 1}, 36 * 0.75 * std::sqrt(3.0)},
                          {"steep", {0.2, 0.1, 0.3}, {0.3, -0.1, 1}, 36 * std::sqrt(1.1)}};
    for (const Case& each : cases) {
        CutBody body(cube(6));
        const CutPlane plane{middle(body) + double{spacing} * each.at, each.normal.normalized()};
        const Status status = body.cut(sweepOf(plane, 1, 3));
        EXPECT_EQ(status.pieces, 2u) << each.name;
        const ClosedSurface surface(body);
        EXPECT_EQ(expectClosed(surface, 216 * cell, each.name), status.pieces) << each.name;
        const double area = surface.area(Part::inside) / 2 / (double{spacing} * double{spacing});
        std::printf("%-16s area %.3f of %.3f cells^2 (%+.2f %%), %zu triangles, %zu crowded edges\n",
                    each.name, area, each.area, 100 * (area / each.area - 1), surface.triangles().size(),
                    surface.crowdedEdges());
        EXPECT_NEAR(area / each.area, 1, 0.05) << each.name;
        for (const auto& triangle : surface.triangles()) // triangles have one side each, and lie on the blade
            for (const std::uint32_t point : triangle.points) {
                const double off = plane.normal.dot(surface.rest()[point] - plane.point) / double{spacing};
                EXPECT_TRUE(triangle.part != Part::inside || std::abs(off) < 0.04) << off;
            }
    }
}

TEST(CutSurface, OfRandomCutsThatCrossIsClosed) {
    CutBody body(cube(6));
    std::mt19937 numbers(11);
    for (int trial = 0; trial < 12; ++trial) {
        body.runner().reset();
        for (int cut = 0; cut < 3; ++cut) {
            const CutPlane plane{middle(body) + 2 * double{spacing} * random(numbers),
                                 random(numbers).normalized()};
            const Status status = body.cut(sweepOf(plane, 1, 3));
            const ClosedSurface surface(body);
            EXPECT_EQ(expectClosed(surface, 216 * cell, "crossing"), status.pieces)
                << "trial " << trial << ", cut " << cut;
        }
    }
}

TEST(CutSurface, OfCutsThatEndInsideIsClosed) {
    CutBody body(cube(6));
    std::mt19937 numbers(5);
    for (int trial = 0; trial < 12; ++trial) {
        body.runner().reset();
        for (int cut = 0; cut < 2; ++cut) {
            const CutPlane plane{middle(body) + 3.5 * double{spacing} * random(numbers),
                                 random(numbers).normalized()};
            body.cut(sweepOf(plane, 3 * double{spacing}, 2));
            expectClosed(ClosedSurface(body), 216 * cell, "partial");
        }
    }
}

// Many short strokes across each other: the shattered body still has a closed surface.
TEST(CutSurface, OfFiftyRandomStrokesIsClosed) {
    CutBody body(cube(6));
    std::mt19937 numbers(3);
    for (int stroke = 0; stroke < 50; ++stroke) {
        const CutPlane plane{middle(body) + 3 * double{spacing} * random(numbers),
                             random(numbers).normalized()};
        body.cut(sweepOf(plane, 2.2 * double{spacing}, 1 + static_cast<std::size_t>(stroke) % 3));
        if (stroke % 5 != 4) continue;
        const ClosedSurface surface(body);
        expectClosed(surface, 216 * cell, "shredded");
        std::printf("%d strokes: %zu triangles, %zu parts, %u pieces, %zu crowded edges\n", stroke + 1,
                    surface.triangles().size(), surface.volumes(cell).size(), body.runner().run(1).pieces,
                    surface.crowdedEdges());
    }
}

// One step cuts all links, which exceeds the capacity. A simulation with larger capacity takes over and draws
// the cut.
TEST(CutSurface, ForWhichThereIsNoRoomIsDrawnOnceThereIs) {
    const RayCut everything{.from = {0, 0, 0}, .to = {0, 1, 0}, .radius = 9};
    Scene scene = cube(9);
    scene.gravity = {0, -9.81f, 0};
    const Settings few{.substeps = 2}, enough{.substeps = 2, .cutSurfaceRoom = 300'000};
    CutBody cramped(scene, few), roomy(scene, enough), taking(scene, enough);
    cramped.runner().run(3);
    roomy.runner().run(3);
    const Status status = cramped.runner().cut({}, everything);
    EXPECT_EQ(status.pieces, 1000u);
    EXPECT_GT(status.cutSurfaceMissing, 65'536u);
    EXPECT_LT(status.cutSurfaceMissing, enough.cutSurfaceRoom);
    EXPECT_EQ(ClosedSurface(cramped).triangles().size(), scene.skins[0].triangles.size()) << "the whole skin";
    EXPECT_EQ(roomy.runner().cut({}, everything).cutSurfaceMissing, 0u);
    const ClosedSurface wanted(roomy);
    taking.runner().takeOver(cramped.runner());
    const ClosedSurface surface(taking);
    expectClosed(surface, 729 * cell, "room was made");
    EXPECT_EQ(surface.triangles().size(), wanted.triangles().size());
    EXPECT_EQ(surface.hash(), wanted.hash());
    const Status after = taking.runner().run(1);
    EXPECT_EQ(after.cutSurfaceMissing, 0u);
    EXPECT_EQ(after.linksCut, 0u);
    EXPECT_EQ(after.linksCutInAll, status.linksCutInAll);
    roomy.runner().run(1);
    EXPECT_EQ(taking.runner().stateHash(), roomy.runner().stateHash());
}

TEST(CutSurface, OfABodyWithHolesIsClosed) {
    std::vector<float> fill(5 * 5 * 5, 1);
    for (const std::size_t hole : {62u, 63u, 31u, 7u, 100u, 124u}) fill[hole] = 0;
    CutBody body(cube(5, fill));
    body.cut(sweepOf({middle(body), Vector3d(0.2, 1, 0.1).normalized()}, 1, 2));
    body.cut(sweepOf({middle(body), Vector3d(1, 0.2, -0.3).normalized()}, 1, 2));
    expectClosed(ClosedSurface(body), 119 * cell, "holes");
}

TEST(CutSurface, HasTheSameBitsInReversedOrder) {
    std::vector<std::uint64_t> hashes;
    for (const bool isReversed : {false, true}) {
        CutBody body(cube(5), {.substeps = 2, .isReversed = isReversed});
        body.cut(sweepOf({middle(body), Vector3d(0.2, 1, 0.1).normalized()}, 1, 2));
        body.cut(sweepOf({middle(body), Vector3d(1, 0.2, -0.3).normalized()}, 0.1, 2));
        body.runner().run(3);
        hashes.push_back(ClosedSurface(body).hash());
    }
    EXPECT_EQ(hashes[0], hashes[1]);
}

TEST(CutSurface, IsDrawnWhereTheBodyRestsAndWithTheNormalOfTheBlade) {
    CutBody body(cube(6));
    const Vector3d normal = Vector3d(0.3, -0.1, 1).normalized();
    body.cut(sweepOf({middle(body), normal}, 1, 2));
    const ClosedSurface surface(body);
    for (std::size_t p = 0; p < surface.rest().size(); ++p)
        EXPECT_LE((surface.rest()[p] - surface.drawn()[p]).norm(), 1e-5 * double{spacing});
    double least = 1; // among visible triangles; positions on links are stored in 1/255
    for (const auto& triangle : surface.triangles()) {
        const Vector3d a = surface.rest()[triangle.points[0]], b = surface.rest()[triangle.points[1]],
                       c = surface.rest()[triangle.points[2]];
        const double area = (b - a).cross(c - a).norm() / 2 / (double{spacing} * double{spacing});
        for (const Vector3d& n : triangle.normals) {
            EXPECT_NEAR(n.norm(), 1, 1e-5);
            if (triangle.part == Part::inside && area > 0.01)
                least = std::min(least, std::abs(n.dot(normal)));
        }
    }
    std::printf("least cosine between a normal and the blade's: %.4f\n", least);
    EXPECT_GT(least, 0.9);
}

// The halves are pulled apart. No triangle is stretched between them, and each half keeps its shape.
TEST(CutSurface, GoesWithItsPieces) {
    Scene scene = cube(6);
    const double height = double{scene.particles[0].position.z} + 2.6 * double{spacing};
    for (Particle& particle : scene.particles)
        particle.velocity = {0, 0, double{particle.position.z} < height ? -0.25f : 0.25f};
    CutBody body(scene, {.substeps = 4});
    body.cut(sweepOf({Vector3d(middle(body).x(), middle(body).y(), height), Vector3d::UnitZ()}, 1, 2));
    body.runner().run(59);
    const ClosedSurface surface(body);
    expectClosed(surface, 216 * cell, "apart");
    double most = 0;
    for (const auto& triangle : surface.triangles())
        for (std::size_t n = 0; n < 3; ++n) {
            const std::uint32_t a = triangle.points[n], b = triangle.points[(n + 1) % 3];
            const Vector3d rest = surface.rest()[b] - surface.rest()[a],
                           drawn = surface.drawn()[b] - surface.drawn()[a];
            most = std::max(most, (drawn - rest).norm() / double{spacing});
        }
    std::printf("edges differ from rest by %.5f cells at most\n", most);
    EXPECT_LT(most, 0.02);
    double farthest = 0;
    for (std::size_t p = 0; p < surface.rest().size(); ++p)
        farthest = std::max(farthest, (surface.drawn()[p] - surface.rest()[p]).norm());
    EXPECT_NEAR(farthest, 0.25, 0.01);
}

TEST(CutSurface, OfAStepThatIsUndoneIsUndoneWithIt) {
    CutBody body(cube(5));
    body.cut(sweepOf({middle(body), Vector3d(0.2, 1, 0.1).normalized()}, 1, 2));
    const std::uint64_t hash = ClosedSurface(body).hash();
    body.runner().writePosition(3, std::numeric_limits<float>::quiet_NaN());
    const auto second = sweepOf({middle(body), Vector3d(1, 0.2, -0.3).normalized()}, 1, 2);
    EXPECT_GT(body.cut(second).nonFinite, 0u);
    EXPECT_EQ(ClosedSurface(body).hash(), hash);
    EXPECT_EQ(body.cut(second).pieces, 4u);
    EXPECT_EQ(expectClosed(ClosedSurface(body), 125 * cell, "repeated"), 4u);
}

TEST(CutSurface, ComesBackWithTheTopology) {
    CutBody body(cube(5));
    body.cut(sweepOf({middle(body), Vector3d(0.2, 1, 0.1).normalized()}, 1, 2));
    const std::size_t triangles = ClosedSurface(body).triangles().size();
    const vk::Buffer topology = body.runner().saveTopology();
    body.cut(sweepOf({middle(body), Vector3d(1, 0.2, -0.3).normalized()}, 1, 2));
    EXPECT_GT(ClosedSurface(body).triangles().size(), triangles);
    body.runner().loadTopology(topology);
    const ClosedSurface restored(body);
    EXPECT_EQ(restored.triangles().size(), triangles);
    EXPECT_EQ(expectClosed(restored, 125 * cell, "restored"), 2u);
    body.runner().reset();
    body.runner().run(1);
    EXPECT_EQ(ClosedSurface(body).triangles().size(), body.scene().skins[0].triangles.size());
}
