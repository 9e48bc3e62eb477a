// Particles that touch triangles, on the device: rest, momentum, fast particles, cloth on meshes, on itself
// and in stacks, and the same bits whatever lists look like.
#include "sim/bodies.hpp"
#include "sim/compile.hpp"
#include "sim/runner.hpp"
#include "sim/scenes.hpp"
#include "sim/simulation.hpp"
#include "sim/validate.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <numbers>

using namespace sinew;
using namespace sinew::sim;
using Eigen::Vector3d;

namespace {

constexpr float radius = 0.02f, thickness = 0.01f;
constexpr double reach = 0.03;

Particle ballAt(const Vec3& position, const Vec3& velocity = {}, float mass = 1) {
    return {.position = position, .velocity = velocity, .inverseMass = 1 / mass, .radius = radius};
}

// A triangle in the plane y = 0 around the origin, its corners of `mass` [kg] each; 0 = they never move.
Scene triangle(float mass) {
    Scene scene;
    const float w = mass > 0 ? 1 / mass : 0;
    for (const Vec3& corner : {Vec3{-1, 0, -0.6f}, Vec3{1, 0, -0.6f}, Vec3{0, 0, 1.2f}})
        scene.particles.push_back({.position = corner, .inverseMass = w});
    scene.faces.push_back({{0, 1, 2}, thickness});
    return scene;
}

Scene weightless(Scene scene) {
    scene.gravity = {};
    return scene;
}

Vector3d momentum(const Scene& scene, const std::vector<Vector3d>& v) {
    Vector3d sum = Vector3d::Zero();
    for (std::size_t i = 0; i < v.size(); ++i)
        if (scene.particles[i].inverseMass > 0) sum += v[i] / double{scene.particles[i].inverseMass};
    return sum;
}

Vector3d angularMomentum(const Scene& scene, const std::vector<Vector3d>& x, const std::vector<Vector3d>& v) {
    Vector3d sum = Vector3d::Zero();
    for (std::size_t i = 0; i < v.size(); ++i)
        if (scene.particles[i].inverseMass > 0)
            sum += x[i].cross(v[i]) / double{scene.particles[i].inverseMass};
    return sum;
}

double rms(const std::vector<Vector3d>& v) {
    double sum = 0;
    for (const Vector3d& one : v) sum += one.squaredNorm();
    return std::sqrt(sum / static_cast<double>(v.size()));
}

std::uint64_t hashOf(const Scene& scene, const Settings& settings, int steps) {
    test::Runner runner(scene, settings);
    for (int step = 0; step < steps; ++step) {
        const Status status = runner.run(1);
        EXPECT_EQ(status.nonFinite, 0u);
        EXPECT_EQ(status.contactRoom, 0u);
    }
    return runner.stateHash();
}

// Whether segment a b passes through the inside of a triangle.
bool passes(const Vector3d& a, const Vector3d& b, const std::array<Vector3d, 3>& x) {
    const Vector3d n = (x[1] - x[0]).cross(x[2] - x[0]);
    const double ha = n.dot(a - x[0]), hb = n.dot(b - x[0]);
    if (!(ha * hb < 0)) return false;
    const Vector3d p = a + (b - a) * (ha / (ha - hb));
    for (int k = 0; k < 3; ++k)
        if (!((x[(k + 1) % 3] - x[k]).cross(p - x[k]).dot(n) > 0)) return false;
    return true;
}

// Edges of faces that pass through faces they share no corner with.
int intersections(const Scene& scene, const std::vector<Vector3d>& x) {
    int found = 0;
    for (const Face& face : scene.faces) {
        const std::array<Vector3d, 3> at{x[face.particles[0]], x[face.particles[1]], x[face.particles[2]]};
        const Vector3d low = at[0].cwiseMin(at[1]).cwiseMin(at[2]),
                       high = at[0].cwiseMax(at[1]).cwiseMax(at[2]);
        for (const Face& other : scene.faces)
            for (int k = 0; k < 3; ++k) {
                const std::uint32_t a = other.particles[k], b = other.particles[(k + 1) % 3];
                const auto isCorner = [&](std::uint32_t i) {
                    return std::ranges::count(face.particles, i) > 0;
                };
                if (a > b || isCorner(a) || isCorner(b)) continue;
                if ((x[a].cwiseMax(x[b]) - low).minCoeff() < 0 || (high - x[a].cwiseMin(x[b])).minCoeff() < 0)
                    continue;
                found += passes(x[a], x[b], at) ? 1 : 0;
            }
    }
    return found;
}

} // namespace

