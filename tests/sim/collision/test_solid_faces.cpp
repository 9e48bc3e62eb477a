// Tests of the one-sided surfaces of voxel bodies in contact with objects smaller than a voxel, whole and
// where a blade has parted them.
#include "sim/compile/compile.hpp"
#include "sim/cutting/cut_body.hpp"
#include "sim/scenes.hpp"
#include "sinew/bodies.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <numbers>

using namespace sinew;
using namespace sinew::sim;
using Eigen::Vector3d;
using test::CutBody;
using test::sweepOf;

namespace {

constexpr float spacing = 0.05f, ballRadius = 0.004f;
constexpr std::uint32_t cells = 6;
constexpr double side = cells * double{spacing}, reach = double{spacing / 2} + double{ballRadius};

Lattice cubeLattice(float youngModulus = 1e5f) {
    return {.name = "cube",
            .cells = {cells, cells, cells},
            .spacing = spacing,
            .youngModulus = youngModulus,
            .radius = spacing / 2};
}

// A cube with a corner at (0, 0, 0), with or without faces.
Scene cube(const Lattice& lattice, bool hasFaces = true) {
    Scene scene{.name = "cube"};
    addLattice(scene, lattice);
    if (hasFaces) addSurfaceFaces(scene, scene.grids[0]);
    return scene;
}

// A cube whose lowest layer is fixed.
Scene heldCube(const Lattice& lattice, bool hasFaces = true) {
    Scene scene = cube(lattice, hasFaces);
    for (std::uint32_t i = 0; i < scene.particles.size(); ++i)
        if (scene.particles[i].position.y == 0) scene.fixed.push_back({i});
    return scene;
}

std::uint32_t addBall(Scene& scene, const Vec3& position, const Vec3& velocity = {}, float mass = 1e-3f) {
    scene.particles.push_back(
        {.position = position, .velocity = velocity, .inverseMass = 1 / mass, .radius = ballRadius});
    return static_cast<std::uint32_t>(scene.particles.size() - 1);
}

// Winding number of the faces around a point: 1 inside the closed surface.
double winding(const Scene& scene, const std::vector<Vector3d>& x, const Vector3d& p) {
    double angle = 0;
    for (const Face& face : scene.faces) {
        const Vector3d a = x[face.particles[0]] - p, b = x[face.particles[1]] - p,
                       c = x[face.particles[2]] - p;
        const double la = a.norm(), lb = b.norm(), lc = c.norm();
        angle +=
            2 * std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
    }
    return angle / (4 * std::numbers::pi);
}

// Balls above the middle of the top of a cube, in rows that do not match its grid.
void addRain(Scene& scene) {
    for (int i = 0; i < 49; ++i)
        addBall(scene,
                {0.05f + 0.031f * static_cast<float>(i % 7), static_cast<float>(side) + 0.06f,
                 0.05f + 0.033f * static_cast<float>(i / 7)},
                {0, -1, 0});
}

int ballsInside(const Scene& faces, const std::vector<Vector3d>& x, std::size_t firstBall) {
    int count = 0;
    for (std::size_t i = firstBall; i < x.size(); ++i) count += winding(faces, x, x[i]) > 0.5 ? 1 : 0;
    return count;
}

Vector3d momentum(const Scene& scene, const std::vector<Vector3d>& v) {
    Vector3d sum = Vector3d::Zero();
    for (std::size_t i = 0; i < v.size(); ++i) sum += v[i] / double{scene.particles[i].inverseMass};
    return sum;
}

double volumeIn(const Scene& scene) {
    double volume = 0;
    for (const Face& face : scene.faces) {
        const auto at = [&](int c) { return test::toVector(scene.particles[face.particles[c]].position); };
        volume += at(0).dot(at(1).cross(at(2))) / 6;
    }
    return volume;
}

} // namespace

