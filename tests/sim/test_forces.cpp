// Compares the forces that a step reports with weight, momentum and Hooke's law. Reporting forces must not
// change the motion of a scene.
#include "sim/collision/contact_scenes.hpp"
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
#include <numbers>

using namespace sinew;
using namespace sinew::sim;

namespace {

using Vector = Eigen::Vector3d;

constexpr double gravity = 9.81; // [m/s^2]

Settings withForces(std::uint32_t substeps = 32) {
    return {.substeps = substeps, .keepsForces = true};
}

double massOf(const Scene& scene, const Body& body) {
    double mass = 0;
    for (std::uint32_t i = body.firstParticle; i < body.firstParticle + body.particleCount; ++i)
        if (scene.particles[i].inverseMass > 0) mass += 1 / double{scene.particles[i].inverseMass};
    return mass;
}

// A block of 3^3 cells of 0.1 m with its lowest corner at (0, height, 0) and particles 0.05 m wide.
void addBlock(Scene& scene, float height, const std::string& name = "block", float x = 0,
              float young = 2e5f) {
    addLattice(scene, {.name = name,
                       .origin = {x, height, 0},
                       .cells = {3, 3, 3},
                       .spacing = 0.1f,
                       .youngModulus = young,
                       .radius = 0.05f});
}

Scene quiet() {
    Scene scene{.name = "forces"};
    scene.dampingTime = 2e-3f;
    scene.contacts = {.friction = 0.5f, .staticFriction = 0.5f};
    return scene;
}

// Two triangles at `height` that extend far beyond a block; their common centre is below the block's.
MeshCollider table(float height) {
    return {.name = "table",
            .vertices = {{-1, height, -1}, {1.3f, height, -1}, {1.3f, height, 1.3f}, {-1, height, 1.3f}},
            .triangles = {{0, 2, 1}, {0, 3, 2}},
            .thickness = 0.01f};
}

// Impulses of each of `steps` steps after `before` others; all steps must be completed.
std::vector<Impulses> impulsesOf(test::Runner& runner, int before, int steps) {
    std::vector<Impulses> impulses;
    if (before > 0) runner.run(before);
    for (int s = 0; s < steps; ++s) {
        const Status status = runner.run(1);
        EXPECT_FALSE(status.isUndone);
        impulses.push_back(runner.simulation().forces(status.frame));
        EXPECT_TRUE(impulses.back().isFinished);
    }
    return impulses;
}

// Expects each impulse over dt to be `wanted` within `share`, and their mean within half of that.
template <typename Of>
void expectForce(const std::vector<Impulses>& all, double dt, const Vector& wanted, double share,
                 const Of& of, const char* what) {
    Vector mean = Vector::Zero();
    for (const Impulses& impulses : all) {
        const Vector force = test::toVector(of(impulses)) / dt;
        EXPECT_LE((force - wanted).norm(), share * wanted.norm()) << what << ": " << force.transpose();
        mean += force / static_cast<double>(all.size());
    }
    EXPECT_LE((mean - wanted).norm(), 0.5 * share * wanted.norm()) << what << ": " << mean.transpose();
}

constexpr double weightShare = 0.005;

Vector up(double force) {
    return {0, force, 0};
}

// Expects a weight on the carried side and its opposite on the carrier.
template <typename Carried, typename Carrier>
void expectWeight(const std::vector<Impulses>& all, double dt, double weight, const Carried& carried,
                  const Carrier& carrier) {
    expectForce(all, dt, up(weight), weightShare, carried, "what is carried");
    expectForce(all, dt, up(-weight), weightShare, carrier, "what carries");
}

Vector momentumOf(const Scene& scene, const std::vector<Vector>& v, const Body& body) {
    Vector momentum = Vector::Zero();
    for (std::uint32_t i = body.firstParticle; i < body.firstParticle + body.particleCount; ++i)
        if (scene.particles[i].inverseMass > 0) momentum += v[i] / double{scene.particles[i].inverseMass};
    return momentum;
}

} // namespace

