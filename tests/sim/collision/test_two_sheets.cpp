// Tests of two sheets that meet, and of bodies between meshes that close on them: no point passes, at any
// speed.
#include "sim/collision/passage.hpp"
#include "sim/runner.hpp"
#include "sim/scenes.hpp"
#include "sinew/bodies.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>

using namespace sinew;
using namespace sinew::sim;
using Eigen::Vector3d;

namespace {

constexpr float thickness = 0.01f, spacing = 0.03f;
constexpr std::uint32_t side = 11; // particles of a sheet along each edge

struct Pace {
    double speed; // [m/s]
    std::uint32_t substeps;
};
constexpr Pace paces[] = {{10, 4}, {100, 16}, {1000, 4}};
// Ways of 1 to 2.6 of the distance at which two sheets touch.
constexpr Pace sheetPaces[] = {{10, 4}, {100, 16}};

// A sheet through (x, y, 0) whose rows rise at `slope`, with a velocity.
void addSheet(Scene& scene, float x, float y, float slope, const Vec3& velocity) {
    const auto first = static_cast<std::ptrdiff_t>(scene.particles.size());
    const float length = std::sqrt(1 + slope * slope), half = 0.5f * spacing * (side - 1);
    addCloth(scene, {.origin = {x - half / length, y - half * slope / length, -half},
                     .right = {1 / length, slope / length, 0},
                     .down = {0, 0, 1},
                     .size = {side, side},
                     .spacing = spacing,
                     .thickness = 2 * thickness});
    std::for_each(scene.particles.begin() + first, scene.particles.end(),
                  [&](Particle& particle) { particle.velocity = velocity; });
}

// The upper of two sheets comes with the speed, which is 0 for the lower one.
Scene sheets(const std::string& kind, double speed) {
    Scene scene;
    scene.gravity = {};
    const auto v = static_cast<float>(speed);
    const float gap = 3 * thickness + 0.3f * v / 60;
    addSheet(scene, 0, 0, 0, {});
    if (kind == "laid on") addSheet(scene, 0.4f * spacing, gap, 0, {0, -v, 0});
    if (kind == "aslant") addSheet(scene, 0.4f * spacing, gap + 0.08f, 0.5f, {0, -v, 0});
    // it sinks by a tenth of its way
    if (kind == "dragged") addSheet(scene, -3 * gap, 3 * thickness + 0.02f, 0, {v, -0.1f * v, 0});
    if (kind == "both fly") {
        addSheet(scene, 0.4f * spacing, gap, 0, {0, -0.5f * v, 0});
        for (std::size_t i = 0; i < side * side; ++i) scene.particles[i].velocity = {0, 0.5f * v, 0};
    }
    return scene;
}

// Number of points that pass through a face of the other sheet in a step.
int passages(const Scene& scene, const std::vector<Vector3d>& before, const std::vector<Vector3d>& after) {
    int passed = 0;
    for (const Face& face : scene.faces) {
        const auto& k = face.particles;
        test::Corners from, to;
        Vector3d low = before[k[0]], high = low;
        for (std::size_t c = 0; c < 3; ++c) {
            from[c] = before[k[c]];
            to[c] = after[k[c]];
            low = low.cwiseMin(from[c]).cwiseMin(to[c]);
            high = high.cwiseMax(from[c]).cwiseMax(to[c]);
        }
        const std::size_t other = k[0] < side * side ? side * side : 0;
        for (std::size_t i = other; i < other + side * side; ++i) {
            if ((before[i].cwiseMin(after[i]).array() > high.array()).any() ||
                (before[i].cwiseMax(after[i]).array() < low.array()).any())
                continue;
            passed += test::passesThrough(before[i], after[i], from, to) ? 1 : 0;
        }
    }
    return passed;
}

double fastestOf(const std::vector<Vector3d>& v) {
    double most = 0;
    for (const Vector3d& one : v) most = std::max(most, one.norm());
    return most;
}

// A square of 2 x 1.5 metres in y and z, that moves from `from` to `to` along x in the given number of steps.
void addWall(Scene& scene, double from, double to, int steps) {
    MeshCollider mesh{.name = "wall", .thickness = thickness};
    for (const float z : {-1.5f, 1.5f})
        for (const float y : {-1.5f, 1.5f}) mesh.vertices.push_back({0, y, z});
    mesh.triangles = {{0, 1, 2}, {1, 3, 2}};
    mesh.path = {{0, {{static_cast<float>(from), 0, 0}}},
                 {static_cast<float>(steps / 60.0), {{static_cast<float>(to), 0, 0}}},
                 {100, {{static_cast<float>(to), 0, 0}}}};
    addMeshCollider(scene, mesh);
}

} // namespace