TEST(SolidFaces, CloseAVoxelBodyOfAnyShape) {
    std::vector<float> ragged = test::raggedFill(5 * 4 * 6);
    for (const bool isRagged : {false, true}) {
        Lattice lattice{.cells = {5, 4, 6}, .spacing = spacing, .radius = 0.02f};
        if (isRagged) lattice.fill = ragged;
        Scene scene;
        addLattice(scene, lattice);
        addSurfaceFaces(scene, scene.grids[0]);
        std::map<std::array<std::uint32_t, 2>, int> edges; // from lower to higher corner, minus the reverse
        for (const Face& face : scene.faces) {
            EXPECT_TRUE(face.isSolid);
            EXPECT_EQ(face.thickness, 0.02f);
            for (int n = 0; n < 3; ++n) {
                const std::uint32_t a = face.particles[n], b = face.particles[(n + 1) % 3];
                edges[{std::min(a, b), std::max(a, b)}] += a < b ? 1 : -1;
            }
        }
        for (const auto& [ends, sum] : edges) EXPECT_EQ(sum, 0) << ends[0] << " " << ends[1];
        double filled = 120;
        if (isRagged)
            filled = static_cast<double>(std::ranges::count_if(ragged, [](float f) { return f > 0; }));
        EXPECT_NEAR(volumeIn(scene), filled * std::pow(double{spacing}, 3), 1e-9) << "fronts are outside";
        if (!isRagged) {
            EXPECT_EQ(scene.faces.size(), 2u * 2 * (5 * 4 + 4 * 6 + 6 * 5));
        }
    }
}

TEST(SolidFaces, AreNeededWhereSomethingFitsBetweenParticles) {
    Scene scene = cube(cubeLattice(), false);
    EXPECT_TRUE(gridsWithHoles(scene).empty()) << "nothing else is there";
    const std::uint32_t ball = addBall(scene, {0, 1, 0});
    EXPECT_EQ(gridsWithHoles(scene), std::vector<std::uint32_t>{0});
    scene.particles[ball].radius = 0.4f * spacing;
    EXPECT_TRUE(gridsWithHoles(scene).empty()) << "too wide";
    scene.particles[ball].radius = ballRadius;
    scene.fixed.push_back({ball});
    EXPECT_TRUE(gridsWithHoles(scene).empty()) << "never moves";
    Lattice fine = cubeLattice();
    fine.origin = {1, 0, 0};
    fine.spacing = 0.4f * spacing;
    fine.radius = fine.spacing / 2;
    addLattice(scene, fine);
    EXPECT_EQ(gridsWithHoles(scene), std::vector<std::uint32_t>{0}) << "the finer one has none";
}

// The purpose of faces: balls a sixth as wide as the particles rain onto a cube.
TEST(SolidFaces, KeepOutWhatFallsBetweenParticles) {
    const Scene outline = heldCube(cubeLattice());
    int inside[2];
    for (const bool hasFaces : {false, true}) {
        Scene scene = heldCube(cubeLattice(), hasFaces);
        const std::size_t firstBall = scene.particles.size();
        addRain(scene);
        test::Runner runner(scene, {.substeps = 16, .contactRoom = 64});
        ASSERT_EQ(runner.run(30).contactRoom, 0u);
        inside[hasFaces ? 1 : 0] = ballsInside(outline, runner.positions(), firstBall);
    }
    std::printf("of 49 balls inside: %d without faces, %d with them\n", inside[0], inside[1]);
    EXPECT_GT(inside[0], 5);
    EXPECT_EQ(inside[1], 0);
}

