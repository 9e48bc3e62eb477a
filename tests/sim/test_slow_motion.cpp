// Tests of steady motion by less than the spacing of float32 numbers in a substep.
#include "sim/compile/compile.hpp"
#include "sim/model/rounding.hpp"
#include "sim/runner.hpp"
#include "sim/scenes.hpp"
#include "sinew/bodies.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

using namespace sinew;
using namespace sinew::sim;

namespace {

constexpr float speeds[] = {0.001f, 0.01f, 0.1f}; // [m/s]
constexpr int steps = 20;
constexpr double duration = steps / 60.0; // [s]

class SlowMotion : public testing::TestWithParam<Solver> {
protected:
    Settings settings(std::uint32_t substeps) const { return {.solver = GetParam(), .substeps = substeps}; }
};

// One particle for each speed, along x and z, at distance x from the origin along all axes, without gravity.
Scene freeParticles(float x, float radius = 0) {
    Scene scene{.name = "slow", .gravity = {}};
    for (std::size_t i = 0; i < std::size(speeds); ++i)
        scene.particles.push_back({.position = {x, -x + static_cast<float>(i), x},
                                   .velocity = {speeds[i], 0, -speeds[i]},
                                   .radius = radius});
    return scene;
}

// Expects each free particle to move by speed x duration along both axes, up to the rounding of its final
// position.
void expectWays(const Scene& scene, const Settings& settings, const std::string& what) {
    test::Runner runner(scene, settings);
    runner.run(steps);
    const double rounded = 0.5 * roundingOf(scene).step;
    const std::vector<Eigen::Vector3d> x = runner.positions();
    for (std::size_t i = 0; i < std::size(speeds); ++i) {
        const double right = double{speeds[i]} * duration, most = 0.01 * right + rounded;
        EXPECT_NEAR(x[i].x() - double{scene.particles[i].position.x}, right, most) << what << ", x";
        EXPECT_NEAR(x[i].z() - double{scene.particles[i].position.z}, -right, most) << what << ", z";
    }
}

// Displacement of the centre of mass along x [m].
double meanWay(const Scene& scene, const test::Runner& runner) {
    double way = 0;
    const std::vector<Eigen::Vector3d> x = runner.positions();
    for (std::size_t i = 0; i < x.size(); ++i)
        way += (x[i].x() - double{scene.particles[i].position.x}) / double{scene.particles[i].inverseMass};
    return way / test::massOf(scene);
}

Scene moving(Scene scene, float speed) {
    for (Particle& particle : scene.particles) particle.velocity = {speed, 0, 0};
    return scene;
}

Scene shifted(Scene scene, float x) {
    for (Particle& particle : scene.particles) particle.position.x += x;
    return scene;
}

// Displacement [m] of a body that moves along x as a whole.
double wayOf(const Scene& body, float speed, const Settings& settings) {
    const Scene scene = moving(body, speed);
    test::Runner runner(scene, settings);
    runner.run(steps);
    return meanWay(scene, runner);
}

// Small angle [rad] by which particles have rotated about the y axis through their centre.
double turnOf(const Scene& scene, const test::Runner& runner) {
    const std::vector<Eigen::Vector3d> x = runner.positions();
    Eigen::Vector3d begin = Eigen::Vector3d::Zero(), end = begin;
    for (std::size_t i = 0; i < x.size(); ++i) {
        begin += test::toVector(scene.particles[i].position) / static_cast<double>(x.size());
        end += x[i] / static_cast<double>(x.size());
    }
    double moment = 0, inertia = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        Eigen::Vector3d r = test::toVector(scene.particles[i].position) - begin;
        r.y() = 0;
        moment += r.cross(x[i] - end).y();
        inertia += r.squaredNorm();
    }
    return moment / inertia;
}

Scene empty() {
    return {.name = "slow", .gravity = {}};
}

Scene chain(float x) {
    Scene scene = empty();
    addChain(scene, {.origin = {x, 0, 0}, .particles = 8, .length = 0.35f});
    return scene;
}

Scene cloth(float x) {
    Scene scene = empty();
    addCloth(scene, {.origin = {x, 0, 0}, .size = {6, 6}, .spacing = 0.05f});
    return scene;
}

Scene voxels(float x) {
    Scene scene = empty();
    addLattice(scene, {.origin = {x, 0, 0}, .cells = {3, 3, 3}, .spacing = 0.05f, .youngModulus = 1e5f});
    return scene;
}

} // namespace

TEST_P(SlowMotion, OfFreeParticlesIsExactAtEveryDistanceAndNumberOfSubsteps) {
    for (const float x : {1.0f, 15.0f, 100.0f})
        for (const std::uint32_t substeps : {4u, 32u, 256u})
            expectWays(freeParticles(x), settings(substeps),
                       std::to_string(x) + " m, " + std::to_string(substeps) + " substeps");
}