TEST(Weight, OfABlockIsOnAPlane) {
    Scene scene = quiet();
    addBlock(scene, 0);
    scene.planes = {{.friction = 0.5f}, {.normal = {1, 0, 0}, .offset = -5}};
    test::Runner runner(scene, withForces());
    const auto all = impulsesOf(runner, 180, 20);
    const double weight = gravity * massOf(scene, scene.bodies[0]), dt = double{scene.dt};
    expectWeight(
        all, dt, weight, [](const Impulses& i) { return i.bodies[0].planes.linear; },
        [](const Impulses& i) { return i.planes[0].linear; });
    for (const Impulses& impulses : all) {
        EXPECT_EQ(impulses.planes[1].linear.x, 0);
        EXPECT_LT(test::toVector(impulses.bodies[0].contacts.linear).norm(),
                  1e-5 * weight * dt); // internal contacts cancel
    }
}

TEST(Weight, OfABlockIsOnABoxCollider) {
    Scene scene = quiet();
    addBlock(scene, 0);
    scene.colliders = {{.shape = ColliderShape::sphere, .radius = 0.1f, .pose = {.position = {5, 0, 0}}},
                       {.shape = ColliderShape::box,
                        .halfExtents = {1, 0.1f, 1},
                        .friction = 0.5f,
                        .pose = {.position = {0.15f, -0.1f, 0.15f}}}};
    for (const bool touches : {true, false}) { // with and without particle contacts
        SCOPED_TRACE(touches);
        for (Particle& particle : scene.particles) particle.radius = touches ? 0.05f : 0;
        test::Runner runner(scene, withForces());
        const auto all = impulsesOf(runner, 180, 20);
        const double weight = gravity * massOf(scene, scene.bodies[0]), dt = double{scene.dt};
        expectWeight(
            all, dt, weight, [](const Impulses& i) { return i.bodies[0].colliders.linear; },
            [](const Impulses& i) { return i.colliders[1].linear; });
        for (const Impulses& impulses : all) EXPECT_EQ(impulses.colliders[0].linear.y, 0);
    }
}

TEST(Weight, OfABlockIsOnAMesh) {
    Scene scene = quiet();
    addBlock(scene, 0.06f);
    addMeshCollider(scene, table(0));
    test::Runner runner(scene, withForces());
    const auto all = impulsesOf(runner, 180, 20);
    const double weight = gravity * massOf(scene, scene.bodies[0]), dt = double{scene.dt};
    expectWeight(
        all, dt, weight, [](const Impulses& i) { return i.bodies[0].contacts.linear; },
        [](const Impulses& i) { return i.bodies[1].contacts.linear; });
    for (const Impulses& impulses : all) // the block stands over the table's centre
        EXPECT_LT(test::toVector(impulses.bodies[1].contacts.angular).norm(), 0.01 * weight * dt * 0.3);
}

TEST(Weight, OfTwoBlocksIsOnThePlaneAndOfOneBetweenThem) {
    Scene scene = quiet();
    addBlock(scene, 0, "lower");
    addBlock(scene, 0.4f, "upper");
    scene.planes = {{.friction = 0.5f}};
    test::Runner runner(scene, withForces());
    const auto all = impulsesOf(runner, 240, 20);
    const double upper = gravity * massOf(scene, scene.bodies[1]), dt = double{scene.dt};
    expectWeight(
        all, dt, upper, [](const Impulses& i) { return i.bodies[1].contacts.linear; },
        [](const Impulses& i) { return i.bodies[0].contacts.linear; });
    expectForce(
        all, dt, up(2 * upper), weightShare, [](const Impulses& i) { return i.bodies[0].planes.linear; },
        "plane");
}