// Balls stop anywhere on a flat side, also over its inner edges, without a sideways push or a rebound.
TEST(SolidFaces, StopWhatHitsAFlatSideAnywhere) {
    double fastest = 0, aside = 0, lowest = 1;
    Scene scene = heldCube(cubeLattice(1e7f));
    const std::size_t firstBall = scene.particles.size();
    for (int i = 0; i < 81; ++i)
        addBall(scene,
                {0.1f + 0.0125f * static_cast<float>(i % 9), static_cast<float>(side) + 0.08f,
                 0.1f + 0.0125f * static_cast<float>(i / 9)},
                {0, -3, 0}, 1e-6f);
    scene.gravity = {};
    test::Runner runner(scene, {.substeps = 20, .contactRoom = 128});
    ASSERT_EQ(runner.run(12).contactRoom, 0u);
    const auto x = runner.positions(), v = runner.velocities();
    for (std::size_t i = firstBall; i < x.size(); ++i) {
        fastest = std::max(fastest, v[i].norm());
        const Vec3& start = scene.particles[i].position;
        aside = std::max(aside, std::hypot(x[i].x() - double{start.x}, x[i].z() - double{start.z}));
        lowest = std::min(lowest, x[i].y() - side);
    }
    std::printf("at most %.4f m/s and %.1e m aside, at least %.4f of the reach above\n", fastest, aside,
                lowest / reach);
    EXPECT_LT(fastest, 0.02) << "[m/s] of 3";
    EXPECT_LT(aside, 1e-4) << "[m]";
    EXPECT_GT(lowest, 0.98 * reach);
}

// Case 27, inside a square and at the rim of a side.
TEST(SolidFaces, LetNothingFastThrough) {
    for (const float at : {0.112f, 0.15f, 0.297f})
        for (const float speed : {30.0f, 300.0f}) {
            Scene scene = heldCube(cubeLattice());
            scene.gravity = {};
            const std::uint32_t ball = addBall(scene, {at, static_cast<float>(side) + 0.021f * speed, 0.112f},
                                               {0, -speed, 0}, 1e-5f);
            test::Runner runner(scene, {.substeps = 4, .contactRoom = 96});
            ASSERT_EQ(runner.run(4).contactRoom, 0u) << "lists what is on its way, not all around";
            const auto x = runner.positions();
            EXPECT_LT(winding(scene, x, x[ball]), 0.5) << speed << " m/s at " << at;
            EXPECT_GT(x[ball].y(), side) << speed << " m/s at " << at;
            EXPECT_LT(runner.velocities()[ball].norm(), 0.1 * double{speed});
        }
}

// A ball that starts inside or was pushed through leaves from behind. Faces neither hold it nor throw it, and
// the edge between two triangles does not push it aside.
TEST(SolidFaces, LetOutWhatComesFromBehind) {
    for (int trial = 0; trial < 8; ++trial) {
        const float aside =
            trial < 5 ? 1e-6f * static_cast<float>(trial - 2) : 3e-3f * static_cast<float>(trial - 6);
        Scene scene = heldCube(cubeLattice());
        scene.gravity = {};
        const std::uint32_t ball =
            addBall(scene, {0.125f + aside, static_cast<float>(side) - 0.02f, 0.125f}, {0, 0.4f, 0}, 1e-5f);
        test::Runner runner(scene, {.substeps = 16});
        double fastest = 0, farthest = 0;
        for (int step = 0; step < 30; ++step) {
            ASSERT_EQ(runner.run(1).nonFinite, 0u);
            fastest = std::max(fastest, runner.velocities()[ball].norm());
            const Vector3d v = runner.velocities()[ball];
            farthest = std::max(farthest, std::hypot(v.x(), v.z()));
        }
        std::printf("%+.6f m: came out at %.3f m/s, fastest %.3f m/s, aside %.3f m/s\n",
                    static_cast<double>(aside), runner.velocities()[ball].y(), fastest, farthest);
        EXPECT_GT(runner.positions()[ball].y(), side + reach) << aside;
        EXPECT_LT(fastest, 0.4 + 0.5 + 0.1) << aside << ": its own speed and that of recovery [m/s]";
    }
}

