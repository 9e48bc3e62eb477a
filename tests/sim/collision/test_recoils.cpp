// Tests of recoils: contacts without restitution between loose balls leave no speed of separation.
#include "sim/program/program_values.hpp"
#include "sim/runner.hpp"
#include "sim/scenes.hpp"
#include "sinew/bodies.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <vector>

using namespace sinew;
using namespace sinew::sim;
using Eigen::Vector3d;

namespace {

constexpr float radius = 0.02f;

Particle ball(const Vec3& position, const Vec3& velocity = {}) {
    return {.position = position, .velocity = velocity, .contactOffset = radius, .radius = radius};
}

// Balls of 1 kg one upon another, the lowest with its bottom at `height` [m].
Scene column(std::uint32_t count, float height) {
    Scene scene{.name = "column"};
    scene.contacts.takesRecoils = true;
    for (std::uint32_t i = 0; i < count; ++i)
        scene.particles.push_back(ball({0, height + radius * static_cast<float>(2 * i + 1), 0}));
    return scene;
}

// Mean height of the first `count` particles [m].
double meanHeight(const test::Runner& runner, std::size_t count) {
    const std::vector<Vector3d> x = runner.positions();
    double sum = 0;
    for (std::size_t i = 0; i < count; ++i) sum += x[i].y();
    return sum / static_cast<double>(count);
}

// How far the centre of a column of `count` balls, the first of a scene, rises beyond its place at rest on
// something at height 0, after it has fallen by `fall` [m].
double riseAfter(const Scene& scene, std::uint32_t substeps, double fall, std::uint32_t count) {
    test::Runner runner(scene, {.solver = Solver::split, .substeps = substeps});
    const int impact = static_cast<int>(std::ceil(std::sqrt(2 * fall / 9.81) / double{scene.dt})) + 2;
    runner.run(impact);
    const double rest = double{radius} * count;
    double rise = 0;
    for (int step = 0; step < 40; ++step) {
        runner.run(1);
        rise = std::max(rise, meanHeight(runner, count) - rest);
    }
    return rise;
}

// A square of two triangles on which balls rest as on a plane at height 0.
MeshCollider mesh(const char* name = "floor") {
    constexpr float thickness = 0.01f;
    return {.name = name,
            .vertices = {{-1, -thickness, -1}, {1, -thickness, -1}, {-1, -thickness, 1}, {1, -thickness, 1}},
            .triangles = {{0, 2, 1}, {1, 2, 3}},
            .thickness = thickness};
}

Vector3d momentum(const test::Runner& runner) {
    const std::vector<Vector3d> v = runner.velocities();
    return std::accumulate(v.begin(), v.end(), Vector3d(0, 0, 0));
}

} // namespace

// Without recoils 2, 4 and 12 balls rise by 0.12, 0.31 and 0.60 of their fall.
TEST(Recoils, OfAColumnOnAPlaneDoNotLiftIt) {
    struct Case {
        std::uint32_t count, substeps;
        float fall;
    };
    for (const auto& [count, substeps, fall] : {Case{2, 16, 0.5f}, Case{2, 64, 0.1f}, Case{4, 16, 2},
                                                Case{12, 16, 0.5f}, Case{12, 64, 0.5f}, Case{12, 16, 2}}) {
        Scene scene = column(count, fall);
        scene.planes = {{.normal = {0, 1, 0}}};
        EXPECT_LE(riseAfter(scene, substeps, double{fall}, count), 0.02 * double{fall} + 0.2 * double{radius})
            << count << " balls, fall " << fall << ", substeps " << substeps;
    }
}

TEST(Recoils, OfAColumnOnAColliderDoNotLiftIt) {
    Collider box{.shape = ColliderShape::box, .halfExtents = {0.5f, 0.1f, 0.5f}};
    box.pose.position = {0, -0.1f, 0};
    for (const std::uint32_t count : {2u, 4u, 12u}) {
        Scene scene = column(count, 0.5f);
        scene.colliders = {box};
        EXPECT_LE(riseAfter(scene, 16, 0.5, count), 0.02 * 0.5 + 0.2 * double{radius}) << count;
    }
}

// Without recoils 2, 4 and 12 balls rise by 0.11, 0.62 and 1.02 of their fall.
TEST(Recoils, OfAColumnOnAMeshDoNotLiftIt) {
    for (const std::uint32_t substeps : {16u, 64u})
        for (const std::uint32_t count : {2u, 4u, 12u}) {
            Scene scene = column(count, 0.5f);
            addMeshCollider(scene, mesh());
            const double rise = riseAfter(scene, substeps, 0.5, count);
            std::printf("%u balls, %u substeps: %.4f of the fall\n", count, substeps, rise / 0.5);
            EXPECT_LE(rise, 0.02 * 0.5 + 0.2 * double{radius}) << count << ", substeps " << substeps;
        }
}

