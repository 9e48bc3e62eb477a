// Tests that keeping forces does not change the motion, is not part of the state, is independent of the
// invocation order, and does not count undone steps.
#include "sim/collision/contact_scenes.hpp"
#include "sim/collision/face_scenes.hpp"
#include "sim/compile/compile.hpp"
#include "sim/core/hash.hpp"
#include "sim/runner.hpp"
#include "sim/scenes.hpp"
#include "sinew/bodies.hpp"
#include "sinew/holds.hpp"
#include "sinew/validate.hpp"

#include <gtest/gtest.h>

#include <cinttypes>
#include <cmath>

using namespace sinew;
using namespace sinew::sim;

namespace {

using Vector = Eigen::Vector3d;

Settings withForces(std::uint32_t substeps = 16) {
    return {.substeps = substeps, .keepsForces = true};
}

Lattice blockAt(const Vec3& origin, bool isCuttable = false) {
    return {.name = "block",
            .origin = origin,
            .cells = {3, 3, 3},
            .spacing = 0.1f,
            .youngModulus = 2e5f,
            .radius = 0.05f,
            .isCuttable = isCuttable};
}

// Two blocks, one held at a corner, fall onto a mesh and a plane with a collider; with friction and
// restitution.
Scene clash(bool hasSurfaces, float restitution) {
    Scene scene{.name = "clash"};
    addLattice(scene, blockAt({0, 0.1f, 0}));
    addLattice(scene, blockAt({0.1f, 0.52f, 0.05f}));
    addMeshCollider(scene, {.name = "mesh",
                            .vertices = {{-1, 0, -1}, {1, 0.02f, -1}, {1, 0, 1}, {-1, 0, 1}},
                            .triangles = {{0, 2, 1}, {0, 3, 2}},
                            .thickness = 0.01f});
    hold(scene, std::vector<std::uint32_t>{70});
    for (std::uint32_t i = 64; i < 128; ++i) scene.particles[i].velocity = {0.5f, -2, 0};
    scene.contacts = {.friction = 0.4f, .restitution = restitution, .staticFriction = 0.5f};
    if (hasSurfaces) {
        scene.contacts.surfaces = {{.friction = 0.1f, .restitution = restitution}};
        for (std::uint32_t i = 64; i < 128; ++i) scene.particles[i].surface = 1;
    }
    scene.planes = {{.normal = {1, 0, 0}, .offset = -0.02f, .friction = 0.3f, .restitution = restitution}};
    scene.colliders = {
        {.radius = 0.1f, .restitution = restitution, .pose = {.position = {0.15f, 0.1f, 0.6f}}}};
    scene.holds = {{"corner", {70}}};
    return scene;
}

// Two lattices, one inside the other.
Scene interlocked() {
    Scene scene = test::weightless();
    addLattice(scene, blockAt({0, 0, 0}));
    addLattice(scene, blockAt({0.17f, 0.13f, 0.11f}));
    return scene;
}

std::vector<test::NamedScene> scenes() {
    Scene loose = test::weightless();
    loose.gravity = {0, -9.81f, 0};
    loose.planes = {{.friction = 0.2f, .restitution = 0.4f}};
    test::addBalls(loose, 3, 0.11f, 0.01f, {0, 0.5f, 0});
    loose.bodies = {{"balls", 0, static_cast<std::uint32_t>(loose.particles.size())}};
    Scene column = test::weightless(); // on a plane and a collider, which take recoils back
    column.gravity = {0, -9.81f, 0};
    column.contacts.takesRecoils = true;
    column.planes = {{.friction = 0.2f}};
    column.colliders = {{.radius = 0.1f, .pose = {.position = {1, 0.1f, 0}}}};
    for (std::uint32_t i = 0; i < 10; ++i)
        column.particles.push_back(
            {.position = {i < 5 ? 0.0f : 1.0f, (i < 5 ? 0.05f : -0.24f) + 0.1f * static_cast<float>(i), 0},
             .velocity = {0, -2, 0},
             .radius = 0.05f});
    column.bodies = {{"low", 0, 2}, {"high", 2, 3}, {"collider", 5, 5}};
    return {{"column", column},
            {"clash", clash(false, 0)},
            {"clash_with_rebound", clash(false, 0.5f)},
            {"clash_of_surfaces", clash(true, 0)},
            {"clash_of_surfaces_with_rebound", clash(true, 0.5f)},
            {"loose", loose},
            {"interlocked", interlocked()},
            {"cloth_on_ball", test::clothOnBall()},
            {"cloth_on_box", test::clothOnBox(0.25f)},
            {"crossed_sheets", test::crossedSheets(0.25f)}};
}

std::vector<std::byte> sumsOf(test::Runner& runner) {
    return test::queue().download<std::byte>(runner.simulation().forceSums());
}

double norm(const Vec3& v) {
    return test::toVector(v).norm();
}

void expectNothing(const Impulses& impulses) {
    EXPECT_TRUE(impulses.isFinished);
    for (const BodyImpulses& body : impulses.bodies)
        EXPECT_EQ(norm(body.contacts.linear) + norm(body.planes.linear) + norm(body.colliders.linear) +
                      norm(body.holds.linear) + norm(body.grabs.linear) + norm(body.contacts.angular),
                  0);
    for (const std::vector<Impulse>* list :
         {&impulses.planes, &impulses.colliders, &impulses.hostColliders, &impulses.grabs, &impulses.holds})
        for (const Impulse& impulse : *list) EXPECT_EQ(norm(impulse.linear) + norm(impulse.angular), 0);
}

} // namespace