TEST_P(SlowMotion, OfAFreeParticleIsExactBesidePlanesAndColliders) {
    for (const std::uint32_t substeps : {4u, 256u}) {
        Scene scene = freeParticles(15);
        scene.planes = {{.normal = {0, 1, 0}, .offset = -100}};
        scene.colliders = {{.radius = 1}};
        expectWays(scene, settings(substeps), std::to_string(substeps) + " substeps");
    }
}

TEST_P(SlowMotion, OnAPlaneOrAColliderWithoutFrictionIsExact) {
    for (const bool isPlane : {true, false})
        for (const std::uint32_t substeps : {4u, 256u}) {
            Scene scene = freeParticles(15);
            scene.gravity = {0, -9.81f, 0};
            for (Particle& particle : scene.particles) particle.position.y = 0;
            if (isPlane)
                scene.planes = {{.normal = {0, 1, 0}}};
            else
                scene.colliders = {{.shape = ColliderShape::box,
                                    .halfExtents = {40, 1, 40},
                                    .pose = {.position = {0, -1, 0}}}};
            expectWays(scene, settings(substeps),
                       (isPlane ? "plane, " : "collider, ") + std::to_string(substeps) + " substeps");
        }
}

TEST_P(SlowMotion, OfBodiesIsExact) {
    const std::pair<const char*, Scene (*)(float)> bodies[] = {
        {"chain", chain}, {"cloth", cloth}, {"voxels", voxels}};
    for (const auto& [name, body] : bodies)
        for (const auto& [x, substeps] : {std::pair{1.0f, 4u}, {15.0f, 4u}, {15.0f, 32u}})
            for (const float speed : {0.001f, 0.1f})
                EXPECT_NEAR(wayOf(body(x), speed, settings(substeps)), double{speed} * duration,
                            0.01 * double{speed} * duration)
                    << name << " at " << x << " m, " << substeps << " substeps";
}

TEST_P(SlowMotion, OfATenthOfAMillimetreASecondIsExactWithManySubsteps) {
    for (const auto& [x, substeps] : {std::pair{15.0f, 1000u}, {50.0f, 256u}}) {
        const Scene scene = test::particleAt({x, -x, 0});
        EXPECT_NEAR(wayOf(scene, 1e-4f, settings(substeps)), 1e-4 * duration,
                    1e-6 * duration + 0.5 * roundingOf(scene).step)
            << x << " m, " << substeps << " substeps";
    }
}

TEST_P(SlowMotion, OfWhatBeginsToFallIsExact) {
    const Scene scene = test::particleAt({0, 50, 0});
    test::Runner runner(scene, settings(1000));
    runner.run(6);
    const double fallen = 0.5 * 9.81 * 0.01;
    EXPECT_NEAR(50 - runner.positions()[0].y(), fallen, 1e-4 * fallen);
}

TEST_P(SlowMotion, OfABodyThatTurnsIsExact) {
    Scene scene = voxels(15);
    for (Particle& particle : scene.particles) {
        const Vec3& x = particle.position;
        particle.velocity = {0.01f * (x.z - 0.075f), 0, -0.01f * (x.x - 15.075f)}; // 0.01 rad/s
    }
    test::Runner runner(scene, settings(32));
    runner.run(steps);
    EXPECT_NEAR(turnOf(scene, runner), 0.01 * duration, 1e-4 * duration);
}

TEST_P(SlowMotion, ThatIsDampedEndsWhereItShould) {
    Scene scene = chain(15);
    scene.damping = 2;
    const double right = 0.01 * (1 - std::exp(-2 * duration)) / 2;
    EXPECT_NEAR(wayOf(scene, 0.01f, settings(64)), right, 0.01 * right);
}

TEST_P(SlowMotion, GoesOnFromASavedStateWithTheSameBits) {
    test::Runner runner(freeParticles(15), settings(64));
    runner.run(7);
    const test::Runner::Saved saved = runner.save();
    runner.run(5);
    const std::uint64_t whole = runner.stateHash();
    runner.load(saved);
    runner.run(5);
    EXPECT_EQ(runner.stateHash(), whole);
}

TEST_P(SlowMotion, BeginsAnewWithTheSameBits) {
    test::Runner runner(freeParticles(15), settings(64));
    runner.run(5);
    const std::uint64_t first = runner.stateHash();
    runner.reset();
    runner.run(5);
    EXPECT_EQ(runner.stateHash(), first);
}