// The column leaves with the speed of the lift.
TEST(Recoils, LetAMovingMeshThrowAColumn) {
    MeshCollider lift = mesh("lift");
    lift.path = {{0, {}}, {0.25f, {.position = {0, 0.5f, 0}}}};
    Scene scene = column(4, 0);
    addMeshCollider(scene, lift);
    test::Runner runner(scene, {.solver = Solver::split, .substeps = 16});
    runner.run(15);
    for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(runner.velocities()[i].y(), 2, 0.05);
    runner.run(10); // thrown up at 2 m/s for a sixth of a second
    const double time = 10.0 / 60, flown = 2 * time - 9.81 / 2 * time * time;
    EXPECT_NEAR(meanHeight(runner, 4), 0.5 + 4 * double{radius} + flown, 0.005);
}

// Without recoils the farthest ball leaves at twice the speed of the mesh and more.
TEST(Recoils, OfARowThatAMeshPushesLeaveItsSpeed) {
    for (const float speed : {2.0f, 10.0f}) {
        Scene scene{.name = "row"};
        scene.contacts.takesRecoils = true;
        scene.gravity = {};
        for (int i = 0; i < 6; ++i)
            scene.particles.push_back(ball({0, radius * static_cast<float>(2 * i + 1) + 0.05f, 0}));
        MeshCollider pusher = mesh("pusher");
        pusher.path = {{0, {}}, {0.5f, {.position = {0, 0.5f * speed, 0}}}};
        addMeshCollider(scene, pusher);
        test::Runner runner(scene, {.solver = Solver::split, .substeps = 16});
        runner.run(8);
        double fastest = 0;
        for (std::size_t i = 0; i < 6; ++i) fastest = std::max(fastest, runner.velocities()[i].y());
        std::printf("mesh of %.0f m/s: %.3f of its speed\n", double{speed}, fastest / double{speed});
        EXPECT_LE(fastest, 1.05 * double{speed});
    }
}

TEST(Recoils, OfAColumnOnAFixedBallDoNotLiftIt) {
    Scene scene = column(6, 0.5f);
    scene.particles.push_back({.position = {0, -radius, 0}, .inverseMass = 0, .radius = radius});
    test::Runner runner(scene, {.solver = Solver::split, .substeps = 16});
    runner.run(22);
    double highest = 0;
    for (int step = 0; step < 10; ++step) {
        runner.run(1);
        highest = std::max(highest, runner.positions()[5].y());
    }
    EXPECT_LE(highest, 11 * double{radius} + 0.02 * 0.5);
}

// A lift carries a column along, and stops below it: only what the column keeps of its speed lifts it.
TEST(Recoils, LetAMovingFloorThrowAColumn) {
    Collider box{.shape = ColliderShape::box, .halfExtents = {0.5f, 0.1f, 0.5f}};
    box.path = {{0, {.position = {0, -0.1f, 0}}}, {0.25f, {.position = {0, 0.4f, 0}}}};
    Scene scene = column(4, 0);
    scene.colliders = {box};
    test::Runner runner(scene, {.solver = Solver::split, .substeps = 16});
    runner.run(15);
    for (const Vector3d& v : runner.velocities()) EXPECT_NEAR(v.y(), 2, 0.05);
    runner.run(10); // thrown up at 2 m/s for a sixth of a second
    const double time = 10.0 / 60, flown = 2 * time - 9.81 / 2 * time * time;
    EXPECT_NEAR(meanHeight(runner, 4), 0.5 + 4 * double{radius} + flown, 0.005);
}

// The impulse of a floor is the momentum of the column and its weight, with what recoils take back.
TEST(Recoils, ArePartOfForces) {
    const double impact = 5 * std::sqrt(2 * 9.81 * 0.1),
                 kick = 5 * 9.81 / 60 / 16 / 2; // stored half a substep early
    for (const bool isCollider : {false, true}) {
        Scene scene = column(5, 0.1f);
        Collider box{.shape = ColliderShape::box, .halfExtents = {0.5f, 0.1f, 0.5f}};
        box.pose.position = {0, -0.1f, 0};
        if (isCollider)
            scene.colliders = {box};
        else
            scene.planes = {{.normal = {0, 1, 0}}};
        test::Runner runner(scene, {.solver = Solver::split, .substeps = 16, .keepsForces = true});
        double given = 0;
        for (int step = 1; step <= 20; ++step) {
            const Impulses impulses = runner.simulation().forces(runner.run(1).frame);
            given += std::abs(double{(isCollider ? impulses.colliders : impulses.planes)[0].linear.y});
            EXPECT_NEAR(momentum(runner).y(), given - 5 * 9.81 * step / 60 + kick, 1e-3 * impact) << step;
        }
        EXPECT_GT(given, impact);
    }
}

