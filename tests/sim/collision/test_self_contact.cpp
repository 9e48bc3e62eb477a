// Tests of voxel bodies with faces that touch themselves: folded, knotted, and at cut surfaces. The host
// measures gaps against every triangle of the surface, which it derives from the live links alone.
#include "common/layout.h"
#include "sim/collision/face_contacts.hpp"
#include "sim/compile/compile.hpp"
#include "sim/cutting/cut_body.hpp"
#include "sim/cutting/cut_gaps.hpp"
#include "sim/cutting/faced_bodies.hpp"
#include "sim/model/components.hpp"
#include "sim/scenes.hpp"
#include "sinew/bodies.hpp"
#include "sinew/holds.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <numbers>

using namespace sinew;
using namespace sinew::sim;
using Eigen::Vector3d;
using test::CutBody;
using test::deepest;
using test::particlesWhere;
using test::poseAt;
using test::surfaceOf;
using test::sweepOf;
using test::Triangle;

namespace {

constexpr float spacing = test::facedSpacing;
constexpr double voxel = double{spacing};

Lattice latticeOf(std::array<std::uint32_t, 3> cells, float youngModulus, bool isCuttable = false) {
    return test::facedLattice(cells, youngModulus, isCuttable);
}

std::vector<Triangle> facesIn(const Scene& scene) {
    std::vector<Triangle> faces;
    for (const Face& face : scene.faces) faces.push_back(face.particles);
    return faces;
}

// A strip of 3 x 3 x 40 cells along z on a plane. One end is fixed, and the other is folded over it, a fifth
// of a voxel above the contact of both halves.
Scene foldedStrip(bool isCuttable) {
    Scene scene{.name = "strip", .damping = 4};
    addLattice(scene, latticeOf({3, 3, 40}, 4e4f, isCuttable));
    addSurfaceFaces(scene, scene.grids[0]);
    const float plane = -spacing / 2, pivot = 0.15f + 0.6f * spacing;
    scene.planes = {{.normal = {0, 1, 0}, .offset = plane, .friction = 0.5f}};
    hold(scene, particlesWhere(scene, [](const Vec3& x) { return x.z < 3.5f * spacing; }));
    std::vector<Keyframe> path;
    for (int n = 0; n <= 8; ++n)
        path.push_back(
            {0.1f * static_cast<float>(n), poseAt({0, pivot, 20 * spacing}, -std::numbers::pi * n / 8)});
    drive(scene, particlesWhere(scene, [](const Vec3& x) { return x.z > 36.5f * spacing; }), path);
    return scene;
}

// Whether the particle and the triangle belong to different halves, excluding the fold.
bool areOfHalves(const Scene& scene, std::uint32_t i, const Triangle& t) {
    const float a = scene.particles[i].position.z / spacing - 20,
                b = scene.particles[t[0]].position.z / spacing - 20;
    return a * b < 0 && std::abs(a) > 4 && std::abs(b) > 4;
}

} // namespace

TEST(SelfContact, KeepsTheHalvesOfAFoldedStripApart) {
    for (const bool isCuttable : {false, true}) {
        const Scene scene = foldedStrip(isCuttable);
        test::Runner runner(scene, {.substeps = 24, .contactRoom = 32});
        double most = -9, end = 0;
        for (int step = 0; step < 90; ++step) {
            const Status status = runner.run(1);
            ASSERT_EQ(status.nonFinite, 0u);
            ASSERT_EQ(status.contactRoom, 0u);
            end = deepest(voxel, runner.positions(), facesIn(scene),
                          [&](std::uint32_t i, const Triangle& t) { return areOfHalves(scene, i, t); });
            most = std::max(most, end);
        }
        std::printf("%s: halves at most %.4f voxels nearer than touching, %.4f at the end\n",
                    isCuttable ? "may be cut" : "whole", most, end);
        EXPECT_LT(most, 0.02);
        EXPECT_GT(end, -0.02) << "they touch";
    }
}