TEST(FaceContacts, CarryAParticleOnEitherSideOfAFixedTriangle) {
    for (const float up : {1.0f, -1.0f}) {
        Scene scene = triangle(0);
        scene.gravity = {0, -9.81f * up, 0};
        scene.particles.push_back(ballAt({0.1f, 0.2f * up, 0.05f}));
        test::Runner runner(scene, {.substeps = 16});
        runner.run(30);
        EXPECT_NEAR(runner.positions()[3].y() * double{up}, reach, 1e-6);
        EXPECT_NEAR(runner.positions()[3].x(), 0.1, 1e-6) << "no way aside";
        EXPECT_LE(runner.velocities()[3].norm(), 1e-5);
    }
}

// Inelastic, in the middle of the substep in which they meet: with D = w + sum b^2 w_k, the point's velocity
// v becomes v (1 - w / D), and corner k gets v b_k w_k / D.
TEST(FaceContacts, ShareAnImpulseAmongCornersByTheirWeights) {
    Scene scene = weightless(triangle(2));
    const std::array<double, 3> b{0.5, 0.3, 0.2};
    Vector3d foot = Vector3d::Zero();
    for (int k = 0; k < 3; ++k) foot += b[k] * test::toVector(scene.particles[k].position);
    scene.particles.push_back(
        ballAt({static_cast<float>(foot.x()), 0.05f, static_cast<float>(foot.z())}, {0, -1, 0}));
    test::Runner runner(scene, {.substeps = 16});
    runner.run(2);
    const double D = 1 + 0.5 * (b[0] * b[0] + b[1] * b[1] + b[2] * b[2]);
    const auto v = runner.velocities();
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(v[k].y(), -b[k] * 0.5 / D, 2e-3) << "corner " << k;
    EXPECT_NEAR(v[3].y(), -(1 - 1 / D), 2e-3);
}

// A free sheet in a hail of particles, with friction.
TEST(FaceContacts, OfASheetInAHailKeepMomentum) {
    for (const float friction : {0.0f, 0.5f}) {
        Scene scene;
        addCloth(scene, {.origin = {-0.5f, 0, -0.5f},
                         .size = {11, 11},
                         .spacing = 0.1f,
                         .areaDensity = 5,
                         .membraneStiffness = 500,
                         .thickness = 0.02f});
        scene.gravity = {};
        scene.contacts.friction = friction;
        for (int i = 0; i < 40; ++i) {
            const auto at = [i](int prime) { return static_cast<float>((i * prime) % 37) / 41.0f - 0.45f; };
            const float side = i % 2 == 0 ? 1.0f : -1.0f;
            scene.particles.push_back(ballAt({at(5), side * (0.1f + 0.01f * static_cast<float>(i)), at(11)},
                                             {0.3f, -3 * side, at(7)}, 0.05f));
        }
        test::Runner runner(scene, {.substeps = 16, .contactRoom = 64});
        const Vector3d before = momentum(scene, runner.velocities());
        const Vector3d turning = angularMomentum(scene, runner.positions(), runner.velocities());
        double scale = 0;
        for (std::size_t i = 121; i < scene.particles.size(); ++i) scale += 0.05 * 3;
        ASSERT_EQ(runner.run(20).contactRoom, 0u);
        const auto x = runner.positions(), v = runner.velocities();
        double through = 0;
        for (std::size_t i = 121; i < x.size(); ++i)
            through += v[i].y() * (i % 2 == 1 ? -1 : 1) > 2.9 ? 1 : 0;
        const double linear = (momentum(scene, v) - before).norm() / scale;
        const double angular = (angularMomentum(scene, x, v) - turning).norm() / scale;
        std::printf("friction %.1f: momentum %.1e, angular %.1e m of all that was thrown; untouched %.0f\n",
                    double{friction}, linear, angular, through);
        EXPECT_LE(linear, 1e-6);
        // Not exact: an impulse that moves positions too turns by itself x the way since, and links and
        // friction do not act between the very places.
        EXPECT_LE(angular, 2e-3);
        EXPECT_LE(through, 4);
    }
}