// A sheared body has edges below 90 degrees. A ball beside such an edge is outside, although it is behind the
// plane of one of the edge's faces.
TEST(SolidFaces, HoldWhatFallsOntoTheirSharpEdges) {
    for (const float shear : {0.0f, 0.09f, 0.36f, -0.36f})
        for (const float offset : {-0.1f, 0.03f, 0.1f, 0.2f, 0.3f}) {
            Scene scene = cube({.name = "cube",
                                .cells = {3, 3, 3},
                                .spacing = spacing,
                                .youngModulus = 1e2f,
                                .radius = spacing / 2});
            scene.gravity = {};
            for (Particle& particle : scene.particles) {
                particle.position.x += shear * particle.position.y;
                particle.inverseMass = 1e-8f; // so heavy that it stays in place
            }
            const Vector3d edge(3 * double{spacing} * (1 + double{shear}), 3 * double{spacing}, 0);
            const auto at = [&](double x, double y) {
                return Vec3{static_cast<float>(edge.x() + x * reach),
                            static_cast<float>(edge.y() + y * reach),
                            1.5f * spacing}; // between two particles of the edge
            };
            const std::uint32_t ball = addBall(scene, at(double{offset}, 1.5), {0, -1, 0});
            test::Runner runner(scene, {.substeps = 32});
            double nearest = 1;
            for (int step = 0; step < 12; ++step) {
                ASSERT_EQ(runner.run(1).nonFinite, 0u);
                const Vector3d x = runner.positions()[ball];
                // Left of the edge, the side is nearest.
                if (x.x() > edge.x())
                    nearest = std::min(nearest, std::hypot(x.x() - edge.x(), x.y() - edge.y()));
            }
            EXPECT_GT(nearest, 0.98 * reach)
                << "shear " << shear << ", " << offset << " reach beside the edge";
        }
}

// A body's own particles lie behind its faces, and neighbours are nearer than the contact distance.
TEST(SolidFaces, OfABodyThatIsSquashedPushNoneOfItsOwn) {
    std::vector<Vector3d> x[2];
    for (const bool hasFaces : {false, true}) {
        Scene scene = cube(cubeLattice(2e4f), hasFaces);
        for (Particle& particle : scene.particles) particle.velocity.y = -0.7f;
        scene.planes = {{.normal = {0, 1, 0}, .offset = -0.02f, .friction = 0.5f}};
        addBall(scene, {3, 3, 3}); // otherwise the compiler would omit the faces
        test::Runner runner(scene, {.substeps = 24});
        runner.run(6);
        x[hasFaces ? 1 : 0] = runner.positions();
    }
    double most = 0, height = 0;
    for (std::size_t i = 0; i + 1 < x[0].size(); ++i) {
        most = std::max(most, (x[1][i] - x[0][i]).norm());
        height = std::max(height, x[0][i].y());
    }
    std::printf("squashed to %.2f of its height; particles at most %.1e m elsewhere for its faces\n",
                (height + 0.02) / side, most);
    EXPECT_LT(height + 0.02, 0.75 * side);
    EXPECT_EQ(most, 0);
}

// Two bodies of different voxel sizes that collide, each with particles and faces.
TEST(SolidFaces, KeepMomentumAndKeepBodiesApart) {
    Scene scene = cube(cubeLattice());
    Lattice fine = cubeLattice();
    fine.name = "fine";
    fine.origin = {0.06f, 0.39f, 0.07f};
    fine.spacing = 0.02f;
    fine.radius = 0.01f;
    const std::size_t first = scene.particles.size();
    addLattice(scene, fine);
    addSurfaceFaces(scene, scene.grids[1]);
    scene.gravity = {};
    scene.contacts.friction = 0.5f;
    for (std::size_t i = 0; i < scene.particles.size(); ++i)
        scene.particles[i].velocity = i < first ? Vec3{0, 1, 0} : Vec3{0.3f, -2, 0};
    test::Runner runner(scene, {.substeps = 32, .contactRoom = 64});
    const Vector3d before = momentum(scene, runner.velocities());
    double scale = 0, nearest = 1;
    for (const Particle& p : scene.particles) scale += 2 / double{p.inverseMass};
    for (int step = 0; step < 20; ++step) {
        ASSERT_EQ(runner.run(1).contactRoom, 0u);
        const auto x = runner.positions();
        for (std::size_t i = first; i < x.size(); ++i)
            for (std::size_t j = 0; j < first; ++j) nearest = std::min(nearest, (x[i] - x[j]).norm() / 0.035);
    }
    const auto v = runner.velocities();
    const double error = (momentum(scene, v) - before).norm() / scale;
    std::printf("momentum %.1e of all, nearest particles %.3f of touching\n", error, nearest);
    EXPECT_LT(error, 1e-6);
    EXPECT_GT(nearest, 0.9);
    EXPECT_LT(v[0].y(), 0.9) << "they have met";
}

