// Tests of force fields against closed forms: gravity, impulses, explosions, wind on sheets and boxes.
#include "sim/runner.hpp"
#include "sim/scenes.hpp"
#include "sinew/bodies.hpp"
#include "sinew/ranges.hpp"
#include "sinew/start.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

namespace sinew::sim {
namespace {

using Eigen::Vector3d;

constexpr float spacing = 0.1f;

void addBox(Scene& scene, Vec3 origin, float radius = 0) {
    addLattice(
        scene,
        {.origin = origin, .cells = {3, 3, 3}, .spacing = spacing, .youngModulus = 1e5f, .radius = radius});
}

// A sheet of 8 x 8 cells across the x axis.
void addSheet(Scene& scene) {
    addCloth(scene, {.right = {0, 1, 0},
                     .down = {0, 0, 1},
                     .size = {9, 9},
                     .spacing = spacing,
                     .areaDensity = 0.2f,
                     .membraneStiffness = 200});
}

struct Sums {
    double mass = 0;
    Vector3d momentum{0, 0, 0};
};

Sums sumsOf(const Scene& scene, const std::vector<Vector3d>& velocities, std::size_t first, std::size_t end) {
    Sums sums;
    for (std::size_t i = first; i < end; ++i) {
        const double m = 1 / double{scene.particles[i].inverseMass};
        sums.mass += m;
        sums.momentum += m * velocities[i];
    }
    return sums;
}

Sums sumsOf(const Scene& scene, const std::vector<Vector3d>& velocities) {
    return sumsOf(scene, velocities, 0, velocities.size());
}

std::vector<Vector3d> positionsAfter(const Scene& scene, const Settings& settings, int steps,
                                     const std::vector<ForceField>& fields, Vec3 gravity) {
    test::Runner runner(scene, settings);
    for (int s = 0; s < steps; ++s)
        EXPECT_FALSE(runner.step(Step{.gravity = gravity, .fields = fields}).isUndone);
    return runner.positions();
}

double farthestApart(const std::vector<Vector3d>& a, const std::vector<Vector3d>& b) {
    double most = 0;
    for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, (a[i] - b[i]).norm());
    return most;
}

// Velocities after one step from rest without gravity.
std::vector<Vector3d> kicked(const Scene& scene, const std::vector<ForceField>& fields,
                             Settings settings = {.substeps = 4}) {
    settings.fields = ranges::mostFields;
    test::Runner runner(scene, settings);
    EXPECT_FALSE(runner.step(Step{.gravity = {}, .fields = fields}).isUndone);
    return runner.velocities();
}

// In `split` velocities are half a substep behind: the first kick is half.
constexpr double firstKick = 1.0 / 60 * (1 - 0.5 / 4);

double firstKickOf(Solver solver) {
    return solver == Solver::split ? firstKick : 1.0 / 60;
}

constexpr Solver solvers[] = {Solver::split, Solver::jacobi, Solver::gaussSeidel};

} // namespace

TEST(Fields, PullAsGravityDoes) {
    const Vec3 g{1, -9.81f, 2};
    for (const Solver solver : solvers)
        for (const float radius : {0.0f, 0.04f}) {
            if (radius > 0 && solver != Solver::split) continue; // these have no contacts
            Scene scene;
            addBox(scene, {0, 0.3f, 0}, radius);
            addCloth(scene, {.origin = {1, 1, 0}, .size = {6, 6}, .spacing = spacing, .pinned = {0, 5}});
            // the speed at which planes see an impact follows Step::gravity, which `jacobi` depends on
            if (solver == Solver::split) scene.planes.push_back({.normal = {0, 1, 0}});
            const Settings settings{.solver = solver, .substeps = 16, .iterations = 2, .fields = 1};
            const auto pulled = positionsAfter(scene, settings, 40, {{.vector = g}}, {});
            const auto fallen = positionsAfter(scene, settings, 40, {}, g);
            const auto free = positionsAfter(scene, settings, 40, {}, {});
            const double error = farthestApart(pulled, fallen) / farthestApart(fallen, free);
            std::printf("solver %d, radius %.2f: %.2e of the way\n", static_cast<int>(solver), double{radius},
                        error);
            EXPECT_LT(error, solver == Solver::gaussSeidel ? 3e-3 : 1e-4);
        }
}