// Case 27: up to 100 thicknesses a substep, straight and aslant, upon a face that moves and one that does
// not.
TEST(FaceContacts, StopAParticleThatIsFasterThanTheirThickness) {
    for (const float mass : {0.0f, 100.0f})
        for (const float speed : {5.0f, 60.0f, 300.0f, 3000.0f})
            for (const float aside : {0.0f, 0.4f}) {
                Scene scene = weightless(triangle(mass));
                for (Particle& corner : scene.particles)
                    corner.position = {20 * corner.position.x, 0, 20 * corner.position.z};
                const float start = 0.037f * speed;
                scene.particles.push_back(
                    ballAt({0.1f - aside * start, start, 0.05f}, {aside * speed, -speed, 0}, 0.01f));
                test::Runner runner(scene, {.substeps = 4});
                ASSERT_EQ(runner.run(6).nonFinite, 0u);
                const auto x = runner.positions(), v = runner.velocities();
                const Vector3d n = (x[2] - x[0]).cross(x[1] - x[0]).normalized();
                EXPECT_GE(n.dot(x[3] - x[0]), 0.99 * reach)
                    << speed << " m/s, corners of " << mass << " kg, aside " << aside;
                EXPECT_LE(std::abs(n.dot(v[3])), 0.02 * double{speed}) << "no rebound";
            }
}

TEST(FaceContacts, LetAParticlePassBesideThem) {
    Scene scene = weightless(triangle(0));
    for (const Vec3& at : {Vec3{0, 0.5f, -0.64f}, Vec3{1.04f, 0.5f, -0.6f}, Vec3{0.8f, 0.5f, 0.4f}})
        scene.particles.push_back(ballAt(at, {0, -40, 0}));
    test::Runner runner(scene, {.substeps = 8});
    runner.run(3);
    for (std::size_t i = 3; i < 6; ++i) EXPECT_LE(runner.positions()[i].y(), -1) << "particle " << i;
}

// Hard case 18: on a line, in a point, and nearly so; the whole face beside them carries.
TEST(FaceContacts, WithDegenerateFacesAreNoneAndDoNoHarm) {
    Scene scene = triangle(0);
    for (const Vec3& corner : {Vec3{0, 0, 0}, Vec3{0.5f, 0, 0}, Vec3{0.25f, 0, 0}, Vec3{0.25f, 0, 1e-6f}})
        scene.particles.push_back({.position = corner, .inverseMass = 1});
    scene.particles.push_back({.position = {0, 0, 0}, .inverseMass = 1});
    for (std::uint32_t i = 3; i < 8; ++i) scene.fixed.push_back({i});
    scene.faces.push_back({{3, 4, 5}, thickness});
    scene.faces.push_back({{3, 4, 6}, thickness});
    scene.faces.push_back({{3, 7, 3 + 1}, thickness});
    scene.particles.push_back(ballAt({0.2f, 0.1f, 0}));
    scene.particles.push_back(ballAt({0, -0.1f, 0}, {0, 3, 0}));
    test::Runner runner(scene, {.substeps = 16});
    ASSERT_EQ(runner.run(30).nonFinite, 0u);
    EXPECT_NEAR(runner.positions()[8].y(), reach, 1e-5);
    EXPECT_LE(runner.positions()[9].y(), -reach);
}