TEST(KeptForces, ChangeNoMotionOfWhatTouches) {
    for (const test::NamedScene& named : scenes()) {
        SCOPED_TRACE(named.name);
        Settings with = withForces(), without = withForces();
        without.keepsForces = false;
        EXPECT_EQ(test::hashOfRun(named.scene, with, 25), test::hashOfRun(named.scene, without, 25));
    }
}

// With kept forces, the planes of a scene without contacts use a separate pass.
TEST(KeptForces, ChangeNoMotionElsewhereButForRounding) {
    for (const test::NamedScene& named : test::allScenes()) {
        if (named.scene.particles.empty()) continue;
        SCOPED_TRACE(named.name);
        Settings settings = withForces();
        test::Runner with(named.scene, settings);
        settings.keepsForces = false;
        test::Runner without(named.scene, settings);
        with.run(10);
        without.run(10);
        const std::vector<Vector> a = with.positions(), b = without.positions();
        for (std::size_t i = 0; i < a.size(); ++i)
            EXPECT_LE((a[i] - b[i]).norm(), 2e-5 * test::sizeOf(named.scene)) << i;
    }
}

TEST(KeptForces, OfContactsAddUpToNothing) {
    for (const test::NamedScene& named : scenes()) {
        SCOPED_TRACE(named.name);
        test::Runner runner(named.scene, withForces());
        double most = 0;
        for (int s = 0; s < 40; ++s) {
            const Status status = runner.run(1);
            ASSERT_FALSE(status.isUndone);
            const Impulses impulses = runner.simulation().forces(status.frame);
            Vector sum = Vector::Zero();
            double size = 0;
            for (const BodyImpulses& body : impulses.bodies) {
                sum += test::toVector(body.contacts.linear);
                size = std::max(size, norm(body.contacts.linear));
            }
            EXPECT_LE(sum.norm(), 2e-5 * (size + 1)) << "step " << s;
            most = std::max(most, size);
        }
        if (named.scene.bodies.size() > 1) {
            EXPECT_GT(most, 1e-3) << "nothing has touched";
        }
    }
}

// compare_thread_counts.cmake runs this test with several numbers of threads and compares its output.
TEST(KeptForces, HaveTheSameBitsInReversedOrder) {
    for (const test::NamedScene& named : scenes()) {
        SCOPED_TRACE(named.name);
        Settings settings = withForces();
        test::Runner runner(named.scene, settings);
        settings.isReversed = true;
        test::Runner reversed(named.scene, settings);
        std::uint64_t hash = fnv1a({});
        for (int s = 0; s < 12; ++s) {
            runner.run(1);
            reversed.run(1);
            const std::vector<std::byte> sums = sumsOf(runner);
            ASSERT_FALSE(sums.empty());
            EXPECT_EQ(sums, sumsOf(reversed)) << "step " << s;
            hash = fnv1a(sums, hash);
        }
        std::printf("state_hash %s %016" PRIx64 "\n", named.name.c_str(), hash);
    }
}

TEST(KeptForces, AreOnTheDeviceWhatTheHostReads) {
    test::Runner runner(clash(false, 0.5f), withForces());
    Status status;
    for (int s = 0; s < 10; ++s) status = runner.run(1);
    const Impulses impulses = runner.simulation().forces(status.frame);
    const auto sums = test::queue().download<std::array<float, 8>>(runner.simulation().forceSums());
    ASSERT_EQ(impulses.bodies.size(), 3u);
    EXPECT_EQ(impulses.bodies[1].contacts.linear.y, sums[5][1]);
    EXPECT_EQ(impulses.bodies[2].contacts.angular.x, sums[10][4]);
    EXPECT_EQ(impulses.planes[0].linear.x, sums[15][0]);
    EXPECT_FALSE(runner.simulation().forces(status.frame + 1).isFinished);
    EXPECT_TRUE(runner.simulation().forces(status.frame + 1).bodies.empty());
}

