// Tests of forces on fixed objects: there are none between two fixed objects, a hold reports the opposite of
// the contact forces on its particles, and fixed faces accept any number of points.
#include "sim/collision/contact_scenes.hpp"
#include "sim/core/hash.hpp"
#include "sim/program/program.hpp"
#include "sim/runner.hpp"
#include "sim/scenes.hpp"
#include "sinew/bodies.hpp"
#include "sinew/holds.hpp"

#include <gtest/gtest.h>

#include <cmath>

using namespace sinew;
using namespace sinew::sim;

namespace {

using Vector = Eigen::Vector3d;

constexpr double gravity = 9.81, weightShare = 0.005; // [m/s^2]

Settings withForces(std::uint32_t substeps = 16) {
    return {.substeps = substeps, .keepsForces = true};
}

Vector forceOf(const Impulse& impulse, const Scene& scene) {
    return test::toVector(impulse.linear) / double{scene.dt};
}

// Impulses of ten steps after `steps` others.
std::vector<Impulses> after(test::Runner& runner, int steps) {
    std::vector<Impulses> all;
    runner.run(steps);
    for (int s = 0; s < 10; ++s) {
        const Status status = runner.run(1);
        EXPECT_FALSE(status.isUndone);
        all.push_back(runner.simulation().forces(status.frame));
    }
    return all;
}

// Expects an upward force of this size, within a share of the total weight.
void expectUp(const Impulse& impulse, double force, const Scene& scene, double weight) {
    const Vector found = forceOf(impulse, scene);
    EXPECT_LE((found - Vector(0, force, 0)).norm(), weightShare * weight) << found.transpose();
}

// A block of 3^3 cells of 0.1 m.
void addBlock(Scene& scene, const Vec3& origin) {
    addLattice(scene, {.name = "block",
                       .origin = origin,
                       .cells = {3, 3, 3},
                       .spacing = 0.1f,
                       .youngModulus = 2e5f,
                       .radius = 0.05f});
}

Scene quiet() {
    Scene scene;
    scene.dampingTime = 2e-3f;
    scene.contacts = {.friction = 0.5f, .staticFriction = 0.5f};
    return scene;
}

double weightOf(const Scene& scene) {
    double mass = 0;
    for (const Particle& particle : scene.particles)
        if (particle.inverseMass > 0) mass += 1 / double{particle.inverseMass};
    return gravity * mass;
}

MeshCollider meshOf(std::vector<Vec3> vertices, std::vector<std::array<std::uint32_t, 3>> triangles) {
    return {.name = "floor",
            .vertices = std::move(vertices),
            .triangles = std::move(triangles),
            .thickness = 0.01f};
}

// Two squares beside each other, each with half extent 0.6.
MeshCollider twoTables() {
    return meshOf({{-0.6f, 0, -0.6f},
                   {0.6f, 0, -0.6f},
                   {0.6f, 0, 0.6f},
                   {-0.6f, 0, 0.6f},
                   {1.4f, 0, -0.6f},
                   {2.6f, 0, -0.6f},
                   {2.6f, 0, 0.6f},
                   {1.4f, 0, 0.6f}},
                  {{0, 2, 1}, {0, 3, 2}, {4, 6, 5}, {4, 7, 6}});
}

// Contents of the buffer with this label.
std::vector<std::byte> contents(test::Runner& runner, const std::string& label) {
    const auto& buffers = runner.simulation().program().buffers;
    for (std::uint32_t b = 0; b < buffers.size(); ++b)
        if (buffers[b].label == label)
            return test::queue().download<std::byte>(runner.simulation().view({b}));
    ADD_FAILURE() << "no " << label;
    return {};
}

double largest(const BodyImpulses& body) {
    return test::toVector(body.contacts.linear).norm() + test::toVector(body.holds.linear).norm() +
           test::toVector(body.contacts.angular).norm();
}

} // namespace

// A held ball is driven through another held ball, past a free one.
TEST(HeldForces, OfTwoThatNeverMoveAreNone) {
    for (const float restitution : {0.0f, 0.5f})
        for (const float friction : {0.0f, 0.4f}) {
            SCOPED_TRACE(testing::Message() << restitution << ' ' << friction);
            Scene scene = test::weightless();
            scene.contacts = {.friction = friction, .restitution = restitution};
            scene.particles = {test::fixedBallAt({-0.5f, 0, 0}), test::fixedBallAt({0, 0.02f, 0}),
                               test::ballAt({2, 0, 0}, {0, 1, 0})};
            scene.bodies = {{"driven", 0, 1}, {"held", 1, 1}, {"free", 2, 1}};
            scene.driven = {
                {.firstParticle = 0, .particleCount = 1, .path = {{0, {}}, {0.5, {.position = {1, 0, 0}}}}}};
            test::Runner runner(scene, withForces(8));
            for (int s = 0; s < 40; ++s) {
                const Status status = runner.run(1);
                ASSERT_FALSE(status.isUndone) << s;
                const Impulses impulses = runner.simulation().forces(status.frame);
                for (const BodyImpulses& body : impulses.bodies) ASSERT_EQ(largest(body), 0) << s;
            }
            EXPECT_NEAR(runner.positions()[2].y(), 40.0 / 60, 1e-4);
        }
}