// The tangential impulse on a sliding ball is friction times the normal one. With enough friction, the ball
// moves with the side.
TEST(SolidFaces, SlowAndHoldByTheirFriction) {
    for (const float friction : {0.3f, 2.0f}) {
        const bool slides = friction < 1;
        Scene scene = heldCube(cubeLattice(1e7f));
        scene.contacts.friction = friction;
        const std::uint32_t ball = addBall(scene, {0.07f, static_cast<float>(side + reach), 0.112f},
                                           {slides ? 0.5f : 0, 0, 0}, 1e-5f);
        if (!slides) scene.gravity = {4, -8.96f, 0}; // 24 degrees
        test::Runner runner(scene, {.substeps = 20});
        runner.run(6);
        const auto v = runner.velocities();
        Vector3d side4 = Vector3d::Zero(); // of the square below
        for (std::uint32_t i = 0; i < ball; ++i) {
            const Vec3& p = scene.particles[i].position;
            const bool isBelow = p.y > 0.29f && p.x > 0.04f && p.x < 0.11f && p.z > 0.09f && p.z < 0.16f;
            if (isBelow) side4 += v[i] / 4;
        }
        const double across = v[ball].y() + 9.81 * 0.1; // change of speed that stopped its fall
        std::printf("friction %.1f: %.4f m/s along of %.4f across; beside the side %.4f m/s\n",
                    double{friction}, 0.5 - v[ball].x(), across, v[ball].x() - side4.x());
        if (slides)
            EXPECT_NEAR(0.5 - v[ball].x(), 0.3 * across, 0.003);
        else
            EXPECT_NEAR(v[ball].x(), side4.x(), 0.01);
    }
}

TEST(SolidFaces, EndInTheSameBitsForAnyOrderAndMarginAndAfterASavedState) {
    Scene scene = heldCube(cubeLattice());
    scene.contacts.friction = 0.4f;
    addRain(scene);
    const Settings settings[] = {{.substeps = 12, .contactRoom = 64},
                                 {.substeps = 12, .contactRoom = 64, .isReversed = true},
                                 {.substeps = 12, .contactMargin = 0.8f, .contactRoom = 64},
                                 {.substeps = 12, .contactRoom = 64, .forms = {.usesTexels = false}}};
    std::vector<std::uint64_t> hashes;
    for (const Settings& each : settings) {
        test::Runner runner(scene, each);
        ASSERT_EQ(runner.run(24).contactRoom, 0u);
        hashes.push_back(runner.stateHash());
    }
    for (const std::uint64_t hash : hashes) EXPECT_EQ(hash, hashes[0]);
    test::Runner runner(scene, settings[0]);
    runner.run(12);
    const auto saved = runner.save();
    runner.run(5);
    runner.load(saved);
    runner.run(12);
    EXPECT_EQ(runner.stateHash(), hashes[0]);
}

