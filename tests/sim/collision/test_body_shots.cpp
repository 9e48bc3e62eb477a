// Tests of shots at bodies that give way: cloth in a frame, cloth hung by a row, voxel bodies with faces,
// still and moving. Balls have 0.5 to 100 times the spacing as radius, 1 to 1,000 m/s, 4 to 64 substeps in
// 1/60 s. Each substep is a step of its own, so that a judge sees the whole path of each ball: none may lead
// through a face.
#include "sim/collision/passage.hpp"
#include "sim/runner.hpp"
#include "sim/scenes.hpp"
#include "sinew/bodies.hpp"
#include "support/full.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <string>
#include <utility>

using namespace sinew;
using namespace sinew::sim;
using Eigen::Vector3d;

namespace {

constexpr int shotsOfScene = 10;
constexpr double frames = 2.5, dt = 1.0 / 60; // [s]
constexpr double apart = 60;                  // distance between shots of a scene [m]
constexpr float spacing = 0.05f;              // [m]

enum class Target : std::uint8_t { framed, hung, faced };

struct Kind {
    const char* name;
    Target target;
    bool isMoving;
};

struct Shot {
    Vector3d middle, velocity, targetVelocity = Vector3d::Zero();
    double ratio = 1; // of the radius to the spacing
    std::uint32_t ball = 0;
    std::vector<Face> faces; // judged
    bool hasPassed = false;
};

class BodyShots : public testing::TestWithParam<Kind> {
protected:
    double unit() { return std::uniform_real_distribution<double>(0, 1)(random_); }

    Shot shotAt(int place) {
        Shot shot;
        shot.middle = {0, apart * (place % 5 - 2), apart * (place / 5 - 2)};
        const double speed = std::pow(10, 3 * unit()), angle = 0.5 * unit(), turn = 2 * M_PI * unit();
        if (GetParam().isMoving)
            shot.targetVelocity = speed * Vector3d(-unit(), unit() - 0.5, unit() - 0.5) / 2;
        shot.velocity =
            shot.targetVelocity + speed * Vector3d(std::cos(angle), std::sin(angle) * std::cos(turn),
                                                   std::sin(angle) * std::sin(turn));
        shot.ratio = 0.5 * std::pow(200, unit());
        return shot;
    }

    // Moves the body of a shot, and holds these particles.
    void start(Scene& scene, const Shot& shot, std::uint32_t first, const std::vector<std::uint32_t>& held) {
        for (std::size_t i = first; i < scene.particles.size(); ++i)
            scene.particles[i].velocity = test::toFloats(shot.targetVelocity);
        for (const std::uint32_t i : held) {
            scene.particles[i].inverseMass = 0;
            scene.particles[i].velocity = {};
        }
        if (!GetParam().isMoving || held.empty()) return;
        DrivenBody driven{.firstParticle = held.front(), .particleCount = 1};
        driven.particles.assign(held.begin() + 1, held.end());
        driven.path = {{0, {}}, {1, {.position = test::toFloats(shot.targetVelocity)}}};
        scene.driven.push_back(driven);
    }

    void addCloth(Scene& scene, Shot& shot, bool isFramed) {
        const auto n = static_cast<std::uint32_t>(std::clamp(shot.ratio + 6, 7.0, 12.0));
        const std::size_t firstFace = scene.faces.size();
        ClothSheet sheet{.name = "cloth" + std::to_string(scene.bodies.size()),
                         .right = {0, 1, 0},
                         .down = {0, 0, 1},
                         .size = {n, n},
                         .spacing = spacing,
                         .membraneStiffness = 1000,
                         .thickness = 0.3f * spacing};
        const double half = (n - 1) * double{spacing} / 2;
        sheet.origin = test::toFloats(shot.middle - Vector3d(0, half, half));
        const std::uint32_t first = sim::addCloth(scene, sheet);
        std::vector<std::uint32_t> held;
        for (std::uint32_t i = 0; i < n * n; ++i) {
            const std::uint32_t u = i % n, v = i / n;
            if (v == 0 || (isFramed && (u == 0 || u == n - 1 || v == n - 1))) held.push_back(first + i);
        }
        start(scene, shot, first, held);
        shot.faces.assign(scene.faces.begin() + static_cast<std::ptrdiff_t>(firstFace), scene.faces.end());
        aim(scene, shot, half);
    }