// Bending, and squeezing by 30 %, give the same bits as without faces. A body that may be cut looks its links
// up.
TEST(SelfContact, IsNotFeltByABodyThatMayBeCutAndIsBentOrSqueezed) {
    for (const double turn : {0.0, std::numbers::pi / 3}) {
        std::vector<Vector3d> x[2];
        double shortest = 9;
        for (const bool hasFaces : {false, true}) {
            Scene scene{.name = "beam", .damping = 3};
            scene.gravity = {};
            addLattice(scene, latticeOf({3, 3, 12}, 1e5f, true));
            if (hasFaces) addSurfaceFaces(scene, scene.grids[0]);
            hold(scene, particlesWhere(scene, [](const Vec3& p) { return p.z < 0.5f * spacing; }));
            const Vec3 end{0, 1.5f * spacing, 12 * spacing};
            const Vec3 last =
                turn == 0 ? Vec3{end.x, end.y, 0.7f * end.z} : Vec3{0, 4.6f * spacing, 10.8f * spacing};
            drive(scene, particlesWhere(scene, [](const Vec3& p) { return p.z > 11.5f * spacing; }),
                  {{0, poseAt(end)}, {0.5f, poseAt(last, -turn)}});
            scene.particles.push_back({.position = {9, 9, 9}, .radius = spacing / 2}); // pairs for both
            test::Runner runner(scene, {.substeps = 16});
            ASSERT_EQ(runner.run(45).nonFinite, 0u);
            x[hasFaces ? 1 : 0] = runner.positions();
        }
        double most = 0;
        for (std::size_t i = 0; i < x[0].size(); ++i) most = std::max(most, (x[1][i] - x[0][i]).norm());
        for (std::size_t i = 0; i + 17 < x[0].size(); ++i)
            shortest = std::min(shortest, (x[0][i + 16] - x[0][i]).norm() / voxel);
        std::printf("turned by %.1f: cells are %.2f of their length; %.1e m elsewhere for faces\n", turn,
                    shortest, most);
        EXPECT_NEAR(shortest, 0.68, 0.06);
        EXPECT_EQ(most, 0);
    }
}

// Two hooked strands at right angles like links of a chain. They are the ends of one body, joined by a long
// strand.
TEST(SelfContact, HoldsTwoStrandsThatHookIntoEachOther) {
    constexpr std::uint32_t nx = 14, ny = 13, nz = 9;
    Lattice lattice = latticeOf({nx, ny, nz}, 1e5f);
    lattice.fill.assign(std::size_t{nx} * ny * nz, 0);
    const auto fill = [&](std::array<std::uint32_t, 3> low, std::array<std::uint32_t, 3> high) {
        for (std::uint32_t z = low[2]; z < high[2]; ++z)
            for (std::uint32_t y = low[1]; y < high[1]; ++y)
                for (std::uint32_t x = low[0]; x < high[0]; ++x)
                    lattice.fill[x + nx * (y + std::size_t{ny} * z)] = 1;
    };
    fill({3, 4, 4}, {10, 5, 5}); // hangs from above in the plane z = 4
    fill({3, 4, 4}, {4, 13, 5});
    fill({9, 4, 4}, {10, 13, 5});
    fill({0, 12, 4}, {10, 13, 5});
    fill({6, 8, 1}, {7, 9, 8}); // stands on the floor in the plane x = 6
    fill({6, 0, 1}, {7, 9, 2});
    fill({6, 0, 7}, {7, 9, 8});
    fill({0, 0, 7}, {7, 1, 8});
    fill({0, 0, 4}, {1, 1, 8});
    fill({0, 0, 4}, {1, 13, 5}); // the joining strand
    Scene scene{.name = "hooks", .damping = 2};
    scene.gravity = {};
    addLattice(scene, lattice);
    addSurfaceFaces(scene, scene.grids[0]);
    const auto isUpper = [](const Vec3& x) {
        return x.x > 2.5f * spacing && x.z > 3.5f * spacing && x.z < 5.5f * spacing && x.y > 3.5f * spacing &&
               (x.x < 4.5f * spacing || x.x > 8.5f * spacing || x.y < 5.5f * spacing ||
                x.y > 11.5f * spacing);
    };
    hold(scene,
         particlesWhere(scene, [](const Vec3& x) { return x.y < 1.5f * spacing && x.x > 0.5f * spacing; }));
    drive(scene,
          particlesWhere(scene, [](const Vec3& x) { return x.y > 11.5f * spacing && x.x > 2.5f * spacing; }),
          {{0, poseAt({})}, {1, poseAt({0, 5 * spacing, 0})}});
    std::vector<bool> isOfUpper(scene.particles.size());
    for (const std::uint32_t i : particlesWhere(scene, isUpper)) isOfUpper[i] = true;
    std::vector<bool> isOfLower(scene.particles.size());
    for (const std::uint32_t i : particlesWhere(scene, [](const Vec3& x) {
             return x.x > 5.5f * spacing && x.x < 7.5f * spacing && x.y > 1.5f * spacing &&
                    x.y < 9.5f * spacing &&
                    (x.y > 7.5f * spacing || x.z < 2.5f * spacing || x.z > 6.5f * spacing);
         }))
        isOfLower[i] = !isOfUpper[i];
    test::Runner runner(scene, {.substeps = 32, .contactRoom = 32});
    double most = -9, end = -9;
    for (int step = 0; step < 90; ++step) {
        const Status status = runner.run(1);
        ASSERT_EQ(status.nonFinite, 0u);
        ASSERT_EQ(status.contactRoom, 0u);
        end = deepest(voxel, runner.positions(), facesIn(scene), [&](std::uint32_t i, const Triangle& t) {
            return (isOfUpper[i] && isOfLower[t[0]]) || (isOfLower[i] && isOfUpper[t[0]]);
        });
        most = std::max(most, end);
    }
    const auto x = runner.positions();
    double upper = 9, lower = -9; // of the bars that hold each other
    for (std::uint32_t i = 0; i < x.size(); ++i) {
        const Vec3& p = scene.particles[i].position;
        if (isOfUpper[i] && p.x > 5.5f * spacing && p.x < 7.5f * spacing && p.y < 5.5f * spacing)
            upper = std::min(upper, x[i].y());
        if (isOfLower[i] && p.z > 3.5f * spacing && p.z < 5.5f * spacing) lower = std::max(lower, x[i].y());
    }
    std::printf("strands at most %.4f voxels nearer than touching, %.4f at the end; bars %.2f voxels\n", most,
                end, (lower - upper) / voxel);
    EXPECT_LT(most, 0.02);
    EXPECT_GT(end, -0.05) << "they hold each other";
    EXPECT_GT(lower, upper) << "one still hangs in the other";
}