// Damping slows what a field drives as what gravity does, except in `jacobi`.
TEST(Fields, PullAsGravityDoesAgainstDamping) {
    const Vec3 g{1, -9.81f, 2};
    for (const Solver solver : {Solver::split, Solver::gaussSeidel}) {
        Scene scene;
        addBox(scene, {0, 0.3f, 0});
        scene.damping = 5;
        const Settings settings{.solver = solver, .substeps = 16, .iterations = 2, .fields = 1};
        const auto pulled = positionsAfter(scene, settings, 40, {{.vector = g}}, {});
        const auto fallen = positionsAfter(scene, settings, 40, {}, g);
        const auto free = positionsAfter(scene, settings, 40, {}, {});
        const double error = farthestApart(pulled, fallen) / farthestApart(fallen, free);
        EXPECT_LT(error, solver == Solver::gaussSeidel ? 1e-2 : 1e-4);
    }
}

// 1 km from the origin a kick of a short substep is less than the distance between numbers: remainders keep
// it.
TEST(Fields, PullAsGravityDoesFarFromTheOrigin) {
    const Vec3 g{0, -0.5f, 0};
    Scene scene;
    addBox(scene, {1000, 1000, 0});
    const Settings settings{.substeps = 64, .fields = 1};
    const auto pulled = positionsAfter(scene, settings, 20, {{.vector = g}}, {});
    const auto fallen = positionsAfter(scene, settings, 20, {}, g);
    const auto free = positionsAfter(scene, settings, 20, {}, {});
    EXPECT_LT(farthestApart(pulled, fallen), 0.01 * farthestApart(fallen, free));
}

TEST(Fields, MoveTheirBodyAlone) {
    Scene scene;
    addBox(scene, {0, 0, 0});
    const std::size_t second = scene.particles.size();
    addBox(scene, {1, 0, 0});
    const auto v = kicked(scene, {{.body = 1, .vector = {3, 4, 0}}});
    EXPECT_LT(sumsOf(scene, v, 0, second).momentum.norm(), 1e-12);
    const Sums sums = sumsOf(scene, v, second, v.size());
    EXPECT_NEAR((sums.momentum / sums.mass - firstKick * Vector3d(3, 4, 0)).norm(), 0, 1e-6);
}

// An impulse is a field of one step; a step that is not the first has its whole length.
TEST(Fields, GiveABodyAnImpulse) {
    Scene scene;
    addBox(scene, {0, 0, 0});
    test::Runner runner(scene, {.substeps = 8, .fields = 1});
    runner.step(Step{.gravity = {}});
    const double mass = sumsOf(scene, runner.velocities()).mass, impulse = 0.7;
    const ForceField push{.vector = {static_cast<float>(impulse * 60 / mass), 0, 0}};
    runner.step(Step{.gravity = {}, .fields = {&push, 1}});
    for (int s = 0; s < 5; ++s) runner.step(Step{.gravity = {}});
    EXPECT_NEAR(sumsOf(scene, runner.velocities()).momentum.x(), impulse, 1e-5 * impulse);
}

TEST(Fields, ExplodeEvenlyAndFadeTowardsTheirRim) {
    Scene scene;
    for (const Vec3 x :
         {Vec3{0.1f, 0, 0}, Vec3{-0.1f, 0, 0}, Vec3{0, 0.3f, 0}, Vec3{0, 0, 0.49f}, Vec3{0.6f, 0, 0}})
        scene.particles.push_back({.position = x});
    for (const Solver solver : solvers) {
        const auto v = kicked(scene, {{.kind = FieldKind::radial, .radius = 0.5f, .strength = 100}},
                              {.solver = solver, .substeps = 4});
        const auto expected = [&](double d) {
            return 100 * firstKickOf(solver) * std::pow(1 - d * d / 0.25, 2);
        };
        EXPECT_NEAR(v[0].x(), expected(0.1), 2e-2);
        EXPECT_NEAR(v[1].x(), -expected(0.1), 2e-2);
        EXPECT_NEAR(v[2].y(), expected(0.3), 3e-2);
        EXPECT_NEAR(v[3].z(), expected(0.49), 1e-2);
        EXPECT_EQ(v[4].norm(), 0);
    }
}