TEST(Weight, OfABlockOnABlockThatIsHeldIsOnTheHold) {
    Scene scene = quiet();
    addBlock(scene, 0, "lower");
    addBlock(scene, 0.4f, "upper");
    const Body& lower = scene.bodies[0];
    hold(scene, select(scene, lower, insideOf(Plane{.normal = {0, -1, 0}, .offset = -0.01f})).particles);
    NamedHold held{"floor", {}};
    for (const FixedConstraint& fixed : scene.fixed) held.particles.push_back(fixed.particle);
    ASSERT_EQ(held.particles.size(), 16u);
    scene.holds = {held};
    double lowerMass = massOf(scene, lower);
    for (const std::uint32_t i : held.particles) lowerMass -= 1 / double{scene.particles[i].inverseMass};
    test::Runner runner(scene, withForces());
    const auto all = impulsesOf(runner, 240, 20);
    const double weight = gravity * (massOf(scene, scene.bodies[1]) + lowerMass), dt = double{scene.dt};
    expectForce(
        all, dt, up(weight), weightShare, [](const Impulses& i) { return i.holds[0].linear; }, "hold");
    expectForce(
        all, dt, up(weight), weightShare, [](const Impulses& i) { return i.bodies[0].holds.linear; }, "body");
}

TEST(Weight, HangsOnItsHoldByHookesLaw) {
    constexpr float stiffness = 200, mass = 0.5f; // [N/m], [kg]
    Scene scene;
    scene.dampingTime = 5e-3f;
    addChain(scene, {.origin = {0, 1, 0}, .particles = 2, .length = 0.2f, .compliance = 1 / stiffness});
    scene.particles[1].inverseMass = 1 / mass;
    hold(scene, std::vector<std::uint32_t>{0});
    scene.holds = {{"hook", {0}}};
    test::Runner runner(scene, withForces());
    const auto all = impulsesOf(runner, 1200, 10);
    const double dt = double{scene.dt};
    const auto hook = [](const Impulses& i) { return i.holds[0].linear; };
    expectForce(all, dt, up(mass * gravity), weightShare, hook, "weight");
    const std::vector<Vector> x = runner.positions();
    const double length = (x[1] - x[0]).norm();
    expectForce(all, dt, up(double{stiffness} * (length - 0.2)), weightShare, hook, "Hooke");
}

TEST(Weight, OfAClothIsSharedByItsTwoPins) {
    Scene scene = test::sheet(8, 1e-4f);
    scene.damping = 1.5f; // takes 0.1 % of the weight: the speed that gravity adds in a substep is damped
    std::vector<std::uint32_t> pins;
    double mass = massOf(scene, scene.bodies[0]);
    const std::vector<float> inverseMass = inverseMasses(scene);
    for (std::uint32_t i = 0; i < inverseMass.size(); ++i)
        if (inverseMass[i] == 0) {
            pins.push_back(i);
            if (scene.particles[i].inverseMass > 0) mass -= 1 / double{scene.particles[i].inverseMass};
        }
    ASSERT_EQ(pins.size(), 2u);
    scene.holds = {{"left", {pins[0]}}, {"right", {pins[1]}}};
    test::Runner runner(scene, withForces());
    const auto all = impulsesOf(runner, 2400, 10);
    for (const Impulses& impulses : all) {
        const Vector left = test::toVector(impulses.holds[0].linear) / double{scene.dt},
                     right = test::toVector(impulses.holds[1].linear) / double{scene.dt};
        EXPECT_NEAR(left.y(), 0.5 * mass * gravity, weightShare * mass * gravity);
        EXPECT_NEAR(right.y(), 0.5 * mass * gravity, weightShare * mass * gravity);
        EXPECT_NEAR(left.x() + right.x(), 0, weightShare * mass * gravity);
        EXPECT_LT(left.x() * right.x(), 0); // they pull apart
    }
}

TEST(Weight, HangsOnATether) {
    Scene scene = test::particleAt({0, 0, 0});
    scene.damping = 2;
    scene.particles[0].inverseMass = 0.5f;
    scene.particles.push_back({.position = {0, 0.5f, 0}, .inverseMass = 0});
    scene.tethers = {{0, 1, 0.5f}};
    scene.bodies = {{"ball", 0, 1}};
    scene.holds = {{"hook", {1}}};
    test::Runner runner(scene, withForces(64));
    const auto all = impulsesOf(runner, 120, 10);
    const double dt = double{scene.dt}, weight = 2 * gravity;
    expectForce(
        all, dt, up(weight), weightShare, [](const Impulses& i) { return i.holds[0].linear; }, "hold");
    expectForce(
        all, dt, up(weight), weightShare, [](const Impulses& i) { return i.bodies[0].holds.linear; }, "body");
}