// An incline as two triangles with an edge along it: sticks and slides at Coulomb's angle.
TEST(FaceContacts, HoldByFrictionUpToItsAngle) {
    const auto slid = [](float degrees) {
        Scene scene;
        const float angle = degrees * std::numbers::pi_v<float> / 180;
        scene.gravity = {9.81f * std::sin(angle), -9.81f * std::cos(angle), 0};
        scene.contacts.friction = 0.5f;
        addMeshCollider(scene, {.vertices = {{-2, 0, -2}, {-2, 0, 2}, {2, 0, 2}, {2, 0, -2}},
                                .triangles = {{0, 1, 2}, {0, 2, 3}},
                                .thickness = thickness});
        scene.particles.push_back(ballAt({0.1f, 0.03f, 0.7f}));
        test::Runner runner(scene, {.substeps = 16});
        runner.run(60);
        return runner.positions()[4].x() - 0.1;
    };
    EXPECT_NEAR(slid(26), 0, 1e-4) << "atan 0.5 = 26.57 degrees";
    const double angle = 30 * std::numbers::pi / 180;
    EXPECT_NEAR(slid(30), 0.5 * 9.81 * (std::sin(angle) - 0.5 * std::cos(angle)), 0.01);
}

namespace {

// A ball of triangles, `rings` from pole to pole.
MeshCollider sphere(float size, std::uint32_t rings) {
    MeshCollider mesh{.name = "ball", .thickness = 0.005f};
    const std::uint32_t around = 2 * rings;
    for (std::uint32_t r = 0; r <= rings; ++r)
        for (std::uint32_t s = 0; s < around; ++s) {
            const double theta = std::numbers::pi * r / rings, phi = 2 * std::numbers::pi * s / around;
            mesh.vertices.push_back({size * static_cast<float>(std::sin(theta) * std::cos(phi)),
                                     size * static_cast<float>(std::cos(theta)),
                                     size * static_cast<float>(std::sin(theta) * std::sin(phi))});
        }
    for (std::uint32_t r = 0; r < rings; ++r) // triangles at the poles have no area: a case of their own
        for (std::uint32_t s = 0; s < around; ++s) {
            const std::uint32_t a = r * around + s, b = r * around + (s + 1) % around;
            mesh.triangles.push_back({a, b, b + around});
            mesh.triangles.push_back({a, b + around, a + around});
        }
    return mesh;
}

Scene clothOnBall() {
    Scene scene;
    addMeshCollider(scene, sphere(0.3f, 12));
    addCloth(scene, {.origin = {-0.5f, 0.35f, -0.5f},
                     .size = {26, 26},
                     .spacing = 0.04f,
                     .areaDensity = 0.3f,
                     .membraneStiffness = 1000,
                     .bendingStiffness = 1e-4f,
                     .thickness = 0.02f});
    scene.contacts.friction = 0.3f;
    scene.damping = 0.5f;
    scene.planes = {{.offset = -0.5f, .friction = 0.5f}};
    return scene;
}

// A sheet that stands upright and falls onto itself.
Scene fallingFold() {
    Scene scene;
    addCloth(scene, {.origin = {-0.2f, 0.8f, 0},
                     .down = {0, -1, 0},
                     .size = {11, 41},
                     .spacing = 0.02f,
                     .areaDensity = 0.3f,
                     .membraneStiffness = 500,
                     .bendingStiffness = 2e-5f,
                     .thickness = 0.01f});
    for (Particle& particle : scene.particles) // it leans, so that it does not stand on its edge
        particle.position.z += 0.03f * std::sin(7 * particle.position.y);
    scene.contacts.friction = 0.2f;
    scene.damping = 1;
    scene.planes = {{.friction = 0.5f}};
    return scene;
}

Scene layers(std::uint32_t count) {
    Scene scene;
    for (std::uint32_t layer = 0; layer < count; ++layer)
        addCloth(scene, {.name = "layer " + std::to_string(layer),
                         .origin = {0.004f * static_cast<float>(layer % 3),
                                    0.02f + 0.015f * static_cast<float>(layer),
                                    0.003f * static_cast<float>(layer % 5)},
                         .size = {8, 8},
                         .spacing = 0.03f,
                         .areaDensity = 0.3f,
                         .membraneStiffness = 500,
                         .thickness = 0.01f});
    scene.contacts.friction = 0.2f;
    scene.damping = 1;
    scene.planes = {{.friction = 0.5f}};
    return scene;
}

} // namespace