// dv/dt = k (u - v)^2 with k = strength / area density, so that u - v = u / (1 + k u t).
TEST(Fields, BlowASheetAlong) {
    Scene scene;
    addSheet(scene);
    const double u = 5;
    const Sums all = sumsOf(scene, std::vector<Vector3d>(scene.particles.size(), Vector3d::Zero()));
    const double area = 0.64, perMass = 0.6 * area / all.mass;
    test::Runner runner(scene, {.substeps = 16, .fields = 1});
    const ForceField wind{.kind = FieldKind::wind, .vector = {static_cast<float>(u), 0, 0}, .strength = 0.6f};
    for (int s = 1; s <= 30; ++s) {
        runner.step(Step{.gravity = {}, .fields = {&wind, 1}});
        const double mean = sumsOf(scene, runner.velocities()).momentum.x() / all.mass, t = s / 60.0;
        const double expected = u - u / (1 + perMass * u * t);
        EXPECT_NEAR(mean, expected, 0.02 * u) << "step " << s;
    }
}

// However strong the wind: nothing moves faster than the air.
TEST(Fields, StayStableInAnyWind) {
    for (const float strength : {1.0f, 1e3f, 1e8f}) {
        Scene scene;
        addSheet(scene);
        const ForceField wind{.kind = FieldKind::wind, .vector = {20, 0, 0}, .strength = strength};
        test::Runner runner(scene, {.substeps = 16, .fields = 1});
        for (int s = 0; s < 60; ++s)
            ASSERT_FALSE(runner.step(Step{.gravity = {}, .fields = {&wind, 1}}).isUndone);
        const double mean =
            sumsOf(scene, runner.velocities()).momentum.x() / sumsOf(scene, runner.velocities()).mass;
        EXPECT_LE(mean, 20.02) << strength;
        EXPECT_GE(mean, 15) << strength;
    }
}

// A closed box feels its windward side: strength x area x u^2, whatever its resolution.
TEST(Fields, PressOnTheWindwardSideOfABox) {
    for (const std::uint32_t n : {2u, 4u, 8u}) {
        Scene scene;
        addLattice(scene,
                   {.cells = {n, n, n}, .spacing = 0.4f / static_cast<float>(n), .youngModulus = 1e4f});
        for (const Solver solver : {Solver::split, Solver::gaussSeidel}) {
            const auto v = kicked(scene, {{.kind = FieldKind::wind, .vector = {10, 0, 0}, .strength = 0.6f}},
                                  {.solver = solver, .substeps = 4});
            const Vector3d impulse = sumsOf(scene, v).momentum;
            const double expected = 0.6 * 0.16 * 100 * firstKickOf(solver);
            EXPECT_NEAR(impulse.x(), expected, 5e-3 * expected)
                << n << " cells"; // the surface yields a little
            EXPECT_NEAR(impulse.y(), 0, 1e-4);
            EXPECT_NEAR(impulse.z(), 0, 1e-4);
        }
    }
}

// An edge of three times its rest length stands for a cut: its triangles feel nothing.
TEST(Fields, PassThroughATornSheet) {
    Scene whole, torn;
    for (Scene* scene : {&whole, &torn}) {
        addCloth(*scene, {.right = {0, 1, 0},
                          .down = {0, 0, 1},
                          .size = {9, 9},
                          .spacing = spacing,
                          .stretchCompliance = 1e6f,
                          .shearCompliance = 1e6f});
    }
    for (std::size_t i = 0; i < torn.particles.size(); ++i)
        if (i / 9 >= 5) torn.particles[i].position.z += 0.3f;
    const ForceField wind{.kind = FieldKind::wind, .vector = {5, 0, 0}, .strength = 0.006f};
    const double a = sumsOf(whole, kicked(whole, {wind})).momentum.x(),
                 b = sumsOf(torn, kicked(torn, {wind})).momentum.x();
    EXPECT_NEAR(b / a, 7.0 / 8, 0.001);
}