// Remainders are valid only for the positions of their own solver.
TEST_P(SlowMotion, TakesNoRemaindersOverFromAnotherSolver) {
    const Scene scene = freeParticles(100);
    const Solver other = GetParam() == Solver::split ? Solver::gaussSeidel : Solver::split;
    test::Runner from(scene, {.solver = other, .substeps = 64}), to(scene, settings(64));
    from.run(7);
    to.run(3);
    to.takeOver(from);
    Scene now = scene;
    const auto x = from.positions(), v = from.velocities();
    for (std::size_t i = 0; i < x.size(); ++i) {
        now.particles[i].position = test::toFloats(x[i]);
        now.particles[i].velocity = test::toFloats(v[i]);
    }
    test::Runner anew(now, settings(64));
    to.run(5);
    anew.run(5);
    EXPECT_EQ(to.stateHash(), anew.stateHash());
}

// The state is then restored from the public one, in which the non-finite number left no trace.
TEST_P(SlowMotion, OutlastsAStepThatIsUndone) {
    Scene scene = freeParticles(15);
    test::Runner runner(scene, settings(64));
    runner.run(1);
    runner.writePosition(0, NAN);
    EXPECT_EQ(runner.step(scene.dt).nonFinite, 1u);
    runner.run(59);
    EXPECT_NEAR(runner.positions()[0].x() - 15, 0.001, 1e-5);
    EXPECT_NEAR(runner.positions()[2].x() - 15, 0.1, 1e-3);
}

INSTANTIATE_TEST_SUITE_P(Of, SlowMotion, testing::Values(Solver::jacobi, Solver::split, Solver::gaussSeidel),
                         [](const auto& parameter) { return std::string(solverName(parameter.param)); });

namespace {

class SlowMotionOfSplit : public testing::Test {};

} // namespace

TEST_F(SlowMotionOfSplit, IsExactWhereParticlesMayTouch) {
    const std::pair<float, std::uint32_t> cases[] = {{1.0f, 64}, {15.0f, 256}, {100.0f, 16}};
    for (const auto& [x, substeps] : cases)
        expectWays(freeParticles(x, 0.05f), {.substeps = substeps}, std::to_string(x) + " m");
}

TEST_F(SlowMotionOfSplit, IsExactWhereParticlesMayTouchFacesAndPlanes) {
    for (const bool hasPairs : {false, true}) {
        Scene scene = freeParticles(15, 0.05f);
        scene.planes = {{.normal = {0, 1, 0}, .offset = -100}};
        if (hasPairs)
            addMeshCollider(scene, {.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 0, 1}}, .triangles = {{0, 1, 2}}});
        else
            addCloth(scene, {.origin = {0, 5, 0}, .size = {3, 3}, .spacing = 0.2f, .thickness = 0.01f});
        expectWays(scene, {.substeps = 32}, hasPairs ? "mesh" : "cloth");
    }
}

// Two particles, a particle and a sheet, and two sheets with crossing edges; the first of each moves.
TEST_F(SlowMotionOfSplit, HasTheMomentumOfBodiesThatMeet) {
    const auto particle = [](Scene& scene, float x, float speed) {
        scene.particles.push_back(
            {.position = {x, 0.01f, 0.02f}, .velocity = {speed, 0, 0}, .radius = 0.05f});
    };
    const auto sheet = [](Scene& scene, float x, float speed, const Vec3& right, const Vec3& down) {
        const Vec3 origin{x, -0.1f * (right.y + down.y), -0.1f * (right.z + down.z)};
        const std::uint32_t first = addCloth(scene, {.origin = origin,
                                                     .right = right,
                                                     .down = down,
                                                     .size = {3, 3},
                                                     .spacing = 0.1f,
                                                     .areaDensity = 20,
                                                     .thickness = 0.02f});
        for (std::uint32_t i = first; i < first + 9; ++i) scene.particles[i].velocity = {speed, 0, 0};
    };
    const Vec3 y{0, 1, 0}, z{0, 0, 1}, up{0, 0.8f, 0.6f}, down{0, -0.6f, 0.8f};
    Scene particles = empty(), both = empty(), sheets = empty();
    particle(particles, 15, 0.02f), particle(particles, 15.102f, 0);
    particle(both, 15, 0.02f), sheet(both, 15.062f, 0, y, z);
    sheet(sheets, 15, 0.02f, y, z), sheet(sheets, 15.022f, 0, up, down);
    for (const auto& [name, scene] :
         {std::pair{"particles", particles}, {"particle and sheet", both}, {"sheets", sheets}}) {
        test::Runner runner(scene, {.substeps = 32});
        runner.run(steps);
        double momentum = 0;
        for (const Particle& one : scene.particles)
            momentum += double{one.velocity.x} / double{one.inverseMass};
        const double right = momentum / test::massOf(scene) * duration;
        EXPECT_NEAR(meanWay(scene, runner), right, 0.01 * right) << name;
        EXPECT_LT(runner.velocities()[0].x(), 0.019) << name << ": they have met";
    }
}