// Each substep is a step of its own, so that the whole path of each point is seen. With contacts alone points
// passed faces 6 to 582 times, except where a sheet is dragged.
TEST(TwoSheets, PassNothingOfEachOther) {
    for (const std::string kind : {"laid on", "aslant", "dragged", "both fly"})
        for (const auto& [speed, substeps] : sheetPaces) {
            Scene scene = sheets(kind, speed);
            scene.dt /= static_cast<float>(substeps);
            test::Runner runner(scene, {.substeps = 1, .contactRoom = 512});
            int passed = 0;
            double fastest = 0;
            auto before = runner.positions();
            for (std::uint32_t step = 0; step < 4 * substeps; ++step) {
                ASSERT_FALSE(runner.run(1).isUndone) << kind;
                const auto after = runner.positions();
                passed += passages(scene, before, after);
                before = after;
                fastest = std::max(fastest, fastestOf(runner.velocities()));
            }
            std::printf("%s, %.0f m/s, %u substeps: %d passages, fastest %.3f\n", kind.c_str(), speed,
                        substeps, passed, fastest / speed);
            EXPECT_EQ(passed, 0) << kind << ", " << speed << " m/s, " << substeps << " substeps";
            EXPECT_LE(fastest, 2 * speed) << kind << ", " << speed << " m/s, " << substeps << " substeps";
        }
}

TEST(TwoSheets, EndInTheSameBitsForAnyMarginAndOrder) {
    for (const std::string kind : {"aslant", "both fly"}) {
        const Scene scene = sheets(kind, 100);
        const Settings settings{.substeps = 16, .contactRoom = 512};
        const std::uint64_t hash = test::hashOfRun(scene, settings, 3);
        Settings wide = settings, reversed = settings;
        wide.contactMargin = 1.3f;
        reversed.isReversed = true;
        EXPECT_EQ(test::hashOfRun(scene, wide, 3), hash) << kind << ", another margin";
        EXPECT_EQ(test::hashOfRun(scene, reversed, 3), hash) << kind << ", reversed";
    }
}

TEST(TwoSheets, KeepTheirMomentum) {
    const Scene scene = sheets("aslant", 100);
    const auto momentumOf = [&](const std::vector<Vector3d>& v) {
        Vector3d sum = Vector3d::Zero();
        for (std::size_t i = 0; i < v.size(); ++i) sum += v[i] / double{scene.particles[i].inverseMass};
        return sum;
    };
    test::Runner runner(scene, {.substeps = 16, .contactRoom = 512});
    const Vector3d before = momentumOf(runner.velocities());
    ASSERT_FALSE(runner.run(3).isUndone);
    const auto v = runner.velocities();
    EXPECT_GT(v[60].norm(), 1) << "the lower one was hit";
    EXPECT_LT((momentumOf(v) - before).norm(), 1e-5 * before.norm());
}

// Two walls come from both sides, at half of the speed each, and leave a part of the target's thickness.
TEST(ClosingMeshes, PassNothingThatIsBetweenThem) {
    for (const std::string target : {"cloth", "voxels", "voxels with faces", "row"})
        for (const auto& [speed, substeps] : paces) {
            Scene scene;
            scene.gravity = {};
            double width = 0, left = 0; // of the target, and between the walls in the end [m]
            if (target == "cloth") {
                addCloth(scene, {.origin = {0, -0.15f, -0.15f},
                                 .right = {0, 1, 0},
                                 .down = {0, 0, 1},
                                 .size = {side, side},
                                 .spacing = spacing,
                                 .thickness = 2 * thickness});
                left = 2.4 * (double{scene.particles[0].radius} + double{thickness});
            } else if (target == "row") {
                for (int i = 0; i < 5; ++i)
                    scene.particles.push_back(
                        {.position = {0.1f * static_cast<float>(i), 0.03f, 0.02f}, .radius = 0.05f});
                width = 0.4;
                left = width + 0.13;
            } else {
                addLattice(
                    scene,
                    {.origin = {0, -0.25f, -0.25f}, .cells = {5, 5, 5}, .spacing = 0.1f, .radius = 0.05f});
                if (target != "voxels") addSurfaceFaces(scene, scene.grids[0]);
                width = 0.5;
                left = 0.8 * width + 0.12;
            }
            const std::size_t count = scene.particles.size();
            // The first wall carries the target to the second one.
            const int steps = speed > 50 ? 1 : 2;
            const double way = speed * steps / 60, end = 0.5 * width + 0.3 * way;
            const double first = end - 0.5 * left, second = end + 0.5 * left;
            addWall(scene, first - way, first, steps);
            addWall(scene, second + way, second, steps);
            test::Runner runner(scene, {.substeps = substeps, .contactRoom = 512});
            int behind = 0;
            double fastest = 0;
            for (int step = 1; step <= steps + 3; ++step) {
                ASSERT_FALSE(runner.run(1).isUndone) << target;
                const auto x = runner.positions(), v = runner.velocities();
                const double still = way * (1 - std::min(1.0, static_cast<double>(step) / steps));
                for (std::size_t i = 0; i < count; ++i) {
                    const bool isBeside = std::max(std::abs(x[i].y()), std::abs(x[i].z())) > 1.5;
                    const bool isBetween = x[i].x() > first - still && x[i].x() < second + still;
                    behind += isBeside || isBetween ? 0 : 1;
                    fastest = std::max(fastest, v[i].norm() / speed);
                }
            }
            std::printf("%s, walls at %.0f m/s, %u substeps: %d behind, fastest %.3f\n", target.c_str(),
                        speed, substeps, behind, fastest);
            EXPECT_EQ(behind, 0) << target << ", " << speed << " m/s, " << substeps << " substeps";
            EXPECT_LE(fastest, 2) << target << ", " << speed << " m/s, " << substeps << " substeps";
        }
}