TEST(Fields, SwirlSmoothlyAndWithinTheirStrength) {
    Scene scene;
    for (int i = 0; i < 400; ++i)
        scene.particles.push_back({.position = {0.01f * static_cast<float>(i), 0.3f, -7}});
    const auto v = kicked(scene, {{.kind = FieldKind::turbulence, .strength = 10, .scale = 0.5f}});
    Vector3d least = v[0], most = v[0];
    double leap = 0;
    for (std::size_t i = 0; i < v.size(); ++i) {
        least = least.cwiseMin(v[i]);
        most = most.cwiseMax(v[i]);
        if (i > 0) leap = std::max(leap, (v[i] - v[i - 1]).norm());
    }
    EXPECT_LE(most.maxCoeff(), 10 * firstKick);
    EXPECT_GE(least.minCoeff(), -10 * firstKick);
    for (int axis = 0; axis < 3; ++axis) EXPECT_GT(most[axis] - least[axis], 5 * firstKick);
    EXPECT_LT(leap, 10 * firstKick * 0.02 * 4 * 1.8);
}

// Room for fields alone changes no bit, nor does a field that is none.
TEST(Fields, LeaveAStepWithoutThemAlone) {
    Scene scene;
    addBox(scene, {0, 0.3f, 0}, 0.04f);
    scene.planes.push_back({.normal = {0, 1, 0}});
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const std::vector<ForceField> none{{.vector = {nan, 0, 0}},
                                       {.body = 7, .vector = {1, 0, 0}},
                                       {.vector = {1, 0, 0}, .radius = -1},
                                       {.kind = FieldKind::wind, .vector = {1, 0, 0}, .strength = -1},
                                       {.kind = FieldKind::turbulence, .strength = 1, .scale = 0}};
    std::vector<std::uint64_t> hashes;
    for (const std::uint32_t room : {0u, 5u}) {
        test::Runner runner(scene, {.substeps = 16, .fields = room});
        for (int s = 0; s < 10; ++s)
            runner.step(Step{.fields = room > 0 ? std::span(none) : std::span<const ForceField>()});
        hashes.push_back(runner.stateHash());
    }
    EXPECT_EQ(hashes[0], hashes[1]);
}

TEST(Fields, AreTheSameInReversedOrder) {
    std::vector<std::uint64_t> hashes;
    for (const bool isReversed : {false, true}) {
        Scene scene;
        addSheet(scene);
        addBox(scene, {0.3f, 0.3f, 0.3f}, 0.04f);
        const std::vector<ForceField> fields{
            {.kind = FieldKind::wind, .vector = {8, 1, 0}, .strength = 0.6f},
            {.kind = FieldKind::turbulence, .strength = 5, .scale = 0.3f},
            {.kind = FieldKind::radial, .center = {0.4f, 0.4f, 0.4f}, .radius = 1, .strength = -5}};
        test::Runner runner(scene, {.substeps = 16, .fields = 3, .isReversed = isReversed});
        for (int s = 0; s < 10; ++s) ASSERT_FALSE(runner.step(Step{.fields = fields}).isUndone);
        hashes.push_back(runner.stateHash());
    }
    EXPECT_EQ(hashes[0], hashes[1]);
}

// Sleep goes on under fields that stay as they are, and ends when they change.
TEST(Fields, WakeBodiesWhenTheyChange) {
    Scene scene;
    addBox(scene, {0, 0.05f, 0}, 0.04f);
    scene.damping = 2;
    scene.planes.push_back({.normal = {0, 1, 0}, .friction = 0.8f});
    ForceField field{.vector = {0, -1, 0}};
    test::Runner runner(scene, {.substeps = 16, .sleeps = true, .fields = 1});
    std::uint32_t sleeping = 0;
    const auto all = static_cast<std::uint32_t>(scene.particles.size());
    for (int s = 0; s < 400 && sleeping < all; ++s)
        sleeping = runner.step(Step{.fields = {&field, 1}}).sleeping;
    ASSERT_EQ(sleeping, all);
    const std::uint64_t hash = runner.stateHash();
    for (int s = 0; s < 20; ++s) EXPECT_EQ(runner.step(Step{.fields = {&field, 1}}).sleeping, all);
    EXPECT_EQ(runner.stateHash(), hash);
    field.vector = {0, 30, 0};
    EXPECT_EQ(runner.step(Step{.fields = {&field, 1}}).sleeping, 0u);
    for (int s = 0; s < 20; ++s) runner.step(Step{.fields = {&field, 1}});
    EXPECT_GT(runner.positions()[0].y(), 0.2);
}