TEST_F(SlowMotionOfSplit, GoesOnAfterACut) {
    const Scene scene = moving(shifted(test::cuttableSheet(), 15), 0.001f);
    test::Runner runner(scene, {.substeps = 64});
    runner.run(20);
    const std::array from{Vec3{15.45f, -1, -0.5f}, Vec3{15.45f, 1, -0.5f}},
        to{Vec3{15.45f, -1, 1.5f}, Vec3{15.45f, 1, 1.5f}};
    EXPECT_GT(runner.cut({.from = from, .to = to}).linksCut, 0u);
    EXPECT_EQ(runner.run(39).pieces, 2u);
    EXPECT_NEAR(meanWay(scene, runner), 0.001, 1e-5);
}

TEST_F(SlowMotionOfSplit, IsTakenOverByAndFromWhatKeepsNoRemaindersWithAllCuts) {
    Scene scene = moving(test::cuttableSheet(), 0.5f);
    scene.gravity = {0, -9.81f, 0};
    constexpr std::uint32_t few = 8, many = 1000;
    ASSERT_FALSE(keepsRemainders(scene, few));
    ASSERT_TRUE(keepsRemainders(scene, many));
    for (const auto& [before, after] : {std::pair{few, many}, {many, few}}) {
        test::Runner first(scene, {.substeps = before}), second(scene, {.substeps = after});
        EXPECT_GT(first.cut(test::bladeAcrossSheet()).linksCut, 0u);
        first.run(2);
        second.run(1);
        second.takeOver(first);
        EXPECT_EQ(second.stateHash(), first.stateHash());
        EXPECT_EQ(second.run(1).pieces, 2u);
        first.run(1);
        EXPECT_NEAR(meanWay(scene, second), meanWay(scene, first), 1e-6);
    }
}

TEST_F(SlowMotionOfSplit, EndsInSleepThatChangesNoBit) {
    Scene scene = voxels(15);
    scene.gravity = {0, -9.81f, 0};
    scene.damping = 2;
    scene.planes = {{.friction = 0.5f}};
    test::Runner runner(scene, {.substeps = 16, .sleeps = true});
    for (int s = 0; s < 400 && runner.run(1).sleeping == 0; ++s) {
    }
    const std::uint64_t asleep = runner.stateHash();
    EXPECT_EQ(runner.run(20).sleeping, scene.particles.size());
    EXPECT_EQ(runner.stateHash(), asleep);
}

TEST_F(SlowMotionOfSplit, IsExactInAllFormsOfABodyOfVoxels) {
    for (const bool usesGrids : {true, false})
        for (const bool usesTexels : {true, false})
            for (const bool isResident : {true, false}) {
                Settings settings{.substeps = 64};
                settings.forms.usesGrids = usesGrids;
                settings.forms.usesTexels = usesTexels;
                settings.forms.residentBytes = isResident ? 32768 : 0;
                EXPECT_NEAR(wayOf(voxels(15), 0.001f, settings), 0.001 * duration, 1e-5 * duration)
                    << usesGrids << usesTexels << isResident;
            }
}

TEST(Remainders, AreKeptWhereALostRoundingShows) {
    const auto keeps = [](float x, std::uint32_t substeps, float g) {
        Scene scene = test::particleAt({x, 0, 0});
        scene.gravity = {0, g, 0};
        return keepsRemainders(scene, substeps);
    };
    EXPECT_TRUE(keeps(1, 32, 0));
    EXPECT_FALSE(keeps(1, 4, 0)); // at most 1.4 % of 1 mm/s
    EXPECT_FALSE(keeps(0.4f, 64, 0));
    EXPECT_TRUE(keeps(15, 4, -9.81f));
    EXPECT_FALSE(keeps(1.5f, 256, -9.81f));
    EXPECT_TRUE(keeps(1.5f, 300, -9.81f));
    EXPECT_TRUE(keeps(6, 128, -9.81f));
}

TEST(Remainders, AreNoPassAndNoRoomOfASceneWithoutThem) {
    Scene scene = test::particleAt({0.1f, 0, 0});
    const auto bytesOf = [&] {
        const StepProgram program = compile(scene, {.substeps = 4});
        for (const BufferSpec& buffer : program.buffers)
            if (buffer.label == "state.positions") return buffer.bytes();
        return std::uint64_t{0};
    };
    const std::uint64_t near = bytesOf();
    const std::size_t passes = compile(scene, {.substeps = 4})[List::step].size();
    scene.particles[0].position.x = 15;
    EXPECT_EQ(bytesOf(), 2 * near);
    EXPECT_EQ(compile(scene, {.substeps = 4})[List::step].size(), passes);
}
