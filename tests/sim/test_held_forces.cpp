// Forces on what never moves: of two such things on each other there are none, a hold gives the opposite of
// what touches what it holds, and faces that never move feel any number of points.
#include "sim/bodies.hpp"
#include "sim/collision/contact_scenes.hpp"
#include "sim/holds.hpp"
#include "sim/runner.hpp"
#include "sim/scenes.hpp"

#include <gtest/gtest.h>

#include <cmath>

using namespace sinew;
using namespace sinew::sim;

namespace {

Settings withForces(std::uint32_t substeps = 16) {
    return {.substeps = substeps, .keepsForces = true};
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

double largest(const BodyImpulses& body) {
    return test::toVector(body.contacts.linear).norm() + test::toVector(body.holds.linear).norm() +
           test::toVector(body.contacts.angular).norm();
}

} // namespace

// A held ball that is driven through another held one, past a free one.
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

// Of interlocked bodies every other particle is held, so that some that never move touch.
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
