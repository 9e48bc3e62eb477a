// Cases 16 to 18, 20 and 21: particles in contact with particles and planes, solved by `split`.
#include "cases/cases.hpp"
#include "common/layout.h"
#include "sim/collision/contact_scenes.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

using namespace sinew;
using namespace sinew::sim;
using namespace sinew::test;
using Eigen::Vector3d;

namespace {

constexpr double g = 9.81, radius = double{ballRadius};

// A ball 1 m above a plane or above a fixed ball.
Scene fallingBall(bool ontoBall, float restitution) {
    Scene scene;
    scene.particles = {ballAt({0, 1 + ballRadius, 0})};
    if (ontoBall) {
        scene.particles.push_back(fixedBallAt({0, -ballRadius, 0}));
        scene.contacts.restitution = restitution;
    } else {
        scene.planes = {{.restitution = restitution}};
    }
    return scene;
}

// A ball on a much larger fixed ball, `degrees` away from its top. The size is limited by float32: the
// overlap that carries the ball in a substep is 3e-5 m, and float32 rounds distances of 10 m by 1e-6 m.
struct Hill {
    double size = 2;                                            // radius [m]
    double degrees = 0, speed = 0, friction = 0.5, holding = 0; // static friction, where larger than friction

    double reach() const { return size + radius; }
    double angle() const { return degrees * std::numbers::pi / 180; }

    Scene scene() const {
        const double s = std::sin(angle()), c = std::cos(angle());
        const auto vector = [](double x, double y) {
            return Vec3{static_cast<float>(x), static_cast<float>(y), 0};
        };
        // The contact lies at the origin, where float32 is most precise.
        Particle hill = fixedBallAt(vector(-reach() * s, -reach() * c));
        hill.radius = static_cast<float>(size);
        Scene scene;
        scene.particles = {ballAt({}, vector(speed * c, -speed * s)), hill};
        scene.contacts.friction = static_cast<float>(friction);
        scene.contacts.staticFriction = static_cast<float>(holding);
        return scene;
    }

    // Distance that Coulomb friction predicts until `time` or until the stop [m].
    double wayDown(double time) const {
        double at = angle(), v = speed, way = 0;
        constexpr double dt = 1e-5;
        for (double t = 0; t < time && v >= 0; t += dt) {
            const double normal = g * std::cos(at) - v * v / reach();
            v += dt * (g * std::sin(at) - friction * normal);
            way += dt * v;
            at += dt * v / reach();
        }
        return way;
    }

    // Distance on the device with 10 substeps a step [m].
    double wayIn(int steps) const {
        CaseRunner runner(scene(), {.substeps = 10});
        const Vector3d start = runner.positions()[0], middle = runner.positions()[1];
        runner.run(steps);
        const Vector3d a = (start - middle).normalized(), b = (runner.positions()[0] - middle).normalized();
        return reach() * std::asin(a.cross(b).norm());
    }
};

// Newton's cradle: balls on rigid strings of 1 m, the first `raised` of them pulled aside.
Scene cradle(std::uint32_t balls, std::uint32_t raised) {
    Scene scene;
    scene.contacts.restitution = 1;
    for (std::uint32_t i = 0; i < balls; ++i) {
        const float x = static_cast<float>(2 * i) * ballRadius, angle = i < raised ? 0.5f : 0;
        scene.particles.push_back(ballAt({x - std::sin(angle), 1 - std::cos(angle), 0}));
    }
    for (std::uint32_t i = 0; i < balls; ++i) {
        scene.particles.push_back(
            {.position = {static_cast<float>(2 * i) * ballRadius, 1, 0}, .inverseMass = 0});
        scene.distances.push_back({.a = i, .b = balls + i, .restLength = 1});
    }
    return scene;
}

// A block of side^3 particles on a bed of fixed particles, each exactly above one; gravity is tilted.
Scene blockOnBed(std::uint32_t cells, double degrees, float friction) {
    constexpr float spacing = 2 * ballRadius;
    Scene scene = block(cells, spacing, 1e6f, spacing);
    const double angle = degrees * std::numbers::pi / 180;
    scene.gravity = {static_cast<float>(g * std::sin(angle)), static_cast<float>(-g * std::cos(angle)), 0};
    scene.damping = 30; // prevents an overshoot when gravity sets in
    for (std::uint32_t z = 0; z <= cells; ++z)
        for (std::uint32_t x = 0; x <= 2 * cells; ++x)
            scene.particles.push_back(
                fixedBallAt({static_cast<float>(x) * spacing, 0, static_cast<float>(z) * spacing}));
    for (Particle& particle : scene.particles) particle.radius = ballRadius;
    scene.contacts.friction = friction;
    return scene;
}

// Force on particle `at` [N]: the sum of lambda / h^2 over the contacts found by the last substep.
Vector3d contactForce(Runner& runner, const Scene& scene, std::uint32_t at, double h) {
    std::vector<layout::vec4> touching;
    const auto& buffers = runner.simulation().program().buffers;
    for (std::uint32_t b = 0; b < buffers.size(); ++b)
        if (buffers[b].label == "contacts.touching")
            touching = queue().download<layout::vec4>(runner.simulation().view({b}));
    const auto xOf = [&](std::uint32_t i) {
        return Vector3d(double{touching[i].x}, double{touching[i].y}, double{touching[i].z});
    };
    Vector3d force = Vector3d::Zero();
    for (std::uint32_t j = 0; j < scene.particles.size(); ++j) {
        const Vector3d d = xOf(at) - xOf(j);
        const double depth = 2 * radius - d.norm();
        if (j == at || depth <= 0) continue;
        force += depth / (double{touching[at].w} + double{touching[j].w}) / (h * h) * d.normalized();
    }
    return force;
}

} // namespace