TEST(Weight, HangsOnAnAttachmentByHookesLaw) {
    Scene scene = test::particleAt({0, 0, 0});
    scene.damping = 3;
    scene.attachments = {{.particle = 0, .anchor = {0, 0, 0}, .compliance = 0.01f}};
    test::Runner runner(scene, withForces(64));
    const auto all = impulsesOf(runner, 900, 10);
    const auto pull = [](const Impulses& i) { return i.attachments[0].linear; };
    expectForce(all, double{scene.dt}, up(gravity), weightShare, pull, "weight");
    expectForce(all, double{scene.dt}, up(-runner.positions()[0].y() / 0.01), weightShare, pull, "Hooke");
}

TEST(Grabbed, FeelsItsStiffnessTimesTheStretch) {
    Scene scene = test::particleAt({0.1f, 1, 0.2f});
    addBlock(scene, 3); // not grabbed
    scene.particles[0].inverseMass = 0.5f;
    scene.bodies.push_back({"ball", 0, 1});
    Settings settings = withForces(8);
    settings.grabs = 2;
    test::Runner runner(scene, settings);
    const double mass = 2, dt = double{scene.dt};
    const Vec3 target = scene.particles[0].position;
    const std::array grabs{Grab{.particle = 0, .target = {NAN, 0, 0}}, // holds nothing
                           Grab{.particle = 0, .target = target}};
    Status status;
    for (int s = 0; s < 180; ++s)
        status = runner.step({.dt = scene.dt, .gravity = scene.gravity, .grabs = grabs});
    const Impulses impulses = runner.simulation().forces(status.frame);
    const Vector pull = test::toVector(impulses.grabs[1].linear) / dt;
    EXPECT_LE((pull - up(mass * gravity)).norm(), weightShare * mass * gravity) << pull.transpose();
    EXPECT_EQ(impulses.grabs[0].linear.y, 0);
    EXPECT_EQ(impulses.bodies[0].grabs.linear.y, 0);
    EXPECT_EQ(impulses.bodies[1].grabs.linear.y, impulses.grabs[1].linear.y);
    const double sunk = double{target.y} - runner.positions()[0].y();
    EXPECT_NEAR(pull.y(), 400 * mass * sunk, weightShare * pull.y());
}

TEST(Struck, PlanesAndCollidersFeelTheChangeOfMomentum) {
    for (const float restitution : {0.0f, 0.8f}) {
        SCOPED_TRACE(restitution);
        Scene scene = test::particleAt({0.4f, 0.3f, 0.1f}, {1, -6, 0.5f});
        scene.gravity = {0, 0, 0};
        scene.bodies = {{"ball", 0, 1}};
        scene.planes = {{.friction = 0.02f, .restitution = restitution}};
        scene.colliders = {{.shape = ColliderShape::box,
                            .halfExtents = {0.1f, 20, 2},
                            .friction = 0.3f,
                            .restitution = restitution,
                            .pose = {.position = {1, 0, 0}}}};
        test::Runner runner(scene, withForces(8));
        Vector before = runner.velocities()[0], onPlane = Vector::Zero(), onCollider = Vector::Zero();
        for (int s = 0; s < 60; ++s) {
            const Impulses impulses = impulsesOf(runner, 0, 1).front();
            const Vector after = runner.velocities()[0];
            const Vector planes = test::toVector(impulses.bodies[0].planes.linear),
                         colliders = test::toVector(impulses.bodies[0].colliders.linear);
            EXPECT_LE((after - before - planes - colliders).norm(), 1e-5);
            EXPECT_LE((planes + test::toVector(impulses.planes[0].linear)).norm(), 1e-6);
            EXPECT_LE((colliders + test::toVector(impulses.colliders[0].linear)).norm(), 1e-6);
            onPlane += planes;
            onCollider += colliders;
            before = after;
        }
        EXPECT_NEAR(onPlane.y(), 6 * (1 + double{restitution}), 0.01);
        EXPECT_LT(onCollider.x(), -0.1); // contact has begun
    }
}