    void addVoxels(Scene& scene, Shot& shot) {
        const auto n = static_cast<std::uint32_t>(std::clamp(shot.ratio + 4, 5.0, 8.0));
        const double half = n * double{spacing} / 2;
        const auto first = static_cast<std::uint32_t>(scene.particles.size());
        const std::size_t firstFace = scene.faces.size();
        const LatticeCorners corners =
            addLattice(scene, {.name = "body" + std::to_string(scene.bodies.size()),
                               .origin = test::toFloats(shot.middle - Vector3d(0, half, half)),
                               .cells = {3, n, n},
                               .spacing = spacing,
                               .radius = 0.45f * spacing});
        addSurfaceFaces(scene, scene.grids.back());
        shot.faces.assign(scene.faces.begin() + static_cast<std::ptrdiff_t>(firstFace), scene.faces.end());
        std::vector<std::uint32_t> held;
        if (unit() < 0.5)
            for (std::uint32_t k = 0; k <= n; ++k)
                for (std::uint32_t j = 0; j <= n; ++j)
                    if (j == 0 || k == 0 || j == n || k == n) held.push_back(corners.at(3, j, k));
        std::ranges::sort(held);
        start(scene, shot, first, held);
        aim(scene, shot, half);
    }

    void aim(Scene& scene, Shot& shot, double half) {
        const Vector3d relative = shot.velocity - shot.targetVelocity, way = relative.normalized();
        const double radius = shot.ratio * spacing;
        const double gap = GetParam().target == Target::faced ? 0.5 : 0.2; // slow balls must arrive
        const Vector3d at = shot.middle + half * Vector3d(0, unit() - 0.5, unit() - 0.5);
        const double nearest = (1.0005 * radius + gap * double{spacing}) / way.x();
        shot.ball = static_cast<std::uint32_t>(scene.particles.size());
        scene.particles.push_back(
            {.position = test::toFloats(at - (nearest + 1.5 * unit() * relative.norm() * dt) * way),
             .velocity = test::toFloats(shot.velocity),
             .inverseMass = static_cast<float>(std::pow(10, 2 * unit() - 1)),
             .contactOffset = static_cast<float>(radius),
             .radius = static_cast<float>(radius)});
    }

    std::vector<Shot> addShots(Scene& scene, int count) {
        std::vector<Shot> shots;
        for (int s = 0; s < count; ++s) shots.push_back(shotAt(s));
        for (Shot& shot : shots) {
            const Target target = GetParam().target;
            if (target == Target::framed || target == Target::hung)
                addCloth(scene, shot, target == Target::framed);
            else
                addVoxels(scene, shot);
        }
        return shots;
    }

    std::mt19937 random_{31};
};

test::Corners cornersOf(const Face& face, const std::vector<Vector3d>& x) {
    return {x[face.particles[0]], x[face.particles[1]], x[face.particles[2]]};
}

// Solid faces hold only what is in front of them.
bool isInFront(const Face& face, const Vector3d& x, const test::Corners& corners) {
    return !face.isSolid || (corners[1] - corners[0]).cross(corners[2] - corners[0]).dot(x - corners[0]) > 0;
}

bool passes(const Shot& shot, const std::vector<Vector3d>& before, const std::vector<Vector3d>& after) {
    const Vector3d &from = before[shot.ball], &to = after[shot.ball];
    return std::ranges::any_of(shot.faces, [&](const Face& face) {
        const test::Corners first = cornersOf(face, before);
        return isInFront(face, from, first) && test::passesThrough(from, to, first, cornersOf(face, after));
    });
}

// Whether the ball or some corner of the body has another velocity than at the start.
bool hasHit(const Shot& shot, const std::vector<Vector3d>& v) {
    const double least = 0.01 * (shot.velocity - shot.targetVelocity).norm();
    if ((v[shot.ball] - shot.velocity).norm() > least) return true;
    return std::ranges::any_of(shot.faces, [&](const Face& face) {
        const Vector3d& corner = v[face.particles[0]];
        return (corner - shot.targetVelocity).norm() > least && corner.norm() > least;
    });
}

struct Triangle {
    float size, y, speed = 0; // of its corners; speed along y [m/s]
    float mass = 0;           // of a corner [kg]; 0 = it is held
};

// A face at the height y around the y axis.
void addTriangle(Scene& scene, const Triangle& triangle) {
    const auto first = static_cast<std::uint32_t>(scene.particles.size());
    for (const auto& [x, z] : {std::pair{-1.0f, -0.6f}, {1.0f, -0.6f}, {0.0f, 1.2f}})
        scene.particles.push_back({.position = {x * triangle.size, triangle.y, z * triangle.size},
                                   .velocity = {0, triangle.mass > 0 ? triangle.speed : 0, 0},
                                   .inverseMass = triangle.mass > 0 ? 1 / triangle.mass : 0});
    scene.faces.push_back({{first, first + 1, first + 2}, 0.01f});
}

// The scenes of each kind that run: 500 shots in the longer form, of which SINEW_TRIALS=FIRST:END runs a
// part.
struct Trials {
    int first = 0, end = 2;
};

Trials trialsToRun() {
    Trials trials;
    if (!test::isFull()) return trials;
    trials.end = 500 / shotsOfScene;
    const char* part = std::getenv("SINEW_TRIALS");
    if (part != nullptr && std::sscanf(part, "%d:%d", &trials.first, &trials.end) != 2)
        ADD_FAILURE() << "SINEW_TRIALS=" << part << " is not FIRST:END";
    return trials;
}

std::string nameOf(const testing::TestParamInfo<Kind>& info) {
    return std::string(info.param.name) + (info.param.isMoving ? "Moving" : "Still");
}

} // namespace