// 600 substeps a second. Checks the height of each rebound, and that the ball rests after the last bounce.
TEST(Case16Restitution, OfABallOnAPlaneAndOnAFixedParticleIsTheSquareOfTheHeight) {
    for (const bool ontoBall : {false, true})
        for (const double restitution : {0.0, 0.5, 0.9, 1.0}) {
            CaseRunner runner(fallingBall(ontoBall, static_cast<float>(restitution)), {.substeps = 10});
            runner.run(27); // the fall takes 0.4515 s
            double apex = 0;
            for (int step = 27; step < 80; ++step) {
                runner.run(1);
                apex = std::max(apex, runner.positions()[0].y() - radius);
            }
            const double expected = restitution * restitution;
            EXPECT_NEAR(apex, expected, 0.02 * std::max(expected, 0.05)) << "e = " << restitution;
            std::printf("%s, e = %.1f: rebound to %.4f m (%.4f)\n", ontoBall ? "ball" : "plane", restitution,
                        apex, expected);
            if (restitution > 0.5) continue;
            runner.run(90); // the bounces with restitution 0.5 end after 1.35 s
            EXPECT_NEAR(runner.positions()[0].y(), radius, 1e-4);
            EXPECT_LE(runner.velocities()[0].norm(), 2 * g / 600);
        }
}

TEST(Case17Incline, OfAParticleOnAParticleHoldsToTheFrictionAngle) {
    const Hill steep{.degrees = 28};
    const double creep = Hill{.degrees = 25.5}.wayIn(120), slid = steep.wayIn(60),
                 expected = steep.wayDown(1);
    std::printf("25.5 degrees: %.2e m in 2 s; 28 degrees: %.4f m (%.4f)\n", creep, slid, expected);
    EXPECT_LE(creep, 2e-4) << "1e-4 m/s; sticks below 26.57 degrees";
    EXPECT_NEAR(slid / expected, 1, 0.01);
}

// At 30 degrees, static friction 0.6 (30.96 degrees) holds a ball that kinetic friction 0.5 lets slide.
TEST(Case17Incline, OfAParticleThatRestsHoldsFasterThanOfOneThatSlides) {
    const Hill rests{.degrees = 30, .holding = 0.6}, slides{.degrees = 30, .speed = 0.3, .holding = 0.6},
        steep{.degrees = 32, .holding = 0.6};
    const double creep = rests.wayIn(120), slid = slides.wayIn(60) / slides.wayDown(1),
                 loose = steep.wayIn(60) / steep.wayDown(1);
    std::printf(
        "static 0.6, 30 degrees: %.2e m in 2 s; from 0.3 m/s %.4f of Coulomb's way; 32 degrees: %.4f\n",
        creep, slid, loose);
    EXPECT_LE(creep, 2e-4);
    EXPECT_NEAR(slid, 1, 0.01);
    EXPECT_NEAR(loose, 1, 0.01);
}