TEST(Struck, TwoBlocksFeelOppositeImpulses) {
    Scene scene = test::weightless();
    scene.contacts = {.friction = 0.4f, .restitution = 0.5f};
    addBlock(scene, 0, "left");
    addBlock(scene, 0.13f, "right", 0.45f);
    for (std::uint32_t i = scene.bodies[1].firstParticle; i < scene.particles.size(); ++i)
        scene.particles[i].velocity = {-3, 0, 0};
    test::Runner runner(scene, withForces());
    std::vector<Vector> before = runner.velocities();
    double struck = 0;
    for (int s = 0; s < 20; ++s) {
        const Impulses impulses = impulsesOf(runner, 0, 1).front();
        const std::vector<Vector> after = runner.velocities();
        const Vector left = test::toVector(impulses.bodies[0].contacts.linear),
                     right = test::toVector(impulses.bodies[1].contacts.linear);
        EXPECT_LE((left + right).norm(), 1e-4 * (1 + left.norm()));
        for (const std::size_t b : {0, 1}) {
            const Body& body = scene.bodies[b];
            const Vector change = momentumOf(scene, after, body) - momentumOf(scene, before, body);
            EXPECT_LE((change - (b == 0 ? left : right)).norm(), 3e-4 * (1 + left.norm())) << s;
        }
        struck += right.x();
        before = after;
    }
    EXPECT_GT(struck, 0.5 * 3 * massOf(scene, scene.bodies[0])); // least value, for a plastic impact
}

TEST(Struck, AMeshFeelsTheChangeOfMomentumOfWhatIsFast) {
    for (const bool isDriven : {false, true}) {
        SCOPED_TRACE(isDriven);
        Scene scene = test::weightless();
        scene.particles = {test::ballAt({0.2f, 0.5f, 0.1f}, {3, -80, 1}, 2)};
        scene.bodies = {{"ball", 0, 1}};
        scene.contacts = {.friction = 0.2f};
        MeshCollider mesh = table(0);
        if (isDriven) mesh.path = {{0, {}}, {10, {.position = {0, 1, 0}}}};
        addMeshCollider(scene, mesh);
        MeshCollider other = table(-3); // without any contact
        other.name = "other";
        addMeshCollider(scene, other);
        test::Runner runner(scene, withForces(4));
        Vector before = runner.velocities()[0], ball = Vector::Zero();
        for (int s = 0; s < 30; ++s) {
            const Impulses impulses = impulsesOf(runner, 0, 1).front();
            const Vector after = runner.velocities()[0],
                         contacts = test::toVector(impulses.bodies[0].contacts.linear);
            EXPECT_LE((2 * (after - before) - contacts).norm(), 1e-4);
            EXPECT_LE((contacts + test::toVector(impulses.bodies[1].contacts.linear)).norm(), 1e-4);
            EXPECT_EQ(impulses.bodies[2].contacts.linear.y, 0);
            ball += contacts;
            before = after;
        }
        EXPECT_GT(ball.y(), 2 * 79.9);
    }
}

TEST(Friction, CarriesABlockOnAnIncline) {
    constexpr float angle = 20 * std::numbers::pi_v<float> / 180;
    Scene scene = quiet();
    addBlock(scene, 0);
    scene.gravity = {9.81f * std::sin(angle), -9.81f * std::cos(angle), 0};
    scene.planes = {{.friction = 0.8f}};
    test::Runner runner(scene, withForces());
    const auto all = impulsesOf(runner, 240, 20);
    const double mass = massOf(scene, scene.bodies[0]);
    expectForce(
        all, double{scene.dt}, -mass * test::toVector(scene.gravity), weightShare,
        [](const Impulses& i) { return i.bodies[0].planes.linear; }, "plane");
}