// A saved state knows the fields under which its bodies fell asleep, whatever came after it.
TEST(Fields, BelongToASavedState) {
    Scene scene;
    addBox(scene, {0, 0.05f, 0}, 0.04f);
    scene.damping = 2;
    scene.planes.push_back({.normal = {0, 1, 0}, .friction = 0.8f});
    const ForceField weak{.vector = {0, -1, 0}}, strong{.vector = {0, 30, 0}};
    test::Runner runner(scene, {.substeps = 16, .sleeps = true, .fields = 1});
    const auto all = static_cast<std::uint32_t>(scene.particles.size());
    std::uint32_t sleeping = 0;
    for (int s = 0; s < 400 && sleeping < all; ++s)
        sleeping = runner.step(Step{.fields = {&weak, 1}}).sleeping;
    ASSERT_EQ(sleeping, all);
    const test::Runner::Saved saved = runner.save();
    EXPECT_EQ(runner.step(Step{.fields = {&strong, 1}}).sleeping, 0u);
    runner.load(saved);
    EXPECT_EQ(runner.step(Step{.fields = {&weak, 1}}).sleeping, all);
    runner.step(Step{.fields = {&strong, 1}});
    runner.load(saved);
    EXPECT_EQ(runner.step(Step{.fields = {&strong, 1}}).sleeping, 0u);
}

// Absurd numbers neither undo a step nor leave numbers that are not finite.
TEST(Fields, StandAbsurdNumbers) {
    Scene scene;
    addSheet(scene);
    constexpr float huge = 3e38f, tiny = 1e-44f;
    const std::vector<ForceField> fields{
        {.vector = {huge, 0, 0}},
        {.kind = FieldKind::radial, .radius = tiny, .strength = huge},
        {.kind = FieldKind::wind, .vector = {1e9f, 0, 0}, .strength = huge},
        {.kind = FieldKind::wind, .vector = {-1e9f, 3, 0}, .strength = tiny},
        {.kind = FieldKind::turbulence, .strength = 1, .scale = tiny},
        {.kind = FieldKind::turbulence, .vector = {1e9f, 0, 0}, .strength = 1, .scale = 1e-6f},
        {.kind = static_cast<FieldKind>(77), .vector = {1, 1, 1}}};
    for (const ForceField& field : fields) {
        test::Runner runner(scene, {.substeps = 4, .fields = 1});
        EXPECT_FALSE(runner.step(Step{.gravity = {}, .fields = {&field, 1}}).isUndone);
    }
}

// Restitution is that of impacts: a ball that a field presses onto a plane lies still.
TEST(Fields, PressWithoutRebounds) {
    Scene scene;
    scene.particles.push_back({.position = {0, 0.1f, 0}, .contactOffset = 0.1f});
    scene.planes.push_back({.normal = {0, 1, 0}, .restitution = 0.9f});
    const ForceField press{.vector = {0, -9.81f, 0}};
    test::Runner runner(scene, {.substeps = 8, .fields = 1});
    for (int s = 0; s < 60; ++s) {
        runner.step(Step{.gravity = {}, .fields = {&press, 1}});
        EXPECT_LT(runner.velocities()[0].y(), 1e-3);
    }
    EXPECT_NEAR(runner.positions()[0].y(), 0.1, 1e-4);
}

TEST(Fields, SayThatThereIsNoRoom) {
    Scene scene;
    addBox(scene, {0, 0, 0});
    const std::vector<ForceField> three(3, {.vector = {1, 0, 0}});
    test::Runner runner(scene, {.substeps = 4, .fields = 2});
    runner.step(Step{.gravity = {}, .fields = three});
    const std::vector<std::string> said = runner.simulation().complaints();
    ASSERT_EQ(said.size(), 1u);
    EXPECT_NE(said[0].find("3 force fields are given, settings.fields is 2"), std::string::npos) << said[0];
    const Sums sums = sumsOf(scene, runner.velocities());
    EXPECT_NEAR(sums.momentum.x() / sums.mass, 2 * firstKick, 1e-6);
}

} // namespace sinew::sim