// A fixed ball or a mesh below a column gets what the column loses.
TEST(Recoils, ArePartOfForcesOnWhatStands) {
    for (const bool isMesh : {false, true}) {
        Scene scene = column(5, 0.1f);
        scene.bodies = {{"column", 0, 5}};
        if (isMesh) {
            addMeshCollider(scene, mesh());
        } else {
            scene.particles.push_back({.position = {0, -radius, 0}, .inverseMass = 0, .radius = radius});
            scene.bodies.push_back({"fixed", 5, 1});
        }
        test::Runner runner(scene, {.solver = Solver::split, .substeps = 16, .keepsForces = true});
        double most = 0, given = 0;
        for (int step = 1; step <= 20; ++step) {
            const Impulses impulses = runner.simulation().forces(runner.run(1).frame);
            const double on = double{impulses.bodies[1].contacts.linear.y},
                         from = double{impulses.bodies[0].contacts.linear.y};
            EXPECT_NEAR(on + from, 0, 2e-5 * (1 + std::abs(from))) << step;
            most = std::max(most, from);
            given += from;
        }
        EXPECT_GT(most, 4);
        const double kick = 5 * 9.81 / 60 / 16 / 2; // stored half a substep early
        double now = 0;
        for (std::size_t i = 0; i < 5; ++i) now += runner.velocities()[i].y();
        EXPECT_NEAR(now, given - 5 * 9.81 * 20 / 60 + kick, 1e-3) << "mesh " << isMesh;
    }
}

// Twelve balls in a row that a thirteenth hits move on together. Without recoils the last one leaves at 0.85
// m/s.
TEST(Recoils, OfARowLeaveOneSpeed) {
    for (const std::uint32_t substeps : {8u, 16u, 64u}) {
        Scene scene{.name = "row"};
        scene.contacts.takesRecoils = true;
        scene.gravity = {};
        scene.particles.push_back(ball({-0.3f, 0, 0}, {3, 0, 0}));
        for (int i = 0; i < 12; ++i)
            scene.particles.push_back(ball({2 * radius * static_cast<float>(i), 0, 0}));
        test::Runner runner(scene, {.solver = Solver::split, .substeps = substeps});
        runner.run(40);
        EXPECT_NEAR((momentum(runner) - Vector3d(3, 0, 0)).norm(), 0, 2e-6);
        for (const Vector3d& v : runner.velocities()) EXPECT_NEAR(v.x(), 3.0 / 13, 0.07) << substeps;
    }
}

// A ball that falls between two others on a floor parts them. The exact speeds of bodies that meet without
// restitution: the impulse J of each contact follows from 2 r (sin 60, cos 60) and both approaches being 0.
TEST(Recoils, LetABallPartTwoOthers) {
    for (const std::uint32_t substeps : {16u, 64u}) {
        Scene scene{.name = "wedge"};
        scene.contacts.takesRecoils = true;
        scene.particles = {ball({-radius, radius, 0}), ball({radius, radius, 0}), ball({0, 0.3f, 0})};
        scene.planes = {{.normal = {0, 1, 0}}};
        test::Runner runner(scene, {.solver = Solver::split, .substeps = substeps});
        runner.run(17);
        const std::vector<Vector3d> v = runner.velocities();
        const double fallen = 0.3 - double{radius} * (1 + std::sqrt(3)), speed = std::sqrt(2 * 9.81 * fallen);
        const double expected = speed * std::sqrt(3) / 7; // J cos 60, J = 2 sqrt(3) / 7 of the speed
        EXPECT_GT(v[1].x(), 0.9 * expected) << substeps;
        EXPECT_LT(v[1].x(), 1.5 * expected) << "it slides on between them";
        EXPECT_NEAR(v[0].x() + v[1].x(), 0, 1e-4);
    }
}