TEST(Torque, OfALeverIsItsArmTimesTheWeight) {
    Scene scene = quiet();
    addBlock(scene, 0);
    scene.colliders = {{.shape = ColliderShape::box,
                        .halfExtents = {2, 0.1f, 1},
                        .friction = 0.5f,
                        .pose = {.position = {-0.85f, -0.1f, 0.15f}}}};
    scene.planes = {{.offset = -3}};
    test::Runner runner(scene, withForces());
    auto all = impulsesOf(runner, 180, 10);
    const double weight = gravity * massOf(scene, scene.bodies[0]), dt = double{scene.dt};
    expectForce(
        all, dt, {0, 0, -weight}, weightShare, [](const Impulses& i) { return i.colliders[0].angular; },
        "lever of 1 m");
    scene.colliders.clear();
    scene.planes = {{.friction = 0.5f}};
    test::Runner onPlane(scene, withForces());
    all = impulsesOf(onPlane, 180, 10);
    expectForce(
        all, dt, {0.15 * weight, 0, -0.15 * weight}, weightShare,
        [](const Impulses& i) { return i.planes[0].angular; }, "about the plane's place");
    for (const Impulses& impulses : all) // at rest
        EXPECT_LT(test::toVector(impulses.bodies[0].planes.angular).norm(), 0.003 * weight * dt);
}

TEST(Torque, OnABodyIsTheChangeOfItsAngularMomentum) {
    Scene scene = test::weightless();
    addBlock(scene, 0);
    scene.attachments = {{.particle = 3, .anchor = {0.4f, 0.5f, -0.3f}, .compliance = 1e-2f}};
    test::Runner runner(scene, withForces());
    const auto spinOf = [&](const std::vector<Vector>& x, const std::vector<Vector>& v) {
        Vector middle = Vector::Zero(), spin = Vector::Zero();
        const double mass = massOf(scene, scene.bodies[0]);
        for (std::size_t i = 0; i < x.size(); ++i)
            middle += x[i] / double{scene.particles[i].inverseMass} / mass;
        for (std::size_t i = 0; i < x.size(); ++i)
            spin += (x[i] - middle).cross(v[i]) / double{scene.particles[i].inverseMass};
        return spin;
    };
    Vector given = Vector::Zero();
    for (const Impulses& impulses : impulsesOf(runner, 0, 4)) {
        given += test::toVector(impulses.bodies[0].holds.angular);
        EXPECT_EQ(impulses.bodies[0].holds.linear.x, impulses.attachments[0].linear.x);
    }
    const Vector spin = spinOf(runner.positions(), runner.velocities());
    EXPECT_GT(spin.norm(), 0.05);
    EXPECT_LE((given - spin).norm(), 0.02 * spin.norm()) << given.transpose() << " / " << spin.transpose();
}

// The solvers without particle contacts.
class ForcesOf : public testing::TestWithParam<Solver> {
protected:
    Settings settings(const Scene& scene) const {
        Settings result = withForces();
        result.solver = GetParam();
        result.iterations = result.solver == Solver::jacobi ? 8 : 2;
        EXPECT_TRUE(validate(scene, result).empty());
        return result;
    }
};

// With `jacobi` the particles are loose, because it keeps no forces of bodies with links.
TEST_P(ForcesOf, WhatStandsAreItsWeight) {
    struct Case {
        bool isOnPlane;
        float warmStart;
    };
    for (const auto [isOnPlane, warmStart] : {Case{true, 0.9f}, Case{true, 0}, Case{false, 0.9f}}) {
        SCOPED_TRACE(testing::Message() << isOnPlane << ' ' << warmStart);
        Scene scene = quiet();
        scene.damping = 1;
        scene.dampingTime = 0;
        addBlock(scene, 0);
        for (Particle& particle : scene.particles) particle.radius = 0;
        if (GetParam() == Solver::jacobi) {
            scene.distances.clear();
            scene.grids.clear();
        }
        if (isOnPlane)
            scene.planes = {{.friction = 0.5f, .restitution = 0.2f}, {.offset = -2}};
        else
            scene.colliders = {{.shape = ColliderShape::box,
                                .halfExtents = {1, 0.1f, 1},
                                .friction = 0.5f,
                                .pose = {.position = {0.15f, -0.1f, 0.15f}}}};
        Settings chosen = settings(scene);
        chosen.substeps = 16;
        chosen.warmStart = warmStart;
        test::Runner runner(scene, chosen);
        const auto all = impulsesOf(runner, 150, 10);
        const double weight = gravity * massOf(scene, scene.bodies[0]), dt = double{scene.dt};
        const auto body = [&](const Impulses& i) {
            return isOnPlane ? i.bodies[0].planes.linear : i.bodies[0].colliders.linear;
        };
        const auto below = [&](const Impulses& i) {
            return isOnPlane ? i.planes[0].linear : i.colliders[0].linear;
        };
        expectForce(all, dt, up(weight), weightShare, body, "body");
        expectForce(all, dt, up(-weight), weightShare, below, "what it stands on");
    }
}