// A cube with a ball on it sleeps until another ball lands on it.
TEST(SolidFaces, PutToSleepAndWakeWhatTouchesThem) {
    Scene scene = cube(cubeLattice());
    scene.damping = 4; // the falling ball reaches 2.45 m/s
    scene.contacts.friction = 0.6f;
    scene.planes = {{.normal = {0, 1, 0}, .offset = 0, .friction = 0.6f}};
    const std::uint32_t ball = addBall(scene, {0.112f, static_cast<float>(side + reach), 0.12f});
    const std::uint32_t late = addBall(scene, {0.213f, static_cast<float>(side) + 9, 0.19f});
    test::Runner runner(scene, {.substeps = 16, .sleeps = true});
    const auto others = static_cast<std::uint32_t>(scene.particles.size() - 1);
    EXPECT_EQ(runner.run(200).sleeping, others);
    const auto asleep = runner.positions();
    runner.run(4);
    EXPECT_EQ(runner.positions()[ball], asleep[ball]);
    EXPECT_GT(asleep[late].y(), side + 0.1) << "still on its way";
    std::uint32_t least = others;
    for (int step = 0; step < 60; ++step) least = std::min(least, runner.run(1).sleeping);
    EXPECT_EQ(least, 0u) << "the cube and what lies on it";
    EXPECT_NEAR(runner.positions()[late].y(), side + reach, 0.01);
}

// The halves of a cut cube part, and a ball falls between them where it lay on their faces.
TEST(SolidFaces, AreGoneWhereABladeHasPartedThem) {
    for (const bool isCut : {false, true}) {
        Lattice lattice = cubeLattice();
        lattice.isCuttable = true;
        Scene scene = cube(lattice);
        scene.gravity = {};
        for (Particle& particle : scene.particles)
            particle.velocity.x = particle.position.x < 0.15f + 0.5f * spacing - 1e-4f ? -1.0f : 1.0f;
        const double plane = 0.15 + 0.45 * double{spacing};
        const std::uint32_t ball =
            addBall(scene, {static_cast<float>(plane), static_cast<float>(side) + 0.25f, 0.112f}, {0, -2, 0});
        CutBody body(scene, {.substeps = 16, .contactRoom = 64});
        if (isCut) {
            const auto sweep = sweepOf({Vector3d(plane, 0.15, 0.15), Vector3d::UnitX()}, 1);
            ASSERT_EQ(body.cut(sweep).pieces, 2u);
        }
        body.runner().run(9);
        const double height = body.runner().positions()[ball].y();
        std::printf("%s: the ball at %.3f, the upper side at %.3f\n", isCut ? "cut" : "whole", height, side);
        EXPECT_EQ(height < side - 0.02, isCut);
    }
}

// The faces of a removed corner disappear with it and return with an undo, including faces with all links
// alive.
TEST(SolidFaces, OfDebrisLeaveWithIt) {
    for (const bool isUndone : {false, true}) {
        Lattice lattice = cubeLattice();
        lattice.isCuttable = true;
        Scene scene = cube(lattice);
        scene.gravity = {};
        scene.debris = 11; // the corner has ten particles
        const Vec3 start{-0.1f, -0.1f, -0.1f};
        const std::uint32_t ball = addBall(scene, start, {1, 1, 1}, 1e-6f);
        CutBody body(scene, {.substeps = 16, .contactRoom = 64});
        const vk::Buffer whole = body.runner().saveTopology();
        const Vector3d diagonal = Vector3d::Ones().normalized();
        body.cut(sweepOf({Vector3d::Constant(0.783 * double{spacing}), diagonal}, 1));
        if (isUndone) body.runner().loadTopology(whole);
        double farthest = -1;
        for (int step = 0; step < 12; ++step) {
            body.runner().run(1);
            farthest = std::max(farthest, body.runner().positions()[ball].dot(diagonal));
        }
        const double tip = -reach, // in front of the corner at (0, 0, 0)
            cutOff = 0.783 * double{spacing} * std::sqrt(3.0);
        std::printf("%s: the ball came to %.4f along the diagonal\n", isUndone ? "undone" : "removed",
                    farthest);
        if (isUndone)
            EXPECT_LT(farthest, tip + 1e-3);
        else
            EXPECT_GT(farthest, cutOff - reach - 0.01);
    }
}