namespace {

// A cube with a flat cut through its middle. The upper half is lifted, shifted by half a voxel along both
// axes, and pressed down by a fifth of a voxel.
Scene offsetHalves(bool hasFaces) {
    Scene scene{.name = "halves", .damping = 4};
    scene.gravity = {};
    addLattice(scene, latticeOf({6, 6, 6}, 1e5f, true));
    if (hasFaces) addSurfaceFaces(scene, scene.grids[0]);
    hold(scene, particlesWhere(scene, [](const Vec3& x) { return x.y < 0.5f * spacing; }));
    const float half = spacing / 2;
    drive(scene, particlesWhere(scene, [](const Vec3& x) { return x.y > 5.5f * spacing; }),
          {{0, poseAt({})},
           {0.1f, poseAt({})},
           {0.3f, poseAt({0, spacing, 0})},
           {0.5f, poseAt({half, spacing, half})},
           {0.9f, poseAt({half, -0.2f * spacing, half})}});
    return scene;
}

const test::CutPlane acrossTheMiddle{Vector3d(0.15, 3.45 * voxel, 0.15), Vector3d::UnitY()};

double deepestOfHalves(CutBody& body, const std::vector<Triangle>& surface) {
    const auto isUpper = [&](std::uint32_t i) {
        return body.scene().particles[i].position.y > 3.45f * spacing;
    };
    return deepest(voxel, body.runner().positions(), surface,
                   [&](std::uint32_t i, const Triangle& t) { return isUpper(i) != isUpper(t[0]); });
}

} // namespace

TEST(SelfContact, CarriesWhatACutLaysOpenByItsFaces) {
    for (const bool hasFaces : {false, true}) {
        CutBody body(offsetHalves(hasFaces), {.substeps = 24, .contactRoom = 32});
        body.runner().run(2);
        ASSERT_EQ(body.cut(sweepOf(acrossTheMiddle, 1)).pieces, 2u);
        const std::vector<Triangle> surface = surfaceOf(body);
        double most = -9, end = 0, atOnce = 0;
        for (int step = 0; step < 70; ++step) {
            const Status status = body.runner().run(1);
            ASSERT_EQ(status.nonFinite, 0u);
            ASSERT_EQ(status.contactRoom, 0u);
            end = deepestOfHalves(body, surface);
            if (step == 0) atOnce = end;
            most = std::max(most, end);
        }
        std::printf("%s faces: halves at most %.4f voxels nearer than touching, %.4f at the end, %.4f after "
                    "the cut\n",
                    hasFaces ? "with" : "without", most, end, atOnce);
        if (hasFaces) {
            EXPECT_LT(most, 0.05);
            EXPECT_GT(end, -0.01) << "they touch";
        } else {
            EXPECT_GT(most, 0.2) << "particles stand in the gaps of others";
        }
    }
}