TEST(FaceContacts, LayAClothOverABallOfTriangles) {
    const Scene scene = clothOnBall();
    test::Runner runner(scene, {.substeps = 16, .contactRoom = 96});
    const std::size_t first = scene.bodies[1].firstParticle;
    double deepest = 0;
    for (int step = 0; step < 90; ++step) {
        const Status status = runner.run(1);
        ASSERT_EQ(status.nonFinite + status.contactRoom, 0u) << "step " << step;
        if (step % 5 != 4) continue;
        const auto x = runner.positions();
        for (std::size_t i = first; i < x.size(); ++i) deepest = std::max(deepest, 0.3 - x[i].norm());
    }
    const auto x = runner.positions(), v = runner.velocities();
    std::printf("cloth on ball: %.5f m into the sphere around the mesh, v rms %.3f m/s, %d intersections\n",
                deepest, rms(v), intersections(scene, x));
    const double sagitta = 0.3 * (1 - std::cos(std::numbers::pi / 24)); // of facets below the sphere
    EXPECT_LE(deepest, 2 * sagitta) << "they stay outside the facets";
    EXPECT_EQ(intersections(scene, x), 0);
}

// Hard case 17.
TEST(FaceContacts, KeepAFallingFoldOutOfItself) {
    const Scene scene = fallingFold();
    test::Runner runner(scene, {.substeps = 32, .contactRoom = 96});
    int worst = 0;
    for (int step = 0; step < 150; ++step) {
        const Status status = runner.run(1);
        ASSERT_EQ(status.nonFinite + status.contactRoom, 0u) << "step " << step;
        if (step % 10 == 9) worst = std::max(worst, intersections(scene, runner.positions()));
    }
    double high = 0;
    for (const Vector3d& x : runner.positions()) high = std::max(high, x.y());
    std::printf("fold: %d edges through faces at worst, %d at the end; %.3f m high, v rms %.4f m/s\n", worst,
                intersections(scene, runner.positions()), high, rms(runner.velocities()));
    EXPECT_EQ(intersections(scene, runner.positions()), 0);
    EXPECT_LE(worst, 20) << "two edges may cross for a while: only points and faces are kept apart";
    EXPECT_LE(high, 0.25) << "it lies in folds";
}

// Hard case 16: no layer changes places with another.
TEST(FaceContacts, KeepAStackOfLayersInOrder) {
    constexpr std::uint32_t count = 20;
    const Scene scene = layers(count);
    test::Runner runner(scene, {.substeps = 32, .contactRoom = 96});
    for (int step = 0; step < 90; ++step) {
        const Status status = runner.run(1);
        ASSERT_EQ(status.nonFinite + status.contactRoom, 0u) << "step " << step;
    }
    const auto x = runner.positions();
    double lowest = 1;
    for (std::uint32_t layer = 0; layer + 1 < count; ++layer)
        for (std::uint32_t i = 0; i < 64; ++i) { // inside, where sheets lie over each other
            const std::uint32_t row = i / 8, column = i % 8;
            if (row == 0 || row == 7 || column == 0 || column == 7) continue;
            lowest = std::min(lowest, x[64 * (layer + 1) + i].y() - x[64 * layer + i].y());
        }
    std::printf(
        "layers: %.4f of a thickness between two at least, %.4f m high, v rms %.4f, %d intersections\n",
        lowest / 0.01, x.back().y(), rms(runner.velocities()), intersections(scene, x));
    EXPECT_GE(lowest, 0.5 * 0.01);
    EXPECT_EQ(intersections(scene, x), 0);
}