// Every other particle of two interlocked bodies is held, so that some fixed particles touch.
TEST(HeldForces, OfInterlockedBodiesThatAreHeldAreFinite) {
    Scene scene = test::weightless();
    addBlock(scene, {0, 0, 0});
    addBlock(scene, {0.17f, 0.13f, 0.11f});
    std::vector<std::uint32_t> held;
    for (std::uint32_t i = 0; i < scene.particles.size(); i += 2) held.push_back(i);
    hold(scene, held);
    test::Runner runner(scene, withForces());
    double most = 0;
    for (int s = 0; s < 10; ++s) {
        const Status status = runner.run(1);
        ASSERT_FALSE(status.isUndone);
        const Impulses impulses = runner.simulation().forces(status.frame);
        for (const BodyImpulses& body : impulses.bodies) most = std::max(most, largest(body));
    }
    EXPECT_GT(most, 0);
    EXPECT_LT(most, 1e6);
}

// 2,500 small balls fall onto one triangle, more than a moving face can list.
TEST(HeldForces, FeelAnyNumberOfPointsOnOneFace) {
    Scene scene;
    scene.damping = 1;
    constexpr float radius = 0.004f, mass = 1e-3f;
    for (int i = 0; i < 50; ++i)
        for (int k = 0; k < 50; ++k)
            scene.particles.push_back({.position = {0.012f * static_cast<float>(i - 25), 0.016f,
                                                    0.012f * static_cast<float>(k - 25)},
                                       .inverseMass = 1 / mass,
                                       .contactOffset = radius,
                                       .radius = radius});
    scene.bodies = {{"grains", 0, 2500}};
    addMeshCollider(scene, meshOf({{-3, 0, -3}, {3, 0, -3}, {0, 0, 4}}, {{0, 2, 1}}));
    const Settings with = withForces();
    test::Runner runner(scene, with);
    const double weight = weightOf(scene);
    for (const Impulses& impulses : after(runner, 60)) {
        expectUp(impulses.bodies[0].contacts, weight, scene, weight);
        expectUp(impulses.bodies[1].contacts, -weight, scene, weight);
        expectUp(impulses.bodies[1].holds, weight, scene, weight);
    }
    Settings without = with;
    without.keepsForces = false;
    EXPECT_EQ(test::hashOfRun(scene, with, 20), test::hashOfRun(scene, without, 20));
}

TEST(HeldForces, OfAHoldAreThoseOfWhatStandsOnItsParticles) {
    Scene scene = quiet();
    addBlock(scene, {0, 0.1f, 0});
    NamedHold held{"pegs", {}};
    const auto first = static_cast<std::uint32_t>(scene.particles.size());
    for (const float x : {0.0f, 0.1f, 0.2f, 0.3f})
        for (const float z : {0.0f, 0.1f, 0.2f, 0.3f}) {
            held.particles.push_back(static_cast<std::uint32_t>(scene.particles.size()));
            Particle peg = test::fixedBallAt({x, 0, z});
            peg.radius = peg.contactOffset = 0.05f;
            scene.particles.push_back(peg);
        }
    scene.bodies.push_back({"pegs", first, 16});
    scene.holds = {held};
    test::Runner runner(scene, withForces(32));
    const double weight = weightOf(scene);
    for (const Impulses& impulses : after(runner, 240)) {
        expectUp(impulses.bodies[1].contacts, -weight, scene, weight);
        expectUp(impulses.bodies[1].holds, weight, scene, weight);
        expectUp(impulses.holds[0], weight, scene, weight);
    }
}

