// Tests of fast meshes, and of fast bodies that hit meshes: no particle passes, at any speed and with any
// mass ratio, and no particle gains excessive speed.
#include "sim/runner.hpp"
#include "sinew/bodies.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

using namespace sinew;
using namespace sinew::sim;
using Eigen::Vector3d;

namespace {

constexpr float thickness = 0.01f;

// A square of 2 x half metres in y and z, divided into cells^2 x 2 triangles.
MeshCollider wall(float half, std::uint32_t cells) {
    MeshCollider mesh{.name = "wall", .thickness = thickness};
    const auto at = [&](std::uint32_t k) {
        return half * (2 * static_cast<float>(k) / static_cast<float>(cells) - 1);
    };
    for (std::uint32_t z = 0; z <= cells; ++z)
        for (std::uint32_t y = 0; y <= cells; ++y) mesh.vertices.push_back({0, at(y), at(z)});
    for (std::uint32_t z = 0; z < cells; ++z)
        for (std::uint32_t y = 0; y < cells; ++y) {
            const std::uint32_t a = z * (cells + 1) + y, b = a + 1, c = a + cells + 1;
            mesh.triangles.push_back({a, b, c});
            mesh.triangles.push_back({b, c + 1, c});
        }
    return mesh;
}

// A closed box with its front at x = 0.
MeshCollider slab(float depth, float half) {
    MeshCollider mesh{.name = "slab", .thickness = thickness};
    for (const float z : {-half, half})
        for (const float y : {-half, half})
            for (const float x : {-depth, 0.0f}) mesh.vertices.push_back({x, y, z});
    mesh.triangles = {{0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}, {0, 1, 5}, {0, 5, 4},
                      {2, 6, 7}, {2, 7, 3}, {0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}};
    return mesh;
}

MeshCollider meshOf(const std::string& kind) {
    if (kind == "wall") return wall(2, 1);
    return kind == "net" ? wall(1.5f, 10) : slab(0.3f, 2);
}

ClothSheet sheet(const Vec3& origin, const Vec3& right) {
    return {.origin = origin,
            .right = right,
            .down = {0, 0, 1},
            .size = {15, 15},
            .spacing = 0.03f,
            .thickness = 0.02f};
}

// A target at x >= 0, without gravity.
Scene targetOf(const std::string& kind) {
    Scene scene;
    scene.gravity = {0, 0, 0};
    const int balls = kind == "ball" ? 1 : kind == "row" ? 6 : 0;
    for (int i = 0; i < balls; ++i)
        scene.particles.push_back(
            {.position = {0.1f * static_cast<float>(i), 0.03f, 0.02f}, .radius = 0.05f});
    if (kind == "cloth") addCloth(scene, sheet({0, -0.21f, -0.21f}, {0, 1, 0}));
    if (kind == "aslant") addCloth(scene, sheet({0, -0.21f, -0.21f}, {0.6f, 0.8f, 0}));
    if (kind == "edgewise") addCloth(scene, sheet({0, 0.01f, -0.21f}, {1, 0, 0}));
    if (!kind.starts_with("voxels")) return scene;
    addLattice(scene, {.origin = {0, -0.25f, -0.25f},
                       .cells = {5, 5, 5},
                       .spacing = 0.1f,
                       .radius = 0.05f,
                       .isCuttable = kind == "voxels that may be cut"});
    if (kind != "voxels") addSurfaceFaces(scene, scene.grids[0]);
    return scene;
}

struct Trial {
    std::string mesh, target;
    double speed = 0; // [m/s]
    std::uint32_t substeps = 0;
    bool isThrown = false; // the target moves, the mesh stands still
    int steps = 3;