// A cube is squeezed by a tenth while it is cut. Its upper half then slides by half a voxel along both axes
// at the same height. The halves keep no rest distance, although the body keeps those at load.
TEST(SelfContact, PartsWhatACutLetsTouchThoughItKeepsItsRestDistance) {
    Scene scene = offsetHalves(true);
    const float half = spacing / 2, lower = -0.6f * spacing;
    scene.driven.front().path = {{0, poseAt({})},
                                 {0.1f, poseAt({0, lower, 0})},
                                 {0.4f, poseAt({0, lower, 0})},
                                 {0.8f, poseAt({half, lower, half})}};
    for (Particle& particle : scene.particles) particle.keepsRest = true;
    CutBody body(scene, {.substeps = 24, .contactRoom = 64});
    body.runner().run(15);
    ASSERT_EQ(body.cut(sweepOf({Vector3d(0.15, 3.15 * voxel, 0.15), Vector3d::UnitY()}, 1)).pieces, 2u);
    const std::vector<Triangle> surface = surfaceOf(body);
    const double atOnce = deepestOfHalves(body, surface);
    double fastest = 0;
    for (int step = 0; step < 50; ++step) {
        ASSERT_EQ(body.runner().run(1).nonFinite, 0u);
        for (const Vector3d& v : body.runner().velocities()) fastest = std::max(fastest, v.norm());
    }
    const double end = deepestOfHalves(body, surface);
    std::printf("halves %.4f voxels nearer than touching after the cut, %.4f at the end, fastest %.3f m/s\n",
                atOnce, end, fastest);
    EXPECT_GT(atOnce, 0.05);
    EXPECT_LT(end, 0.05);
    EXPECT_LT(fastest, 0.5) << "they part slowly";
}

// A ball in the middle of an inner cell, like a ridge that came in between the surface particles.
TEST(SelfContact, PushesOutWhatIsInsideByItsInnerParticles) {
    for (const bool isCuttable : {false, true}) {
        Scene scene{.name = "cube", .damping = 2};
        scene.gravity = {};
        addLattice(scene, latticeOf({6, 6, 6}, 1e5f, isCuttable));
        addSurfaceFaces(scene, scene.grids[0]);
        const auto ball = static_cast<std::uint32_t>(scene.particles.size());
        const float middle = 2.5f * spacing;
        scene.particles.push_back(
            {.position = {-1, middle, middle}, .inverseMass = 0.1f, .radius = spacing / 2});
        test::Runner runner(scene, {.substeps = 16, .contactRoom = 64});
        runner.run(1);
        runner.writePosition(ball, middle);
        ASSERT_EQ(runner.run(10).nonFinite, 0u);
        const auto x = runner.positions();
        double nearest = 9;
        for (std::uint32_t i = 0; i < ball; ++i) nearest = std::min(nearest, (x[i] - x[ball]).norm() / voxel);
        std::printf("nearest particle %.3f voxels away, %.3f in the middle of a cell\n", nearest,
                    std::sqrt(0.75));
        EXPECT_GT(nearest, 0.97);
    }
}

// Particles linked to a corner of a face are at most 1.73 spacings away. Without body diagonals, all others
// are at least that far. The device looks links up, so a row leaves out linked particles and holds a mark and
// all others nearby.
TEST(SelfContact, LeavesWhatIsLinkedToACornerToTheLinks) {
    Scene scene;
    addLattice(scene, latticeOf({4, 3, 3}, 1e5f, true));
    addSurfaceFaces(scene, scene.grids[0]);
    std::vector<layout::ContactFace> faces;
    for (const Face& face : scene.faces)
        faces.push_back({face.particles[0], face.particles[1], face.particles[2], face.thickness});
    const std::size_t count = scene.particles.size();
    const auto rows = collision::face_contacts::excludedPoints(
        scene, linkedBodies(scene), faces, std::vector<float>(count, spacing / 2), orderedLayout(count),
        std::vector{CutRun{0, static_cast<std::uint32_t>(count), 5, 20}});
    const auto at = [&](std::uint32_t i) { return test::toVector(scene.particles[i].position); };
    for (std::size_t f = 0; f < faces.size(); ++f) {
        const auto begin = rows.begin() + rows[f], end = rows.begin() + rows[f + 1] - 1;
        ASSERT_NE(*end & EXCLUDED_LINKED, 0u) << f;
        for (std::uint32_t i = 0; i < count; ++i) {
            bool isLinked = false, isCorner = false, isNear = false;
            for (const std::uint32_t corner : scene.faces[f].particles) {
                const Vector3d d = (at(i) - at(corner)) / voxel;
                const bool isKuhn = d.minCoeff() > -0.1 || d.maxCoeff() < 0.1; // one of the body diagonals
                isLinked = isLinked || d.norm() < 1.5 || (d.cwiseAbs().maxCoeff() < 1.1 && isKuhn);
                isCorner = isCorner || i == corner;
                isNear = isNear || d.norm() < 1.04;
            }
            const bool isListed = std::binary_search(begin, end, i);
            if (isLinked || isCorner) {
                ASSERT_FALSE(isListed) << f << " " << i;
            }
            if (isNear && !isLinked && !isCorner) {
                ASSERT_TRUE(isListed) << f << " " << i;
            }
        }
    }
}