TEST(Case17Incline, OfABodyOnABedOfParticlesHoldsToTheFrictionAngle) {
    const auto wayAt = [](double degrees) {
        const Scene scene = blockOnBed(3, degrees, 0.5f);
        CaseRunner runner(scene, {.substeps = 32});
        runner.run(30); // the oscillation caused by the onset of gravity decays
        const auto before = runner.positions();
        runner.run(60);
        double way = 0;
        const auto after = runner.positions();
        for (std::size_t i = 0; i < 64; ++i) way += (after[i].x() - before[i].x()) / 64;
        std::printf("bed at %.2f degrees: %.2e m in 1 s\n", degrees, way);
        return way;
    };
    EXPECT_LE(wayAt(25.57), 1e-4) << "1e-4 m/s";
    EXPECT_GE(wayAt(27.57), 5e-3);
}

// The hill is nearly flat: on a slope close to the friction angle, the distance is too sensitive to be
// checked.
TEST(Case18SlidingStop, OfAParticleOnAParticleIsWhereFrictionSays) {
    const Hill hill{.size = 10, .speed = 2};
    const double expected = hill.wayDown(10), way = hill.wayIn(90);
    std::printf("stops after %.4f m (%.4f)\n", way, expected);
    EXPECT_NEAR(way / expected, 1, 0.01);
}

// A column of four balls on a fixed ball. Measures the force and the overlap of each contact.
TEST(Case20RestingStack, CarriesItsWeightWithinHalfAPercent) {
    constexpr std::uint32_t count = 4, substeps = 32;
    Scene scene;
    scene.particles = {fixedBallAt({})};
    for (std::uint32_t i = 1; i <= count; ++i)
        scene.particles.push_back(ballAt({0, static_cast<float>(2 * i) * ballRadius, 0}));
    Runner runner(scene, {.substeps = substeps});
    runner.run(120);
    const double h = double{scene.dt} / substeps, force = -contactForce(runner, scene, 0, h).y();
    std::printf("column: %.4f N (%.4f), deepest %.5f r\n", force, count * g, deepestOf(runner.positions()));
    EXPECT_NEAR(force / (count * g), 1, 0.005);
    EXPECT_LE(deepestOf(runner.positions()), 0.01) << "[radii]";
    CaseRunner(scene, {.substeps = substeps}).run(10); // runs in reversed order, too
}

TEST(Case20RestingStack, OfABallOnThreeCarriesItsWeightWithinHalfAPercent) {
    const double side = 2 * radius, out = side / std::sqrt(3.0);
    Scene scene;
    for (int i = 0; i < 3; ++i) {
        const double angle = 2 * std::numbers::pi * i / 3;
        scene.particles.push_back(fixedBallAt(
            {static_cast<float>(out * std::cos(angle)), 0, static_cast<float>(out * std::sin(angle))}));
    }
    scene.particles.push_back(ballAt({0, static_cast<float>(side * std::sqrt(2.0 / 3)), 0}));
    Runner runner(scene, {.substeps = 32});
    runner.run(60);
    const Vector3d force = contactForce(runner, scene, 3, double{scene.dt} / 32);
    std::printf("on three: %.4f N (%.4f)\n", force.y(), g);
    EXPECT_NEAR(force.y() / g, 1, 0.005);
    EXPECT_LE(std::hypot(force.x(), force.z()), 0.005 * g);
    CaseRunner(scene, {.substeps = 32}).run(10);
}

TEST(Case21ElasticCollision, ExchangesVelocitiesAndKeepsMomentumAndEnergy) {
    for (const float mass : {1.0f, 10.0f})
        for (const float restitution : {1.0f, 0.5f}) {
            Scene scene = weightless();
            scene.contacts.restitution = restitution;
            scene.particles = {ballAt({-0.2f, 0, 0}, {2, 0, 0}), ballAt({0.1f, 0, 0}, {}, mass)};
            CaseRunner runner(scene, {.substeps = 16});
            const double before = kineticEnergy(scene, runner.velocities());
            runner.run(30);
            const auto v = runner.velocities();
            const double m = double{mass}, e = double{restitution}, common = 2 / (1 + m);
            std::printf("mass %g, e %g: %.6f and %.6f m/s\n", m, e, v[0].x(), v[1].x());
            EXPECT_NEAR(v[0].x(), common - e * m * 2 / (1 + m), 1e-5);
            EXPECT_NEAR(v[1].x(), common + e * 2 / (1 + m), 1e-5);
            EXPECT_NEAR(momentumOf(scene, v).x(), 2, 2e-6);
            const double expected = before * (1 + e * e * m) / (1 + m);
            EXPECT_NEAR(kineticEnergy(scene, v) / expected, 1, 1e-4);
        }
}