TEST(FaceContacts, EndInTheSameBitsForAnyMarginRoomOrderAndForm) {
    Scene scene = fallingFold();
    scene.particles.push_back(
        ballAt({-0.1f, 0.9f, 0.05f}, {0, -3, 0}, 0.01f)); // contacts between particles too
    scene.particles.push_back(ballAt({-0.1f, 1.0f, 0.05f}, {0, -4, 0}, 0.01f));
    constexpr int steps = 30;
    const Settings settings{.substeps = 8, .contactRoom = 160};
    const std::uint64_t hash = hashOf(scene, settings, steps);
    Settings narrow = settings, roomy = settings, reversed = settings, loads = settings;
    narrow.contactMargin = 0.2f;
    roomy.contactRoom = 200;
    reversed.isReversed = true;
    loads.forms.usesTexels = false;
    EXPECT_EQ(hashOf(scene, narrow, steps), hash) << "another margin";
    EXPECT_EQ(hashOf(scene, roomy, steps), hash) << "more room";
    EXPECT_EQ(hashOf(scene, reversed, steps), hash) << "reversed";
    EXPECT_EQ(hashOf(scene, loads, steps), hash) << "without texels";
}

// Hard case 29, as for contacts between particles.
TEST(FaceContacts, ThatHaveNoRoomAreSaidAndRepeatedToTheSameBits) {
    const Scene scene = clothOnBall();
    constexpr int steps = 24;
    const std::uint64_t hash = hashOf(scene, {.substeps = 8, .contactRoom = 128}, steps);
    Settings settings{.substeps = 8, .contactRoom = 1};
    auto runner = std::make_unique<test::Runner>(scene, settings);
    int growths = 0;
    for (int step = 0; step < steps;) {
        const std::uint64_t before = runner->stateHash();
        const Status status = runner->run(1);
        if (status.contactRoom == 0) {
            ++step;
            continue;
        }
        ASSERT_GT(status.contactRoom, settings.contactRoom);
        EXPECT_EQ(runner->stateHash(), before) << "undone";
        settings.contactRoom = status.contactRoom;
        auto larger = std::make_unique<test::Runner>(scene, settings);
        larger->takeOver(*runner);
        EXPECT_EQ(larger->stateHash(), before);
        runner = std::move(larger);
        ++growths;
    }
    EXPECT_GE(growths, 1);
    EXPECT_EQ(runner->stateHash(), hash);
}

TEST(FaceContacts, AreRefusedBySolversWithoutAFormForThem) {
    Scene scene = triangle(0);
    EXPECT_TRUE(validate(scene, {.solver = Solver::jacobi}).empty()) << "nobody to touch it";
    scene.particles.push_back(ballAt({0, 1, 0}));
    for (const Solver solver : {Solver::jacobi, Solver::gaussSeidel}) {
        const auto complaints = validate(scene, {.solver = solver});
        ASSERT_EQ(complaints.size(), 1u);
        EXPECT_NE(complaints[0].find("has no form for particles that touch faces"), std::string::npos);
    }
    EXPECT_TRUE(validate(scene, {}).empty());
}

TEST(FaceContacts, OfFacesThatAreNoneAreRefused) {
    const auto complaint = [](const Face& face) {
        Scene scene = triangle(0);
        scene.faces = {face};
        const auto complaints = validate(scene, {});
        return complaints.size() == 1 ? complaints[0] : std::to_string(complaints.size()) + " complaints";
    };
    EXPECT_NE(complaint({{0, 1, 9}, 0}).find("face[0].particles"), std::string::npos);
    EXPECT_NE(complaint({{0, 1, 1}, 0}).find("are not three"), std::string::npos);
    EXPECT_NE(complaint({{0, 1, 2}, -1}).find("face[0].thickness"), std::string::npos);
    EXPECT_NE(complaint({{0, 1, 2}, NAN}).find("face[0].thickness"), std::string::npos);
}

TEST(FaceContacts, LeaveASceneWithoutThemAlone) {
    Scene scene = test::sheet(6);
    const std::string without = describe(compile(scene, {.substeps = 2}));
    EXPECT_EQ(without.find("face"), std::string::npos);
    scene.faces.push_back({{0, 1, 6}, 0.01f});
    EXPECT_EQ(describe(compile(scene, {.substeps = 2})), without) << "nothing that could touch it";
}