TEST_P(ForcesOf, ABallAreTheChangeOfItsMomentum) {
    Scene scene = test::particleAt({0.4f, 0.3f, 0.1f}, {1, -6, 0.5f});
    scene.gravity = {0, 0, 0};
    scene.bodies = {{"ball", 0, 1}};
    scene.planes = {{.friction = 0.02f, .restitution = 0.8f}};
    scene.colliders = {{.shape = ColliderShape::box,
                        .halfExtents = {0.1f, 20, 2},
                        .friction = 0.3f,
                        .restitution = 0.5f,
                        .pose = {.position = {1, 0, 0}}}};
    test::Runner runner(scene, settings(scene));
    Vector before = runner.velocities()[0], onPlane = Vector::Zero(), onCollider = Vector::Zero();
    for (int s = 0; s < 60; ++s) {
        const Impulses impulses = impulsesOf(runner, 0, 1).front();
        const Vector after = runner.velocities()[0];
        const Vector planes = test::toVector(impulses.bodies[0].planes.linear),
                     colliders = test::toVector(impulses.bodies[0].colliders.linear);
        EXPECT_LE((after - before - planes - colliders).norm(), 2e-5) << s;
        onPlane += planes;
        onCollider += colliders;
        before = after;
    }
    EXPECT_NEAR(onPlane.y(), 6 * 1.8, 0.01);
    EXPECT_LT(onCollider.x(), -0.1);
}

TEST_P(ForcesOf, WhatHangsAreItsWeight) {
    Scene scene;
    scene.damping = 3;
    for (const float x : {0.0f, 1.0f, 2.0f})
        scene.particles.push_back({.position = {x, 0, 0}, .inverseMass = 0.5f});
    scene.particles.push_back({.position = {1, 0.5f, 0}, .inverseMass = 0});
    scene.attachments = {{.particle = 0, .anchor = {0, 0, 0}, .compliance = 0.01f}};
    scene.tethers = {{1, 3, 0.5f}};
    scene.holds = {{"hook", {3}}};
    Settings chosen = settings(scene);
    chosen.grabs = 1;
    test::Runner runner(scene, chosen);
    const std::array grabs{Grab{.particle = 2, .target = {2, 0, 0}}};
    Status status;
    for (int s = 0; s < 600; ++s)
        status = runner.step({.dt = scene.dt, .gravity = scene.gravity, .grabs = grabs});
    const Impulses impulses = runner.simulation().forces(status.frame);
    const double weight = 2 * gravity * double{scene.dt};
    EXPECT_NEAR(double{impulses.attachments[0].linear.y}, weight, weightShare * weight);
    EXPECT_NEAR(double{impulses.holds[0].linear.y}, weight, weightShare * weight);
    EXPECT_NEAR(double{impulses.grabs[0].linear.y}, weight, weightShare * weight);
}

TEST_P(ForcesOf, ChangeNoMotion) {
    for (const test::NamedScene& named : test::allScenes()) {
        Settings with = withForces(6);
        with.solver = GetParam();
        with.grabs = 1;
        with.iterations = 2;
        if (named.scene.particles.empty() || !validate(named.scene, with).empty()) continue;
        SCOPED_TRACE(named.name);
        Settings without = with;
        without.keepsForces = false;
        EXPECT_EQ(test::hashOfRun(named.scene, with, 10), test::hashOfRun(named.scene, without, 10));
    }
}

INSTANTIATE_TEST_SUITE_P(, ForcesOf, testing::Values(Solver::jacobi, Solver::gaussSeidel),
                         [](const auto& solver) { return std::string(solverName(solver.param)); });