TEST_P(BodyShots, NonePasses) {
    const Trials trials = trialsToRun();
    const std::vector<int> substeps = {4, 16, 8, 24, 64};
    int shots = 0, passed = 0, hit = 0;
    for (int trial = 0; trial < trials.end; ++trial) {
        Scene scene;
        scene.gravity = {};
        std::vector<Shot> all = addShots(scene, shotsOfScene);
        if (trial < trials.first) continue; // it has drawn its random numbers
        const int each = substeps[trial % substeps.size()];
        test::Runner runner(scene, {.substeps = 1, .contactRoom = 512});
        std::vector<Vector3d> before = runner.positions();
        for (int step = 0; step < frames * each; ++step) {
            const Status status = runner.step(static_cast<float>(dt / each));
            ASSERT_FALSE(status.isUndone) << "trial " << trial << ", step " << step << ", room "
                                          << status.contactRoom << " " << status.nonFinite;
            std::vector<Vector3d> after = runner.positions();
            for (Shot& shot : all) {
                if (shot.hasPassed || !passes(shot, before, after)) continue;
                shot.hasPassed = true;
                ++passed;
                std::printf(
                    "trial %d, shot %d, step %d: %d substeps, %.1f m/s, ratio %.2f, inverse mass %.2f\n",
                    trial, static_cast<int>(&shot - all.data()), step, each,
                    (shot.velocity - shot.targetVelocity).norm(), shot.ratio,
                    double{scene.particles[shot.ball].inverseMass});
            }
            before = std::move(after);
        }
        const auto v = runner.velocities();
        for (const Shot& shot : all) hit += hasHit(shot, v) ? 1 : 0;
        shots += shotsOfScene;
        if (!test::isFull()) continue;
        std::printf("trial %d done: %d substeps\n", trial, each);
        std::fflush(stdout);
    }
    std::printf("%d shots, %d hit, %d passed\n", shots, hit, passed);
    EXPECT_EQ(passed, 0);
    EXPECT_GE(hit, shots * 3 / 4) << "shots that hit nothing show nothing";
}

TEST_P(BodyShots, HaveTheSameBitsInReversedOrder) {
    Scene scene;
    scene.gravity = {};
    addShots(scene, 3);
    const auto hash = [&](bool isReversed) {
        test::Runner runner(scene, {.substeps = 4, .contactRoom = 256, .isReversed = isReversed});
        EXPECT_FALSE(runner.run(2).isUndone);
        return runner.stateHash();
    };
    const std::uint64_t forward = hash(false);
    EXPECT_EQ(forward, hash(true));
    std::printf("state_hash %016llx\n", static_cast<unsigned long long>(forward));
}

