// Hard cases 3, 11, 20 and 33: constraints without length, mass or stiffness, and empty scenes.
#include "cases_hard/trial.hpp"
#include "sim/compile/compile.hpp"
#include "sim/scenes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace sinew;
using namespace sinew::sim;
using Eigen::Vector3d;
using test::runTrial;
using test::Trial;

namespace {

class DegenerateCase : public testing::TestWithParam<Solver> {
protected:
    Settings settings(std::uint32_t substeps = 8) const {
        return {.solver = GetParam(), .substeps = substeps};
    }
};

double length(const std::vector<Vector3d>& x) {
    return (x[1] - x[0]).norm();
}

Scene pair(const Vec3& a, const Vec3& b, float restLength, float compliance) {
    Scene scene{.name = "pair"};
    scene.gravity = {0, 0, 0};
    scene.particles = {{.position = a}, {.position = b}};
    scene.distances = {{0, 1, restLength, compliance}};
    return scene;
}

} // namespace

TEST_P(DegenerateCase, Case03ALinkOfNoLengthWeldsItsEnds) {
    for (const float compliance : {0.0f, 1e-4f}) {
        Scene scene = pair({0, 0, 0}, {0.3f, 0, 0}, 0, compliance);
        scene.damping = 20;
        EXPECT_LE(length(runTrial(scene, settings(), {.steps = 240}).x.back()), 1e-3) << compliance;
    }
}

TEST_P(DegenerateCase, Case03CoincidentEndsGetNoCorrection) {
    for (const float restLength : {0.0f, 0.2f}) {
        for (const float compliance : {0.0f, 1e-4f}) {
            Scene scene = pair({0.1f, 0, 0}, {0.1f, 0, 0}, restLength, compliance);
            EXPECT_EQ(length(runTrial(scene, settings()).x.back()), 0) << restLength;
            scene.dampingTime = 0.01f; // damping divides by the length as well
            EXPECT_EQ(length(runTrial(scene, settings()).x.back()), 0) << restLength;
        }
    }
}

TEST_P(DegenerateCase, Case03AMeshOfCoincidentParticlesStaysWhereItIs) {
    Scene scene = test::sheet(5, 1e-4f);
    scene.gravity = {0, 0, 0};
    for (Particle& particle : scene.particles) particle.position = {1, 2, 3};
    const Trial trial = runTrial(scene, settings(), {.steps = 20});
    for (const Vector3d& x : trial.x.back()) EXPECT_EQ(x, Vector3d(1, 2, 3));
}

// Compliance 0 gives the largest stiffness that a substep allows, and stays stable.
TEST_P(DegenerateCase, Case11NoComplianceIsStable) {
    Scene scene = test::sheet(8);
    test::disturb(scene, 0.01f, 0.5f);
    runTrial(scene, settings(), {.steps = 120});
}

TEST_P(DegenerateCase, Case11AVerySoftLinkIsNone) {
    for (const float compliance : {1e9f, 3e38f}) {
        Scene scene = pair({0, 0, 0}, {0.3f, 0, 0}, 0.1f, compliance);
        scene.particles[1].velocity = {1, 0, 0};
        const Trial trial = runTrial(scene, settings());
        EXPECT_NEAR(length(trial.x.back()), 1.3, 1e-4) << "compliance " << compliance;
    }
}

TEST_P(DegenerateCase, Case20FixedParticlesStayToTheBit) {
    Scene scene = test::sheet(6, 1e-5f);
    test::addRoom(scene);
    test::disturb(scene, 0.02f, 2);
    scene.planes[0].offset += 0.3f; // some fixed particles lie behind the plane
    scene.damping = 1;
    scene.particles[17].inverseMass = 0;
    test::Runner runner(scene, settings());
    const auto before = runner.positions();
    ASSERT_EQ(runner.run(60).nonFinite, 0u);
    const auto x = runner.positions(), v = runner.velocities();
    for (const std::size_t i : {0, 5, 17}) {
        EXPECT_EQ(x[i], before[i]);
        EXPECT_EQ(v[i], Vector3d::Zero());
        EXPECT_EQ(runner.inverseMasses()[i], 0);
    }
}

TEST_P(DegenerateCase, Case20AnAllPinnedSceneStandsStillAndHasNoConstraintPass) {
    Scene scene = test::chain(5);
    test::disturb(scene, 0.05f, 1);
    scene.bends = {{0, 1, 2, 1e-3f}};
    scene.tethers = {{1, 0, 0.05f}};
    for (std::uint32_t i = 0; i < 5; ++i) scene.fixed.push_back({i});
    const Trial trial = runTrial(scene, settings(), {.steps = 10});
    EXPECT_EQ(trial.x.back(), trial.x.front());
    const StepProgram program = compile(scene, settings());
    for (const Pass& pass : program[List::step])
        for (const char* constraint : {"distance", "bends", "tethers", "corrections"})
            EXPECT_EQ(pass.label.find(constraint), std::string::npos) << pass.label;
    for (const BufferSpec& buffer : program.buffers) // a gather without links or bends has no list of them
        for (const char* constraint : {"distance", "bends", "tethers"})
            EXPECT_EQ(buffer.label.find(constraint), std::string::npos) << buffer.label;
}

TEST_P(DegenerateCase, Case33AnEmptySceneRuns) {
    EXPECT_TRUE(runTrial({}, settings(), {.steps = 3}).x.back().empty());
    test::Runner runner({}, settings());
    runner.skin();
}

TEST_P(DegenerateCase, Case33ASingleParticleFallsOntoAPlane) {
    Scene scene = test::particleAt({0, 0.2f, 0});
    scene.planes = {{}};
    EXPECT_NEAR(runTrial(scene, settings()).x.back()[0].y(), 0, 1e-6);
}

TEST_P(DegenerateCase, Case33ASkinWithoutTrianglesIsNoDispatch) {
    Scene scene = test::chain(3);
    scene.skins = {{.name = "points", .particles = {0, 1, 2}}};
    runTrial(scene, settings(), {.steps = 3});
    test::Runner runner(scene, settings());
    runner.skin();
}

INSTANTIATE_TEST_SUITE_P(Of, DegenerateCase,
                         testing::Values(Solver::jacobi, Solver::split, Solver::gaussSeidel),
                         [](const auto& parameter) { return solverName(parameter.param); });

// Case 10 without a clock: `split` gains no energy even if h changes. `jacobi` gains some, because the PBD
// order stretches a loaded link again whenever h changes.
TEST(Split, ChangingStepsFeedNoEnergyIntoABodyAtRest) {
    Scene scene = test::block(3, 0.1f, 1e5f);
    scene.planes = {{.friction = 0.5f}};
    scene.damping = 4;
    test::Runner runner(scene, {.substeps = 64});
    for (int step = 0; step < 240; ++step) runner.step(step * 37 % 11 < 5 ? 0.004f : 0.05f);
    EXPECT_LE(test::kineticEnergy(scene, runner.velocities()), 1e-6) << "[J]";
}