// Fast balls in a row that is pressed on: contacts on their way count for both of a pair.
TEST(Recoils, OfFastBallsKeepMomentum) {
    for (const std::uint32_t substeps : {2u, 4u}) {
        Scene scene{.name = "fast"};
        scene.contacts.takesRecoils = true;
        scene.gravity = {};
        for (int i = 0; i < 8; ++i)
            scene.particles.push_back(
                ball({0.0401f * static_cast<float>(i), 0.002f * static_cast<float>(i % 3), 0}));
        for (int i = 0; i < 6; ++i)
            scene.particles.push_back(
                ball({-0.1f - 0.09f * static_cast<float>(i), 0.004f * static_cast<float>(i % 2), 0.003f},
                     {8.0f - static_cast<float>(i), 0, 0}));
        test::Runner runner(scene, {.solver = Solver::split, .substeps = substeps});
        for (int step = 0; step < 25; ++step) {
            runner.run(1);
            EXPECT_NEAR((momentum(runner) - Vector3d(33, 0, 0)).norm(), 0, 5e-5) << substeps << " " << step;
        }
    }
}

// Balls at rest keep their bits, whatever recoils elsewhere.
TEST(Recoils, ChangeNothingThatTheyDoNotReach) {
    Scene alone = column(3, 0);
    alone.planes = {{.normal = {0, 1, 0}}};
    Scene both = alone;
    for (Particle particle : column(5, 0.3f).particles) {
        particle.position.x = 1;
        both.particles.push_back(particle);
    }
    const Settings settings{.solver = Solver::split, .substeps = 16};
    test::Runner one(alone, settings), two(both, settings);
    one.run(30);
    two.run(30);
    const std::vector<Vector3d> a = one.positions(), b = two.positions();
    for (std::size_t i = 0; i < a.size(); ++i) EXPECT_EQ(a[i], b[i]) << i;
}

// A heap in which some lists have more than 32 candidates with the widest margin.
TEST(Recoils, DependOnNoMargin) {
    Scene scene{.name = "heap"};
    scene.contacts.takesRecoils = true;
    scene.planes = {{.normal = {0, 1, 0}}};
    for (const float x : {-1.0f, 1.0f}) {
        scene.planes.push_back({.normal = {x, 0, 0}, .offset = -0.08f});
        scene.planes.push_back({.normal = {0, 0, x}, .offset = -0.08f});
    }
    for (int i = 0; i < 128; ++i)
        scene.particles.push_back(ball(
            {0.043f * static_cast<float>(i % 4) - 0.062f + 0.0003f * static_cast<float>(i % 7),
             0.1f + 0.041f * static_cast<float>(i / 16), 0.042f * static_cast<float>(i / 4 % 4) - 0.06f}));
    Settings settings{.solver = Solver::split, .substeps = 16, .contactMargin = 0.25f, .contactRoom = 200};
    const std::uint64_t hash = test::hashOfRun(scene, settings, 40);
    for (const float margin : {0.5f, 1.0f, 2.5f}) {
        settings.contactMargin = margin;
        EXPECT_EQ(test::hashOfRun(scene, settings, 40), hash) << "margin " << margin;
    }
    scene.contacts.takesRecoils = false;
    EXPECT_NE(test::hashOfRun(scene, settings, 40), hash) << "nothing recoils";
}

TEST(Recoils, ArePartOfNoSavedState) {
    Scene scene = column(6, 0.2f);
    scene.planes = {{.normal = {0, 1, 0}}};
    test::Runner runner(scene, {.solver = Solver::split, .substeps = 16});
    runner.run(12); // in the impact
    const test::Runner::Saved saved = runner.save();
    runner.run(10);
    const std::uint64_t hash = runner.stateHash();
    runner.load(saved);
    runner.run(10);
    EXPECT_EQ(runner.stateHash(), hash);
    const StepProgram& program = runner.simulation().program();
    for (const BufferId buffer : writtenByStep(program))
        EXPECT_FALSE(program.buffers[buffer.index].label.starts_with("recoils."));
}

TEST(Recoils, AreThereForLooseBallsOfScenesThatAsk) {
    const Settings settings{.solver = Solver::split, .substeps = 16};
    Scene scene = column(3, 0.1f);
    EXPECT_TRUE(test::usesKernel(scene, "take_recoils_back", settings));
    scene.contacts.takesRecoils = false;
    EXPECT_FALSE(test::usesKernel(scene, "find_recoils", settings));
    scene.contacts = {.restitution = 0.5f, .takesRecoils = true};
    EXPECT_FALSE(test::usesKernel(scene, "find_recoils", settings));
    EXPECT_FALSE(test::usesKernel(test::block(3, 0.1f, 1e5f), "find_recoils", settings));
}