TEST(BodyShot, KeepsMomentumAndItsImpulse) {
    Scene scene;
    scene.gravity = {};
    addCloth(scene, {.right = {0, 1, 0},
                     .down = {0, 0, 1},
                     .size = {9, 9},
                     .spacing = spacing,
                     .membraneStiffness = 1000,
                     .thickness = 0.3f * spacing});
    // Between two particles of a row, so that contacts alone let it through.
    scene.particles.push_back(
        {.position = {-0.5f, 0.21f, 0.23f}, .velocity = {400, 0, 0}, .inverseMass = 100, .radius = 0.04f});
    const auto momentum = [&](const std::vector<Vector3d>& v) {
        Vector3d sum = Vector3d::Zero();
        for (std::size_t i = 0; i < v.size(); ++i) sum += v[i] / double{scene.particles[i].inverseMass};
        return sum;
    };
    test::Runner runner(scene, {.substeps = 8, .contactRoom = 512, .keepsForces = true});
    const Vector3d before = momentum(runner.velocities());
    const Status status = runner.run(1);
    ASSERT_FALSE(status.isUndone);
    const auto v = runner.velocities();
    EXPECT_LT(v.back().x(), 390) << "has hit";
    EXPECT_LT((momentum(v) - before).norm(), 1e-5 * before.norm());
    const Vector3d lost = (Vector3d(400, 0, 0) - v.back()) / double{scene.particles.back().inverseMass};
    const Impulses impulses = runner.simulation().forces(status.frame);
    EXPECT_LT((test::toVector(impulses.bodies[0].contacts.linear) - lost).norm(), 1e-3 * lost.norm());
}

// A ball goes past a face that is smaller than it, beside the face, and ends within reach behind it. Contacts
// and stops act on the side that the ball came from: they do not push it on.
TEST(BodyShot, IsStoppedByAFaceThatItGoesPastInASubstep) {
    for (const float mass : {0.0f, 1000.0f}) // of a corner; 0 = the face is static, or driven
        for (const bool isFaceMoving : {false, true})
            for (const float aside : {0.1f, 0.3f, 0.6f}) {
                Scene scene;
                scene.gravity = {};
                const float speed = 1.6f / scene.dt, faceSpeed = isFaceMoving ? speed : 0;
                addTriangle(scene, {.size = 0.05f, .y = 0, .speed = faceSpeed, .mass = mass});
                if (isFaceMoving && mass == 0)
                    scene.driven.push_back({.firstParticle = 0,
                                            .particleCount = 3,
                                            .path = {{0, {}}, {1, {.position = {0, speed, 0}}}}});
                scene.particles.push_back(
                    {.position = {aside, 1.2f, 0}, .velocity = {0, faceSpeed - speed, 0}, .radius = 1});
                test::Runner runner(scene, {.substeps = 1});
                for (int step = 0; step < 4; ++step) {
                    ASSERT_FALSE(runner.run(1).isUndone);
                    const auto x = runner.positions(), v = runner.velocities();
                    const Vector3d relative = v[3] - Vector3d(0, double{faceSpeed}, 0);
                    // later it may slide past, out of reach
                    const double height = x[3].y() - x[0].y();
                    EXPECT_TRUE(step > 0 || height >= 0) << mass << " kg, " << isFaceMoving << ", " << aside;
                    EXPECT_LE(relative.norm(), 1.01 * double{speed})
                        << mass << " kg, " << isFaceMoving << ", " << aside << ", step " << step;
                }
            }
}

// A ball falls onto a static face, and a loose face follows it closely. Light faces on the static one take
// most of the ball's share, so that a stop puts the ball back. The face behind it then moves with the ball.
TEST(BodyShot, IsNotPutBackThroughAFaceBehindIt) {
    Scene scene;
    scene.gravity = {};
    constexpr float height = 0.25f;
    const float speed = 0.1f / scene.dt;
    addTriangle(scene, {.size = 1, .y = 0});
    addTriangle(scene, {.size = 1, .y = height + 7e-4f, .speed = -speed, .mass = 0.01f});
    for (int k = 0; k < 9; ++k) addTriangle(scene, {.size = 1, .y = 0.03f, .mass = 0.01f});
    scene.particles.push_back(
        {.position = {0.05f, height, 0.1f}, .velocity = {0, -speed, 0}, .radius = 0.1f});
    test::Runner runner(scene, {.substeps = 1});
    for (int step = 0; step < 4; ++step) {
        ASSERT_FALSE(runner.run(1).isUndone);
        const auto x = runner.positions();
        const Vector3d normal = (x[5] - x[3]).cross(x[4] - x[3]); // of the loose face, upwards
        EXPECT_LT((x.back() - x[3]).dot(normal), 0) << "step " << step;
        EXPECT_GT(x.back().y(), 0) << "step " << step;
    }
}

INSTANTIATE_TEST_SUITE_P(Kinds, BodyShots,
                         testing::Values(Kind{"Framed", Target::framed, false},
                                         Kind{"Framed", Target::framed, true},
                                         Kind{"Hung", Target::hung, false}, Kind{"Hung", Target::hung, true},
                                         Kind{"Faced", Target::faced, false},
                                         Kind{"Faced", Target::faced, true}),
                         nameOf);