TEST(KeptForces, CostNothingWhereNobodyAsks) {
    const Scene scene = clash(true, 0.5f);
    for (const bool keeps : {false, true}) {
        Settings settings = withForces();
        settings.keepsForces = keeps;
        const StepProgram program = compile(scene, settings);
        const auto isOfForces = [](const auto& named) {
            return named.label.find("forces") != std::string::npos || named.label == "extract_hold_impulses";
        };
        EXPECT_EQ(std::ranges::any_of(program.buffers, isOfForces), keeps);
        EXPECT_EQ(std::ranges::any_of(program[List::step], isOfForces), keeps);
        EXPECT_EQ(program.forces.sums == BufferId{}, !keeps);
    }
    Settings settings = withForces();
    settings.keepsForces = false;
    test::Runner runner(scene, settings);
    const Status status = runner.run(1);
    EXPECT_TRUE(runner.simulation().forces(status.frame).bodies.empty());
    EXPECT_EQ(runner.simulation().forceSums().size, 0u);
}

TEST(KeptForces, AreNoPartOfASavedState) {
    const Scene scene = clash(false, 0.5f);
    test::Runner runner(scene, withForces());
    runner.run(20);
    const test::Runner::Saved saved = runner.save();
    std::vector<std::vector<std::byte>> first;
    for (int s = 0; s < 5; ++s) {
        runner.run(1);
        first.push_back(sumsOf(runner));
    }
    runner.load(saved);
    for (int s = 0; s < 5; ++s) {
        runner.run(1);
        EXPECT_EQ(sumsOf(runner), first[static_cast<std::size_t>(s)]) << s;
    }
    EXPECT_NE(first[0], first[1]);
}

TEST(KeptForces, OfAnUndoneStepAreNone) {
    Scene scene = clash(false, 0);
    test::Runner runner(scene, withForces());
    test::Runner undisturbed(scene, withForces());
    runner.run(10);
    undisturbed.run(10);
    runner.writePosition(5, NAN);
    Status status = runner.run(1);
    ASSERT_TRUE(status.isUndone);
    expectNothing(runner.simulation().forces(status.frame));
    status = runner.run(1);
    ASSERT_FALSE(status.isUndone);
    undisturbed.run(1);
    const Impulses again = runner.simulation().forces(status.frame),
                   once = undisturbed.simulation().forces(10);
    EXPECT_GT(norm(again.bodies[0].contacts.linear), 1e-3);
    EXPECT_EQ(norm(again.bodies[0].contacts.linear), norm(once.bodies[0].contacts.linear));
    // Contact capacity is too small.
    Settings narrow = withForces();
    narrow.contactRoom = 1;
    Scene dense = test::weightless();
    test::addBalls(dense, 5, 0.11f, 0.001f);
    dense.bodies = {{"balls", 0, static_cast<std::uint32_t>(dense.particles.size())}};
    test::Runner crowded(dense, narrow);
    bool hasLacked = false;
    for (int s = 0; s < 30 && !hasLacked; ++s) {
        status = crowded.run(1);
        hasLacked = status.contactRoom > 0;
    }
    ASSERT_TRUE(hasLacked);
    expectNothing(crowded.simulation().forces(status.frame));
}

TEST(KeptForces, AreThoseOfABodyThatWasCut) {
    Scene scene{.name = "cut"};
    scene.damping = 2; // takes 0.2 % of the weight
    addLattice(scene, blockAt({0, 0, 0}, true));
    scene.planes = {{.friction = 0.5f}};
    test::Runner runner(scene, withForces());
    runner.run(60);
    const std::array from{Vec3{0.16f, 0.5f, -0.1f}, Vec3{0.16f, 0.5f, 0.5f}},
        to{Vec3{0.16f, -0.1f, -0.1f}, Vec3{0.16f, -0.1f, 0.5f}};
    EXPECT_GT(runner.cut({.from = from, .to = to}).linksCut, 0u);
    runner.run(180);
    double mass = 0;
    for (const Particle& particle : scene.particles) mass += 1 / double{particle.inverseMass};
    for (int s = 0; s < 10; ++s) {
        const Status status = runner.run(1);
        EXPECT_EQ(status.pieces, 2u);
        const Impulses impulses = runner.simulation().forces(status.frame);
        EXPECT_NEAR(double{impulses.bodies[0].planes.linear.y} / double{scene.dt}, 9.81 * mass,
                    0.005 * 9.81 * mass);
    }
}