    double start() const { return -0.1 - 0.37 * speed / 60; } // they meet within the first step
    double wallAt(int step) const { return isThrown ? start() : start() + speed * step / 60; }
    std::string name() const {
        char text[200];
        std::snprintf(text, sizeof text, "%s, %s%s, %.0f m/s, %u substeps", mesh.c_str(), target.c_str(),
                      isThrown ? " thrown" : "", speed, substeps);
        return text;
    }
    Scene scene() const {
        Scene scene = targetOf(target);
        if (isThrown)
            for (Particle& particle : scene.particles) particle.velocity.x = -static_cast<float>(speed);
        MeshCollider collider = meshOf(mesh);
        if (isThrown)
            for (Vec3& vertex : collider.vertices) vertex.x += static_cast<float>(start());
        else
            for (const int step : {0, steps})
                collider.path.push_back(
                    {static_cast<float>(step / 60.0), {{static_cast<float>(wallAt(step)), 0, 0}}});
        addMeshCollider(scene, collider);
        return scene;
    }
};

struct Result {
    int behind = 0;
    double deepest = 0; // depth beyond the reach [reaches]
    double fastest = 0; // relative speed [speeds of the trial]
};

Result resultOf(const Trial& trial) {
    const Scene scene = trial.scene();
    const std::size_t count = targetOf(trial.target).particles.size();
    test::Runner runner(scene, {.substeps = trial.substeps, .contactRoom = 256});
    Result result;
    for (int step = 1; step <= trial.steps; ++step) {
        const Status status = runner.run(1);
        EXPECT_FALSE(status.isUndone) << trial.name() << ": needs room for " << status.contactRoom;
        const auto x = runner.positions(), v = runner.velocities();
        for (std::size_t i = 0; i < count; ++i) {
            const double height = x[i].x() - trial.wallAt(step),
                         reach = double{scene.particles[i].radius} + double{thickness};
            result.behind += height < 0 ? 1 : 0;
            result.deepest = std::max(result.deepest, 1 - height / reach);
            result.fastest =
                std::max(result.fastest,
                         (v[i] + Vector3d(trial.isThrown ? trial.speed : 0, 0, 0)).norm() / trial.speed);
        }
    }
    return result;
}

// Contacts keep at least a twentieth of the reach, and half of that if several substeps press in a row.
void expectHeld(const Trial& trial, double mostSpeed, double mostDepth = 0.96) {
    const Result result = resultOf(trial);
    std::printf("%s: %d behind, deepest %.1e, fastest %.3f\n", trial.name().c_str(), result.behind,
                result.deepest, result.fastest);
    EXPECT_EQ(result.behind, 0) << trial.name();
    EXPECT_LE(result.deepest, mostDepth) << trial.name();
    EXPECT_LE(result.fastest, mostSpeed) << trial.name();
}

struct Pace {
    double speed;
    std::uint32_t substeps;
};
constexpr Pace paces[] = {{10, 4}, {100, 16}, {1000, 4}};

} // namespace

// The path of a substep is 0.7 to 350 reaches. An elastic impact gives 2 V. Voxels vibrate, and single
// particles are slightly faster for a while.
TEST(HardMeshes, ThatMovePassNothing) {
    for (const std::string target : {"ball", "row", "cloth", "voxels"}) {
        const double most = target == "voxels" ? 2.15 : 2;
        for (const auto& [speed, substeps] : paces) expectHeld({"wall", target, speed, substeps}, most);
        expectHeld({"net", target, 100, 8}, most);
        expectHeld({"slab", target, 1000, 64}, most);
    }
}

// A body that crumples collides with itself, which accelerates it.
TEST(HardMeshes, ThatMovePassNothingThatCrumples) {
    for (const char* target : {"aslant", "edgewise", "voxels with faces", "voxels that may be cut"})
        for (const auto& [speed, substeps] : paces) expectHeld({"wall", target, speed, substeps}, 3, 0.99);
}

TEST(HardMeshes, ThatStandStillArePassedByNobody) {
    for (const char* target : {"ball", "row", "cloth", "voxels"})
        for (const auto& [speed, substeps] : paces) expectHeld({"wall", target, speed, substeps, true}, 2);
}

TEST(HardMeshes, GiveTheSameBitsInAnyOrderAndMargin) {
    for (const char* target : {"aslant", "voxels with faces", "voxels that may be cut"}) {
        const Trial trial{"net", target, 100, 8, target == std::string("aslant")};
        const Scene scene = trial.scene();
        const auto hashWith = [&](bool isReversed, float margin) {
            return test::hashOfRun(scene,
                                   {.substeps = trial.substeps,
                                    .contactMargin = margin,
                                    .contactRoom = 256,
                                    .isReversed = isReversed},
                                   2);
        };
        constexpr float usual = Settings{}.contactMargin;
        const std::uint64_t hash = hashWith(false, usual);
        EXPECT_EQ(hashWith(true, usual), hash) << trial.name();
        EXPECT_EQ(hashWith(false, 1.3f), hash) << trial.name();
    }
}

// Other balls stop a ball on its path, so it is not where its velocity would have brought it.
TEST(HardColliders, ThatMoveArePassedByNoRow) {
    for (const std::uint32_t substeps : {4u, 8u, 16u}) {
        Trial trial{"", "row", 100, substeps};
        Scene scene = targetOf(trial.target);
        for (Particle& particle : scene.particles) particle.contactOffset = particle.radius;
        Collider box{.shape = ColliderShape::box, .halfExtents = {0.15f, 2, 2}};
        for (const int step : {0, trial.steps})
            box.path.push_back({static_cast<float>(step / 60.0),
                                {{static_cast<float>(trial.wallAt(step)) - box.halfExtents.x, 0, 0}}});
        scene.colliders.push_back(box);
        test::Runner runner(scene, {.substeps = substeps});
        for (int step = 1; step <= trial.steps; ++step) {
            runner.run(1);
            const auto x = runner.positions(), v = runner.velocities();
            for (std::size_t i = 0; i < x.size(); ++i) {
                EXPECT_GE(x[i].x() - trial.wallAt(step), 0.05 - 1e-4) << trial.name() << ", ball " << i;
                EXPECT_LE(v[i].norm(), 2 * trial.speed) << trial.name() << ", ball " << i;
            }
        }
    }
}