// A row of balls in contact, struck at its end. One gather pass cannot resolve the order of the impacts, but
// it keeps momentum and gains no energy.
TEST(Case21ElasticCollision, OfARowKeepsMomentumAndGainsNoEnergy) {
    Scene scene = weightless();
    scene.contacts.restitution = 1;
    for (int i = 0; i < 5; ++i)
        scene.particles.push_back(ballAt({static_cast<float>(2 * i) * ballRadius, 0, 0}));
    scene.particles.push_back(ballAt({-0.3f, 0, 0}, {2, 0, 0}));
    CaseRunner runner(scene, {.substeps = 16});
    double most = 0;
    for (int step = 0; step < 40; ++step) {
        runner.run(1);
        most = std::max(most, kineticEnergy(scene, runner.velocities()));
    }
    const auto v = runner.velocities();
    std::printf("row: kinetic energy 2 to %.4f J (at most %.6f), last ball %.3f m/s\n",
                kineticEnergy(scene, v), most, v[4].x());
    EXPECT_NEAR(momentumOf(scene, v).x(), 2, 4e-6);
    EXPECT_LE(most, 2 * (1 + 1e-5));
    EXPECT_GE(kineticEnergy(scene, v), 0.5);
}

// Newton's cradle: balls on strings of 1 m that just touch; the first `raised` are released from 0.5 rad. The
// same number of balls leaves at the other end with nearly all of the energy. A substep passes the impact on
// by one ball.
TEST(Case21ElasticCollision, OfACradleLetsAsManyBallsGoAsStrikeIt) {
    constexpr std::uint32_t balls = 7;
    for (const std::uint32_t substeps : {16u, 32u})
        for (const std::uint32_t raised : {1u, 2u, 4u}) {
            const Scene scene = cradle(balls, raised);
            CaseRunner runner(scene, {.substeps = substeps});
            const auto energyOf = [&](std::uint32_t first) {
                const auto x = runner.positions(), v = runner.velocities();
                double energy = 0;
                for (std::uint32_t i = first; i < balls; ++i)
                    energy += 0.5 * v[i].squaredNorm() + g * x[i].y();
                return energy;
            };
            const double before = energyOf(0);
            double most = before;
            for (int step = 0; step < 36; ++step) {
                runner.run(1);
                most = std::max(most, energyOf(0));
            }
            const double after = energyOf(0), leaving = energyOf(balls - raised);
            double slowest = 10, staying = 0;
            const auto v = runner.velocities();
            for (std::uint32_t i = 0; i < balls; ++i)
                if (i < balls - raised)
                    staying = std::max(staying, v[i].norm());
                else
                    slowest = std::min(slowest, v[i].norm());
            std::printf(
                "cradle, %2u substeps, %u of %u: %.2f %% of the energy left, %.2f %% leave with, slowest "
                "at %.3f m/s, others at most at %.4f m/s; never more than %.6f of the energy\n",
                substeps, raised, balls, 100 * after / before, 100 * leaving / before, slowest, staying,
                most / before);
            EXPECT_GE(leaving, 0.999 * before);
            EXPECT_LE(staying, 0.005) << "[m/s]";
            EXPECT_GE(slowest, 1.45) << "[m/s]";
            EXPECT_LE(most, before * (1 + 1e-4));
        }
}

// Five seconds hold at least five impacts. Shorter substeps lose less energy, and none gains any.
TEST(Case21ElasticCollision, OfACradleGainsNothingInFiveSeconds) {
    constexpr std::uint32_t balls = 5;
    std::vector<double> lost;
    for (const std::uint32_t substeps : {8u, 16u}) {
        const Scene scene = cradle(balls, 1);
        CaseRunner runner(scene, {.substeps = substeps});
        const auto energyOf = [&] {
            double energy = kineticEnergy(scene, runner.velocities());
            const auto x = runner.positions();
            for (std::uint32_t i = 0; i < balls; ++i) energy += g * x[i].y();
            return energy;
        };
        const double before = energyOf();
        double most = before;
        for (int step = 0; step < 300; ++step) {
            runner.run(1);
            most = std::max(most, energyOf());
        }
        lost.push_back(1 - energyOf() / before);
        std::printf("cradle, %2u substeps: %.2f %% of the energy lost in 5 s, never more than %.6f\n",
                    substeps, 100 * lost.back(), most / before);
        EXPECT_LE(most, before * (1 + 1e-3));
    }
    EXPECT_LE(lost[0], 0.2);
    EXPECT_LE(lost[1], lost[0]);
}