TEST(HeldForces, OfAHoldAreThoseOfWhatStandsOnItsFaces) {
    Scene scene = quiet();
    addBlock(scene, {-0.15f, 0.06f, -0.15f});
    addMeshCollider(scene, twoTables());
    const std::uint32_t first = scene.bodies[1].firstParticle;
    NamedHold loaded{"loaded", {}}, empty{"empty", {}}, both{"both", {}};
    for (std::uint32_t i = 0; i < 8; ++i) {
        (i < 4 ? loaded : empty).particles.push_back(first + i);
        both.particles.push_back(first + i);
    }
    scene.holds = {loaded, empty, both};
    test::Runner runner(scene, withForces(32));
    const double weight = weightOf(scene);
    for (const Impulses& impulses : after(runner, 240)) {
        expectUp(impulses.bodies[1].contacts, -weight, scene, weight);
        expectUp(impulses.bodies[1].holds, weight, scene, weight);
        expectUp(impulses.holds[0], weight, scene, weight);
        expectUp(impulses.holds[1], 0, scene, weight);
        expectUp(impulses.holds[2], weight, scene, weight);
        // The block stands 1 m from the middle of both squares, which gives a torque about z.
        EXPECT_NEAR(double{impulses.bodies[1].contacts.angular.z} / double{scene.dt}, weight, 0.02 * weight);
        EXPECT_NEAR(double{impulses.bodies[1].holds.angular.z} / double{scene.dt}, -weight, 0.02 * weight);
    }
}

// A ball falls onto a cloth of which only the middle can move, and touches faces with fixed corners. The hold
// causes all changes of momentum except those by gravity.
TEST(HeldForces, OfABorderAreTheChangesOfMomentum) {
    Scene scene;
    addCloth(scene, {.origin = {-0.2f, 0, -0.2f}, .size = {3, 3}, .spacing = 0.2f, .thickness = 0.02f});
    const std::vector<std::uint32_t> border{0, 1, 2, 3, 5, 6, 7, 8}; // all except the middle
    hold(scene, border);
    scene.holds = {{"border", border}};
    scene.particles.push_back(test::ballAt({0.06f, 0.12f, 0.04f}, {}, 2));
    scene.bodies.push_back({"ball", 9, 1});
    test::Runner runner(scene, withForces());
    const double middle = 1 / double{scene.particles[4].inverseMass}, dt = double{scene.dt};
    const auto momentum = [&] {
        return Vector(2 * runner.velocities()[9] + middle * runner.velocities()[4]);
    };
    runner.run(2);
    Vector before = momentum(), given = Vector::Zero();
    for (int s = 0; s < 60; ++s) {
        const Status status = runner.run(1);
        const Impulses impulses = runner.simulation().forces(status.frame);
        const Vector now = momentum(), held = test::toVector(impulses.holds[0].linear),
                     weight = Vector(0, -gravity * (2 + middle) * dt, 0);
        EXPECT_LE((now - before - weight - held).norm(), 2e-4 * (1 + held.norm())) << s;
        EXPECT_LE((held - test::toVector(impulses.bodies[0].holds.linear)).norm(), 1e-5 * (1 + held.norm()))
            << s;
        given += held;
        before = now;
    }
    EXPECT_GT(given.y(), 0.5 * 2 * gravity * 60 * dt);
}

// The simulation that takes over continues exactly, also if its first step is undone.
TEST(HeldForces, MayBeAskedForLater) {
    Scene scene;
    addChain(scene,
             {.origin = {0, 1, 0}, .direction = {1, 0, 0}, .particles = 6, .length = 0.5f, .pinned = {0}});
    Settings with = withForces(), without = with;
    without.keepsForces = false;
    for (const auto [isFirst, isUndone] : {std::array{false, false}, std::array{false, true},
                                           std::array{true, false}, std::array{true, true}}) {
        SCOPED_TRACE(testing::Message() << isFirst << ' ' << isUndone);
        test::Runner from(scene, isFirst ? with : without), to(scene, isFirst ? without : with);
        from.run(30);
        to.takeOver(from);
        if (!isFirst) {
            EXPECT_EQ(contents(to, "state.positions"), contents(to, "state.positions.saved"));
            EXPECT_EQ(contents(to, "state.velocities"), contents(to, "state.velocities.saved"));
        }
        if (isUndone) {
            to.writePosition(5, NAN);
            ASSERT_TRUE(to.run(1).isUndone);
        }
        to.run(1);
        from.run(1);
        const std::vector<Vector> now = to.positions(), undisturbed = from.positions();
        for (std::size_t i = 0; i < now.size(); ++i) EXPECT_LE((now[i] - undisturbed[i]).norm(), 1e-5) << i;
    }
}

TEST(HeldForces, NeedNoRoomForContactsWhereThereAreNone) {
    Scene scene;
    addBlock(scene, {0, 1, 0});
    for (Particle& particle : scene.particles) particle.radius = 0;
    Settings roomy = withForces(), narrow = withForces();
    roomy.contactRoom = 2 * narrow.contactRoom;
    test::Runner from(scene, roomy), to(scene, narrow);
    from.run(2);
    EXPECT_NO_THROW(to.takeOver(from));
}