TEST(KeptForces, OfPokesAreOppositeToTheirBodies) {
    Scene scene = test::weightless();
    addLattice(scene, blockAt({0, 0, 0}));
    Settings settings = withForces();
    settings.hostColliders = 2;
    test::Runner runner(scene, settings);
    double pushed = 0;
    for (int s = 0; s < 30; ++s) {
        const std::array hostColliders{
            HostCollider{.radius = NAN}, // is inactive
            HostCollider{.radius = 0.1f,
                         .pose = {.position = {-0.3f + 0.01f * static_cast<float>(s), 0.15f, 0.15f}}}};
        const Status status =
            runner.step({.dt = scene.dt, .gravity = scene.gravity, .hostColliders = hostColliders});
        const Impulses impulses = runner.simulation().forces(status.frame);
        EXPECT_EQ(norm(impulses.hostColliders[0].linear), 0);
        EXPECT_LE((test::toVector(impulses.hostColliders[1].linear) +
                   test::toVector(impulses.bodies[0].colliders.linear))
                      .norm(),
                  1e-5);
        pushed += double{impulses.bodies[0].colliders.linear.x};
    }
    Vector momentum = Vector::Zero();
    const std::vector<Vector> v = runner.velocities();
    for (std::size_t i = 0; i < v.size(); ++i) momentum += v[i] / double{scene.particles[i].inverseMass};
    EXPECT_GT(pushed, 1);
    EXPECT_NEAR(pushed, momentum.x(), 1e-3 * pushed);
}

TEST(KeptForces, AreRefusedWhereThereAreNone) {
    Scene scene = test::chain(3);
    scene.fixed = {{0}};
    for (const Solver solver : {Solver::jacobi, Solver::gaussSeidel}) {
        Settings settings = withForces();
        settings.solver = solver;
        EXPECT_EQ(validate(scene, settings).size(), 1u) << solverName(solver);
    }
    Scene free = test::chain(3);
    free.fixed.clear();
    for (Particle& particle : free.particles) particle.inverseMass = 1;
    Settings settings = withForces();
    settings.solver = Solver::gaussSeidel;
    EXPECT_TRUE(validate(free, settings).empty());
    settings.solver = Solver::jacobi; // its links do not conserve momentum
    ASSERT_EQ(validate(free, settings).size(), 1u);
    EXPECT_NE(validate(free, settings)[0].find("jacobi averages"), std::string::npos);
    free.distances.clear();
    EXPECT_TRUE(validate(free, settings).empty());
    settings = withForces();
    settings.sleeps = true;
    ASSERT_EQ(validate(scene, settings).size(), 1u);
    EXPECT_NE(validate(scene, settings)[0].find("sleep"), std::string::npos);
    scene.holds = {{"nobody", {7}}};
    EXPECT_EQ(validate(scene, withForces()).size(), 1u);
}

TEST(KeptForces, AreRefusedWhereTheyHaveNoRoom) {
    Scene scene{.particles = std::vector<Particle>(3'400'000, {.inverseMass = 1})};
    scene.planes.resize(32);
    scene.colliders.resize(64, {.radius = 1});
    Settings settings = withForces();
    EXPECT_TRUE(
        validate(scene, settings).empty()); // 68 elements of 16 B for each: many colliders have one row
    settings.grabs = settings.hostColliders = 8;
    ASSERT_EQ(validate(scene, settings).size(), 1u); // 84
    EXPECT_NE(validate(scene, settings)[0].find("do not fit in one buffer"), std::string::npos);
    settings.keepsForces = false;
    EXPECT_TRUE(validate(scene, settings).empty());
}

// Faces have a row only if a point can touch them.
TEST(KeptForces, HaveNoRowsOfFacesThatStopNothing) {
    const auto rows = [](float radius) {
        Scene scene = test::particleAt({0, 1, 0});
        scene.particles[0].radius = radius;
        addMeshCollider(scene, {.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 0, 1}}, .triangles = {{0, 2, 1}}});
        return compile(scene, withForces()).forces.stops;
    };
    EXPECT_EQ(rows(0.1f), 1u);
    EXPECT_EQ(rows(0), 0u);
}
