// Tests of a cuttable voxel body that is cut while it is crumpled and touches itself: pairs that the cut lets
// touch part at the recovery speed. Also tests the bound on the distance between points and faces without
// links.
#include "sim/collision/face_contacts.hpp"
#include "sim/cutting/cut_body.hpp"
#include "sim/cutting/faced_bodies.hpp"
#include "sinew/bodies.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

using namespace sinew;
using namespace sinew::sim;
using Eigen::Vector3d;
using test::CutBody;

namespace {

constexpr double voxel = double{test::facedSpacing};
const Vector3d middle(2.5 * voxel, 2.5 * voxel, 2.5 * voxel);

Scene blockOf(float youngModulus, float damping) {
    Scene scene{.name = "block", .damping = damping};
    scene.gravity = {};
    addLattice(scene, test::facedLattice({5, 5, 5}, youngModulus, true));
    addSurfaceFaces(scene, scene.grids[0]);
    return scene;
}

double fastest(CutBody& body) {
    double most = 0;
    for (const Vector3d& v : body.runner().velocities()) most = std::max(most, v.norm());
    return most;
}

double widthOf(CutBody& body) {
    const auto x = body.runner().positions();
    double low = 1, high = -1;
    for (const Vector3d& p : x) {
        low = std::min(low, p.x());
        high = std::max(high, p.x());
    }
    return high - low;
}

// Distance from the triangle (0, 0, 0), (1, 0, 0), (0, 1, 0).
double distanceFromFace(const Vector3d& p) {
    const double x = std::max(0.0, p.x()), y = std::max(0.0, p.y());
    Vector3d nearest(x, y, 0);
    if (x + y > 1) {
        const double along = std::clamp(0.5 * (1 + p.x() - p.y()), 0.0, 1.0);
        nearest = {along, 1 - along, 0};
    } else if (p.y() < 0) {
        nearest = {std::min(x, 1.0), 0, 0};
    } else if (p.x() < 0) {
        nearest = {0, std::min(y, 1.0), 0};
    }
    return (p - nearest).norm();
}

// Whether a link joins both points: at most one step along each axis, and at most `kinds` steps in all.
bool areLinked(const Vector3d& a, const Vector3d& b, std::uint32_t kinds) {
    const Vector3d d = (a - b).cwiseAbs();
    return d.maxCoeff() <= 1 && d.sum() <= kinds;
}

} // namespace

// Tests all points of a grid around a face against their links; computes no bound from a formula.
TEST(CrumpledBodies, HaveNoPointNearerToAFaceThanTheBoundWithoutALink) {
    const std::array<Vector3d, 3> corners{Vector3d(0, 0, 0), Vector3d(1, 0, 0), Vector3d(0, 1, 0)};
    for (const std::uint32_t kinds : {1u, 2u, 3u}) {
        double unlinked = std::numeric_limits<double>::infinity(), diagonal = unlinked;
        for (int z = -4; z <= 4; ++z)
            for (int y = -4; y <= 4; ++y)
                for (int x = -4; x <= 4; ++x) {
                    const Vector3d p(x, y, z);
                    const auto isLinked = [&](std::uint32_t k) {
                        return std::ranges::any_of(corners,
                                                   [&](const Vector3d& c) { return areLinked(p, c, k); });
                    };
                    const double distance = distanceFromFace(p);
                    if (!isLinked(kinds)) unlinked = std::min(unlinked, distance);
                    if (isLinked(kinds) && !isLinked(1)) diagonal = std::min(diagonal, distance);
                }
        EXPECT_NEAR(unlinked, collision::face_contacts::leastUnlinked(kinds), 1e-12) << kinds;
        if (kinds == 1) continue;
        EXPECT_NEAR(diagonal, collision::face_contacts::leastUnlinked(1), 1e-12) << kinds;
    }
}

// A body collapses onto itself and comes to rest before the cut. Its links are too soft to move it. Pairs
// that the cut lets touch overlap by up to 0.3 of their distance.
TEST(CrumpledBodies, GiveNobodyMoreSpeedThanRecoveryWhenTheyAreCut) {
    Scene scene = blockOf(10, 20);
    for (Particle& particle : scene.particles) {
        const Vec3& x = particle.position;
        particle.velocity = {-12 * (x.x - static_cast<float>(middle.x())),
                             -12 * (x.y - static_cast<float>(middle.y())),
                             -12 * (x.z - static_cast<float>(middle.z()))};
    }
    CutBody body(scene, {.substeps = 8, .contactRoom = 256});
    ASSERT_FALSE(body.runner().run(40).isUndone);
    const double before = fastest(body), width = widthOf(body);
    ASSERT_EQ(body.cut(test::sweepOf({middle + Vector3d(0.003, 0, 0), Vector3d(1, 0.2, 0.1).normalized()}, 1))
                  .pieces,
              2u);
    double after = fastest(body);
    for (int step = 0; step < 5; ++step) {
        ASSERT_FALSE(body.runner().run(1).isUndone);
        after = std::max(after, fastest(body));
    }
    std::printf("squeezed to %.3f, fastest %.2e m/s, once cut %.3f m/s\n", width / (5 * voxel), before,
                after);
    EXPECT_LT(width, 0.8 * 5 * voxel);
    EXPECT_LT(before, 0.02);
    EXPECT_LT(after, before + 0.2) << "two that part at 0.1 m/s, and what lies on them";
}

TEST(CrumpledBodies, StayWhereTheyAreWhenTheyAreCutAtRest) {
    CutBody body(blockOf(1e5f, 0), {.substeps = 8, .contactRoom = 64});
    const auto start = body.runner().positions();
    ASSERT_EQ(body.cut(test::sweepOf({middle + Vector3d(0.003, 0, 0), Vector3d(1, 0.2, 0.1).normalized()}, 1))
                  .pieces,
              2u);
    ASSERT_FALSE(body.runner().run(20).isUndone);
    const auto end = body.runner().positions();
    double farthest = 0;
    for (std::size_t i = 0; i < start.size(); ++i) farthest = std::max(farthest, (end[i] - start[i]).norm());
    std::printf("farthest way %.2e m\n", farthest);
    EXPECT_LT(farthest, 1e-4 * voxel);
}