// Balls in a box without gravity. A collision of two keeps its energy. A collision of three within one
// substep loses energy, less in shorter substeps.
TEST(Case21ElasticCollision, OfManyInABoxGainsNoEnergyAndLosesLessInShorterSubsteps) {
    Scene scene = weightless();
    addBalls(scene, 5, 0.13f, 0.01f);
    disturb(scene, 0, 2);
    scene.contacts.restitution = 1;
    for (const float side : {-1.0f, 1.0f})
        for (const Vec3 axis : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}})
            scene.planes.push_back(
                {.normal = {side * axis.x, side * axis.y, side * axis.z}, .offset = -0.4f, .restitution = 1});
    std::vector<double> lost;
    for (const std::uint32_t substeps : {16u, 64u}) {
        CaseRunner runner(scene, {.substeps = substeps});
        double last = kineticEnergy(scene, runner.velocities());
        const double first = last;
        for (int step = 0; step < 30; ++step) {
            runner.run(1);
            const double now = kineticEnergy(scene, runner.velocities());
            ASSERT_LE(now, last * (1 + 1e-5)) << "step " << step;
            last = now;
        }
        lost.push_back(1 - last / first);
        std::printf("box, %u substeps: %.1f %% of the energy lost in 0.5 s\n", substeps, 100 * lost.back());
    }
    EXPECT_LE(lost[0], 0.25);
    EXPECT_LE(lost[1], 0.5 * lost[0]);
}

// A pair has the geometric mean of both frictions and the larger restitution.
TEST(Surfaces, OfTwoParticlesDecideTogether) {
    const auto wayWith = [](float friction) { // friction of one ball; the other has 0.4
        Scene scene = Hill{.degrees = 28}.scene();
        scene.contacts.surfaces = {{.friction = 0.4f}, {.friction = friction}};
        scene.particles[0].surface = 1;
        scene.particles[1].surface = 2;
        CaseRunner runner(scene, {.substeps = 10});
        runner.run(60);
        return runner.positions()[0].norm();
    };
    EXPECT_LE(wayWith(0.9f), 1e-4) << "0.6 holds at 28 degrees";
    const Hill smoother{.degrees = 28, .friction = std::sqrt(0.4 * 0.5)};
    EXPECT_NEAR(wayWith(0.5f) / smoother.wayDown(1), 1, 0.03);
    Scene resting = smoother.scene(); // 0.6 holds, 0.45 does not
    resting.contacts.surfaces = {{.friction = 0.4f}, {.friction = 0.5f, .staticFriction = 0.9f}};
    for (std::uint32_t i = 0; i < 2; ++i) resting.particles[i].surface = i + 1;
    CaseRunner still(resting, {.substeps = 10});
    still.run(60);
    EXPECT_LE(still.positions()[0].norm(), 1e-4) << "as much as friction where there is none";

    Scene scene = weightless();
    scene.contacts.surfaces = {{.restitution = 0.25f}, {.restitution = 0.75f}};
    scene.particles = {ballAt({-0.2f, 0, 0}, {2, 0, 0}), ballAt({0.1f, 0, 0})};
    scene.particles[0].surface = 1;
    scene.particles[1].surface = 2;
    CaseRunner runner(scene, {.substeps = 16});
    runner.run(30);
    EXPECT_NEAR((runner.velocities()[1] - runner.velocities()[0]).x(), 0.75 * 2, 1e-4);
}

TEST(Surfaces, ThatAreOneCompileToConstants) {
    Scene scene = fallingBall(true, 0.5f);
    scene.contacts.friction = 0.3f;
    const auto has = [&](const char* label) {
        const StepProgram program = compile(scene, {.substeps = 2});
        return std::ranges::any_of(program.buffers, [&](const BufferSpec& b) { return b.label == label; });
    };
    EXPECT_FALSE(has("contacts.surfaces"));
    EXPECT_TRUE(has("contacts.bouncing"));
    scene.contacts.surfaces = {{}};
    EXPECT_FALSE(has("contacts.surfaces")) << "nobody has it";
    for (Particle& particle : scene.particles) particle.surface = 1;
    EXPECT_FALSE(has("contacts.surfaces")) << "all have it";
    EXPECT_FALSE(has("pairs.memory"));
    EXPECT_FALSE(has("contacts.bouncing")) << "no rebound, no pass";
    scene.particles[1].surface = 0;
    EXPECT_TRUE(has("contacts.surfaces"));
}
