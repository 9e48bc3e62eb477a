// Tests of the number of substeps, which follows from stiffness, mass, frame time and tolerance, and of the
// reported stiffness, which a loaded body must show.
#include "sinew/substeps.hpp"

#include "sim/compile/compile.hpp"
#include "sim/runner.hpp"
#include "sim/scenes.hpp"
#include "sim/simulation/step_clock.hpp"
#include "sinew/bodies.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <span>

using namespace sinew;
using namespace sinew::sim;

namespace {

// A fixed particle and `count` particles of 0.01 kg that hang below it, 0.1 m apart.
Scene dampedChain(std::uint32_t count, float compliance) {
    Scene scene = test::hangingChain(count, 0.1f, 0.01f, compliance);
    scene.damping = 20;
    return scene;
}

double stretchOf(const Scene& scene, const Settings& settings) {
    test::Runner runner(scene, settings);
    EXPECT_EQ(runner.run(400).nonFinite, 0u);
    const auto x = runner.positions();
    return -x.back().y() - 0.1 * static_cast<double>(x.size() - 1);
}

} // namespace

TEST(Substeps, OfSplitAreThoseOfItsFormula) {
    // k = 1e4 N/m, two links for a particle of 0.01 kg: kappa = 2 / (2 x 2 x 100). k h^2 <= kappa gives n =
    // dt sqrt(k / kappa).
    const Scene scene = dampedChain(5, 1e-4f);
    const double exact = double{scene.dt} * std::sqrt(1e4 / 0.005);
    for (const double tolerance : {1e-3, 0.05, 0.5}) {
        const SubstepChoice choice =
            chooseSubsteps(scene, {.tolerance = static_cast<float>(tolerance), .hasSharpClamp = false});
        EXPECT_EQ(choice.substeps, std::ceil(exact * std::sqrt(1 - tolerance))) << tolerance;
        EXPECT_EQ(choice.reason, SubstepReason::stiffness);
    }
}

namespace {

// A column of balls of 1 kg and 0.05 m on a fixed one.
Scene columnOf(std::uint32_t count) {
    Scene scene;
    for (std::uint32_t i = 0; i <= count; ++i)
        scene.particles.push_back({.position = {0.02f, 0.1f * static_cast<float>(i), 0.01f},
                                   .inverseMass = i == 0 ? 0.0f : 1.0f,
                                   .radius = 0.05f});
    return scene;
}

} // namespace

// n = dt sqrt(F D / d). The lowest contact carries all balls, on a fixed one; the next carries all but one,
// between two moving ones.
TEST(Substeps, OfAColumnPressItInByNoMoreThanOnePercentOfARadius) {
    for (const std::uint32_t count : {40u, 200u}) {
        const Scene scene = columnOf(count);
        const SubstepChoice choice = chooseSubsteps(scene, {});
        const double load = (count - 1) * 9.81,
                     exact = double{scene.dt} * std::sqrt(load * 4 / (0.01 * 0.05));
        EXPECT_EQ(choice.substeps, std::ceil(exact)) << count;
        EXPECT_EQ(choice.reason, SubstepReason::contacts);
        EXPECT_NE(toText(choice, {}).find("1 % of a radius"), std::string::npos);
    }
    EXPECT_EQ(chooseSubsteps(columnOf(2), {}).substeps, 16u) << "at least, where particles touch";
    EXPECT_EQ(chooseSubsteps(columnOf(2), {}).reason, SubstepReason::fewest);
    Scene leaning = columnOf(40), weightless = leaning;
    for (Particle& particle : leaning.particles) std::swap(particle.position.x, particle.position.y);
    leaning.gravity = {-9.81f, 0, 0};
    EXPECT_EQ(chooseSubsteps(leaning, {}).substeps, chooseSubsteps(columnOf(40), {}).substeps);
    weightless.gravity = {};
    EXPECT_EQ(chooseSubsteps(weightless, {}).substeps, 16u);
}

// Sheets in contact by their triangles, and a sheet that falls onto a mesh and rests there.
TEST(Substeps, OfSheetsOnEachOtherRegardWhatLiesOnThem) {
    Scene scene;
    constexpr std::uint32_t count = 20;
    for (std::uint32_t layer = 0; layer < count; ++layer)
        addCloth(scene, {.origin = {0, 0.0105f * static_cast<float>(layer), 0},
                         .size = {5, 5},
                         .spacing = 0.05f,
                         .areaDensity = 0.3f,
                         .membraneStiffness = 10,
                         .thickness = 0.01f});
    const SubstepChoice choice = chooseSubsteps(scene, {});
    const double radius{scene.particles[0].radius};
    EXPECT_EQ(choice.reason, SubstepReason::contacts);
    EXPECT_EQ(choice.substeps,
              std::ceil(double{scene.dt} * std::sqrt((count - 1) * 9.81 * 4 / (0.01 * radius))));
    Scene one = test::particleAt({0, 1, 0});
    EXPECT_EQ(chooseSubsteps(one, {}).substeps, 1u);
    one.particles[0].radius = 0.05f;
    addMeshCollider(one, {.vertices = {{-1, 0, -1}, {-1, 0, 1}, {1, 0, 1}}, .triangles = {{0, 1, 2}}});
    EXPECT_EQ(chooseSubsteps(one, {}).substeps, 16u) << "at least, where something touches a face";
}

// A body's weight rests on its own links, and on contacts only where it stands on another body.
TEST(Substeps, OfABodyThatTouchesNoOtherDoNotRegardContacts) {
    Scene scene = test::block(6, 0.1f, 1e4f);
    const std::uint32_t without = chooseSubsteps(scene, {}).substeps;
    for (Particle& particle : scene.particles) particle.radius = 0.05f;
    EXPECT_EQ(chooseSubsteps(scene, {}).substeps, std::max(16u, without));
}

TEST(Substeps, GrowWithFrameTimeStiffnessAndLightness) {
    const auto chosen = [](float dt, float compliance, float lightness) {
        Scene scene = dampedChain(5, compliance);
        scene.dt = dt;
        for (Particle& particle : scene.particles) particle.inverseMass *= lightness;
        return static_cast<double>(chooseSubsteps(scene, {}).substeps);
    };
    const double usual = chosen(0.01f, 1e-4f, 1);
    EXPECT_NEAR(chosen(0.02f, 1e-4f, 1), 2 * usual, 2);
    EXPECT_NEAR(chosen(0.01f, 2.5e-5f, 1), 2 * usual, 2);
    EXPECT_NEAR(chosen(0.01f, 1e-4f, 4), 2 * usual, 2);
}

TEST(Substeps, KeepEveryElasticLinkWithinTheTolerance) {
    struct Case {
        Solver solver;
        std::uint32_t iterations;
    };
    for (const auto& [solver, iterations] : {Case{Solver::split, 1}, Case{Solver::jacobi, 200},
                                             Case{Solver::gaussSeidel, 1}, Case{Solver::gaussSeidel, 4}}) {
        for (const float tolerance : {0.01f, 0.05f, 0.2f}) {
            const Scene scene = test::block(4, 0.05f, 1e6f);
            Settings settings{.solver = solver, .tolerance = tolerance, .iterations = iterations};
            settings.substeps = chooseSubsteps(scene, settings).substeps;
            const StiffnessReport report = inspectStiffness(scene, settings);
            EXPECT_GE(report.softest, 1 - double{tolerance} - 1e-5) << solverName(solver) << ' ' << tolerance;
            EXPECT_EQ(report.soft, 0u);
            EXPECT_EQ(report.neededSubsteps, settings.substeps);
            settings.substeps = settings.substeps * 9 / 10;
            EXPECT_GT(inspectStiffness(scene, settings).soft, 0u) << "no more than it takes";
        }
    }
}

// Statics of `split` are exact: the links of a hanging chain stretch by their load over k_eff.
TEST(Substeps, ReportTheStiffnessThatALoadedChainShows) {
    const Scene scene = dampedChain(4, 1e-4f);
    for (const std::uint32_t substeps : {4u, 8u, 32u}) {
        const Settings settings{.substeps = substeps, .hasSharpClamp = false};
        const StiffnessReport report = inspectStiffness(scene, settings);
        EXPECT_EQ(report.clamped, substeps < 23 ? 4u : 0u) << substeps;
        // Every link has an end with two links, and so the same clamp; the loads are 4, 3, 2 and 1 weights.
        const double h = double{scene.dt} / substeps, weight = 0.01 * 9.81;
        const double inner = std::min(1e4, 0.005 / (h * h));
        const double predicted = weight * (4 + 3 + 2 + 1) / inner;
        EXPECT_NEAR(stretchOf(scene, settings) / predicted, 1, 0.02) << substeps;
        EXPECT_NEAR(report.softest, inner / 1e4, 1e-5) << substeps;
    }
}

// Masses between two springs take half of each correction for any number of substeps. The chain extends
// nearly twice too far, and the report must not advise more substeps.
TEST(Substeps, AreNotSaidToMendWhatAveragingLeaves) {
    const Scene scene = dampedChain(20, 1e-3f);
    const double asked = 0.01 * 9.81 * (20 * 21 / 2) * 1e-3;
    const Settings averaged{.solver = Solver::jacobi}, weighted{.solver = Solver::jacobi, .weight = 1};
    const SubstepChoice choice = chooseSubsteps(scene, averaged);
    EXPECT_FALSE(choice.isReachable);
    EXPECT_EQ(choice.share, 0.5);
    const std::string text = toText(choice, averaged);
    EXPECT_NE(text.find("no number of substeps reaches the tolerance of 5 %"), std::string::npos) << text;
    EXPECT_NE(text.find("50 % of its stiffness at most; use weight or iterations"), std::string::npos)
        << text;
    for (const std::uint32_t substeps : {choice.substeps, 64u}) {
        const Settings settings{.solver = Solver::jacobi, .substeps = substeps};
        EXPECT_EQ(inspectStiffness(scene, settings).neededSubsteps, 0u);
        EXPECT_GT(stretchOf(scene, settings) / asked, 1.8) << substeps;
    }
    EXPECT_TRUE(chooseSubsteps(scene, weighted).isReachable);
    EXPECT_GT(inspectStiffness(scene, weighted).neededSubsteps, 0u);
}

// The model is one link that others pull back: a short chain is at least as stiff as reported, and not much
// stiffer.
TEST(Substeps, OfMoreSweepsAreAsStiffAsReported) {
    const Scene scene = dampedChain(4, 1e-4f);
    const double asked = 0.01 * 9.81 * (4 + 3 + 2 + 1) * 1e-4;
    for (const Solver solver : {Solver::gaussSeidel, Solver::jacobi}) {
        double before = 0;
        for (const std::uint32_t iterations : {1u, 2u, 4u, 16u, 64u}) {
            const Settings settings{
                .solver = solver, .substeps = 4, .iterations = iterations, .warmStart = 0};
            const StiffnessReport report = inspectStiffness(scene, settings);
            const double shown = asked / stretchOf(scene, settings);
            EXPECT_GT(report.mean, before) << solverName(solver) << ' ' << iterations;
            EXPECT_LT(report.mean, 1.05 * shown) << solverName(solver) << ' ' << iterations;
            EXPECT_GT(report.mean, 0.4 * shown) << solverName(solver) << ' ' << iterations;
            before = report.mean;
        }
    }
}

// Each body has its own figures, which add up to those of the scene.
TEST(Substeps, ReportTheStiffnessOfEachBody) {
    Scene scene = test::block(4, 0.05f, 1e7f);
    const auto firstParticle = static_cast<std::uint32_t>(scene.particles.size());
    addLattice(scene, {.name = "soft", .cells = {5, 5, 5}, .spacing = 0.05f, .youngModulus = 1e4f});
    scene.bodies = {{.name = "stiff", .particleCount = firstParticle},
                    {.name = "soft",
                     .firstParticle = firstParticle,
                     .particleCount = static_cast<std::uint32_t>(scene.particles.size()) - firstParticle}};
    const StiffnessReport report = inspectStiffness(scene, {.substeps = 16});
    ASSERT_EQ(report.bodies.size(), 2u);
    const BodyStiffness &stiff = report.bodies[0], &soft = report.bodies[1];
    EXPECT_EQ(stiff.name, "stiff");
    EXPECT_EQ(stiff.soft, stiff.elastic);
    EXPECT_LT(stiff.softest, 0.5);
    EXPECT_EQ(soft.soft, 0u);
    EXPECT_EQ(soft.mean, 1);
    EXPECT_EQ(stiff.elastic + soft.elastic, report.elastic);
    EXPECT_EQ(stiff.soft, report.soft);
    EXPECT_EQ(stiff.softest, report.softest);
    EXPECT_LT(2 * report.soft, report.elastic) << "half of the scene is not the measure";
}

// Substeps must meet the part of the tolerance that the iterations leave.
TEST(Substeps, GrowWhereAveragingLeavesLessOfTheTolerance) {
    const Scene scene = dampedChain(5, 1e-4f);
    // A sweep keeps s r of the remaining error, s = 1/2 and r = 1 / (1 + c h^2). n sweeps leave 0.05 of it if
    // 1 - s r is the n-th root of 0.05.
    const auto excess = [](double n) { return 0.5 / (1 - std::pow(0.05, 1 / n)) - 1; };
    const Settings few{.solver = Solver::jacobi, .iterations = 5},
        many{.solver = Solver::jacobi, .iterations = 10};
    EXPECT_GT(chooseSubsteps(scene, few).wanted, chooseSubsteps(scene, many).wanted);
    EXPECT_NEAR(chooseSubsteps(scene, few).wanted / double(chooseSubsteps(scene, many).wanted),
                std::sqrt(excess(10) / excess(5)), 0.05);
    EXPECT_FALSE(chooseSubsteps(scene, {.solver = Solver::jacobi, .iterations = 4}).isReachable);
}

TEST(Substeps, HoldWhatHangsOnRigidLinks) {
    const Scene scene = dampedChain(10, 0);
    for (const Solver solver : {Solver::split, Solver::jacobi}) {
        const Settings settings{.solver = solver, .tolerance = 0.02f};
        const SubstepChoice choice = chooseSubsteps(scene, settings);
        EXPECT_EQ(choice.reason, SubstepReason::weight);
        test::Runner runner(scene, settings);
        ASSERT_EQ(runner.run(400).nonFinite, 0u);
        const auto x = runner.positions();
        for (std::size_t i = 1; i < x.size(); ++i)
            EXPECT_LE(std::abs((x[i] - x[i - 1]).norm() / 0.1 - 1), 0.02)
                << solverName(solver) << " link " << i << ", " << choice.substeps << " substeps";
    }
}

namespace {

// Largest strain of a link of a rigid body some time after its release, with the chosen number of substeps.
double strainAtRest(Scene scene, double seconds = 4) {
    scene.damping = 2;
    test::Runner runner(scene, {});
    EXPECT_EQ(runner.run(static_cast<int>(seconds / double{scene.dt})).nonFinite, 0u);
    const auto x = runner.positions();
    double most = 0;
    for (const DistanceConstraint& c : scene.distances)
        if (c.compliance == 0) most = std::max(most, (x[c.a] - x[c.b]).norm() / double{c.restLength} - 1);
    return most;
}

Scene rigidChain(std::uint32_t count) {
    Scene scene;
    for (std::uint32_t i = 0; i < count; ++i)
        scene.particles.push_back(
            {.position = {static_cast<float>(i) / static_cast<float>(count - 1) - 0.5f, 1.11f, 0},
             .inverseMass = static_cast<float>(count) / 0.5f});
    for (std::uint32_t i = 0; i + 1 < count; ++i)
        scene.distances.push_back({.a = i, .b = i + 1, .restLength = 1 / static_cast<float>(count - 1)});
    return scene;
}

Scene rigidCloth() {
    Scene scene;
    addCloth(scene, {.origin = {0, 1, 0},
                     .down = {0, -1, 0},
                     .size = {31, 31},
                     .spacing = 1 / 30.0f,
                     .areaDensity = 0.3f});
    return scene;
}

} // namespace

TEST(Substeps, HoldRigidChainsThatACapsuleCarries) {
    for (const std::uint32_t count : {21u, 51u, 101u, 202u}) {
        Scene scene = rigidChain(count);
        const float half = std::sqrt(0.5f);
        scene.colliders = {{.shape = ColliderShape::capsule,
                            .radius = 0.1f,
                            .halfLength = 1,
                            .friction = 0.5f,
                            .pose = {{0, 1, 0}, {half, 0, 0, half}}}};
        EXPECT_LE(strainAtRest(scene), 0.05) << count;
        scene.colliders[0].pose.position.x = 5;
        EXPECT_EQ(chooseSubsteps(scene, {}).substeps, 4u) << "beside it nothing carries";
    }
}

TEST(Substeps, HoldChainsBetweenTwoPins) {
    for (const std::uint32_t count : {3u, 11u, 51u}) {
        Scene scene = rigidChain(count);
        scene.fixed = {{0}, {count - 1}};
        EXPECT_LE(strainAtRest(scene), 0.05) << count;
    }
}

TEST(Substeps, HoldTheWorstLinkOfRigidSheets) {
    Scene edges = rigidCloth(), row = edges, pin = edges;
    for (std::uint32_t i = 0; i < 31; ++i) {
        row.fixed.push_back({i});
        edges.fixed.push_back({i});
        if (i > 0) edges.fixed.push_back({31 * i});
    }
    pin.fixed = {{15}};
    EXPECT_LE(strainAtRest(edges), 0.05);
    EXPECT_LE(strainAtRest(row), 0.05);
    EXPECT_LE(strainAtRest(pin), 0.05);
}

namespace {

constexpr float half = 0.1f; // of the box below a sheet [m]

MeshCollider boxOfTriangles() {
    MeshCollider box;
    for (std::uint32_t i = 0; i < 8; ++i)
        box.vertices.push_back({i & 1 ? half : -half, i & 2 ? half : -half, i & 4 ? half : -half});
    for (const auto& [a, b, c, d] : {std::array{0u, 1u, 3u, 2u},
                                     {4u, 6u, 7u, 5u},
                                     {0u, 4u, 5u, 1u},
                                     {2u, 3u, 7u, 6u},
                                     {0u, 2u, 6u, 4u},
                                     {1u, 5u, 7u, 3u}})
        box.triangles.insert(box.triangles.end(), {{a, b, c}, {a, c, d}});
    return box;
}

// A rigid sheet of 0.6 m on a box of 0.2 m around the origin.
Scene sheetAbove(float gap, float radius) {
    Scene scene;
    addCloth(scene,
             {.origin = {-0.3f, half + gap, -0.3f}, .size = {21, 21}, .spacing = 0.03f, .radius = radius});
    return scene;
}

} // namespace

TEST(Substeps, HoldRigidSheetsOverTheCornersOfABox) {
    for (const float degrees : {0.0f, 45.0f}) {
        Scene scene = sheetAbove(1e-3f, 0);
        const float angle = degrees * std::numbers::pi_v<float> / 360;
        scene.colliders = {{.shape = ColliderShape::box,
                            .halfExtents = {half, half, half},
                            .friction = 0.5f,
                            .pose = {{}, {0, std::sin(angle), 0, std::cos(angle)}}}};
        EXPECT_LE(strainAtRest(scene, 3), 0.05) << degrees;
    }
}

TEST(Substeps, HoldRigidSheetsOverRoundThingsAndEdges) {
    const float turn = std::sqrt(0.5f);
    const std::pair<const char*, Collider> things[] = {
        {"a capsule",
         {.shape = ColliderShape::capsule,
          .radius = half,
          .halfLength = 1,
          .pose = {{}, {turn, 0, 0, turn}}}},
        {"a narrow capsule",
         {.shape = ColliderShape::capsule,
          .radius = half / 2,
          .halfLength = 1,
          .pose = {{0, half / 2, 0}, {turn, 0, 0, turn}}}},
        {"a sphere", {.shape = ColliderShape::sphere, .radius = half}},
        {"two edges", {.shape = ColliderShape::box, .halfExtents = {half, half, 1}}}};
    for (const auto& [name, thing] : things) {
        Scene scene = sheetAbove(1e-3f, 0);
        scene.colliders = {thing};
        scene.colliders[0].friction = 0.5f;
        EXPECT_LE(strainAtRest(scene, 3), 0.05) << name;
    }
}

TEST(Substeps, OfWhatHangsOnPinsAreTheSameBesideWhatIsCarried) {
    Scene hung = rigidCloth();
    hung.fixed = {{0}, {30}, {31 * 15 + 15}}; // two corners and one inner particle
    const SubstepChoice alone = chooseSubsteps(hung, {});
    ASSERT_EQ(alone.reason, SubstepReason::weight);
    for (const float x : {-0.01f, 0.0f, 0.01f})
        hung.particles.push_back({.position = {5 + x, 0.101f, 5}, .inverseMass = 1e4f});
    hung.distances.push_back({.a = 961, .b = 962, .restLength = 0.01f});
    hung.distances.push_back({.a = 962, .b = 963, .restLength = 0.01f});
    hung.colliders = {{.shape = ColliderShape::sphere, .radius = 0.1f, .pose = {{5, 0, 5}, {}}}};
    EXPECT_EQ(chooseSubsteps(hung, {}).wanted, alone.wanted);
}

TEST(Substeps, HoldRigidSheetsThatMeshesAndBodiesCarry) {
    const std::uint32_t alone = chooseSubsteps(sheetAbove(0.02f, 0.01f), {}).substeps;
    Scene onMesh = sheetAbove(0.012f, 0.01f);
    addMeshCollider(onMesh, boxOfTriangles());
    EXPECT_LE(strainAtRest(onMesh, 1), 0.05);
    EXPECT_EQ(chooseSubsteps(onMesh, {}).reason, SubstepReason::weight);

    Scene onBody = sheetAbove(0.032f, 0.01f);
    addLattice(onBody, {.origin = {-half, -half, -half},
                        .cells = {5, 5, 5},
                        .spacing = 0.04f,
                        .youngModulus = 1e6f,
                        .density = 200,
                        .radius = 0.02f});
    onBody.planes = {{.offset = -half, .friction = 0.5f}};
    EXPECT_LE(strainAtRest(onBody, 1), 0.05);

    const std::uint32_t near = chooseSubsteps(onMesh, {}).substeps;
    addCloth(onMesh, {.origin = {1e4f, 0, 0}, .size = {3, 3}, .membraneStiffness = 1, .radius = 1e-3f});
    EXPECT_EQ(chooseSubsteps(onMesh, {}).substeps, near) << "whatever else is far away";
    for (Particle& particle : std::span(onMesh.particles).subspan(21 * 21, 8)) particle.position.x += 5;
    EXPECT_EQ(chooseSubsteps(onMesh, {}).substeps, alone) << "beside it nothing carries";
}

TEST(Substeps, RegardMeshesThatComeBelow) {
    Scene scene = sheetAbove(0.012f, 0.01f);
    const std::uint32_t alone = chooseSubsteps(scene, {}).substeps;
    MeshCollider box = boxOfTriangles();
    addMeshCollider(scene, box);
    const std::uint32_t onMesh = chooseSubsteps(scene, {}).substeps;
    scene = sheetAbove(0.012f, 0.01f);
    box.path = {{.time = 0, .pose = {{2, 0, 0}}}, {.time = 0.1f, .pose = {}}};
    addMeshCollider(scene, box);
    EXPECT_EQ(chooseSubsteps(scene, {}).substeps, onMesh);
    EXPECT_GT(onMesh, 3 * alone);
}

// At most the number for the same shape as a collider, except for corners, which these shapes lack.
TEST(Substeps, AreThoseOfWeightOnRoundOrNarrowThings) {
    const auto substepsOn = [](const Collider& collider) {
        Scene scene = sheetAbove(0, 0);
        scene.colliders = {collider};
        return chooseSubsteps(scene, {}).substeps;
    };
    const std::uint32_t sphere =
        substepsOn({.shape = ColliderShape::sphere, .radius = half, .pose = {{0, -0.01f, 0}}});
    Scene onBall = sheetAbove(0.012f, 0.01f);
    onBall.particles.push_back({.inverseMass = 0, .radius = half});
    EXPECT_NEAR(chooseSubsteps(onBall, {}).substeps, sphere, 0.25 * sphere);
    const auto bar = [&](float width) {
        return substepsOn({.shape = ColliderShape::box, .halfExtents = {width / 2, half, 2}});
    };
    EXPECT_LE(bar(0.016f), 1.3 * bar(0.05f)) << "a ridge has no corners";
}

// Pins hold a sheet above a box that lies deeper than it may fall.
TEST(Substeps, RegardNothingThatPinsKeepAway) {
    Scene scene = sheetAbove(0.012f, 0.01f);
    for (const std::uint32_t corner : {0u, 20u, 420u, 440u}) scene.fixed.push_back({corner});
    const std::uint32_t alone = chooseSubsteps(scene, {}).substeps;
    MeshCollider box = boxOfTriangles();
    for (Vec3& vertex : box.vertices) vertex.y -= 2;
    addMeshCollider(scene, box);
    EXPECT_EQ(chooseSubsteps(scene, {}).substeps, alone);
}

// A substep moves at most 0.6 of the thickness, at the speed of a fall through the sheet's own extent.
TEST(Substeps, LetNoSheetFallThroughItself) {
    const auto sheetOf = [](float thickness, std::uint32_t count) {
        Scene scene;
        addCloth(scene,
                 {.size = {count, count}, .spacing = 0.02f, .membraneStiffness = 1, .thickness = thickness});
        return scene;
    };
    for (const std::uint32_t count : {11u, 31u, 61u})
        for (const float thickness : {0.002f, 0.003f, 0.006f}) {
            const Scene scene = sheetOf(thickness, count);
            const double reach = 0.02 * (count - 1) * std::sqrt(0.5);
            const double wanted = double{scene.dt} * std::sqrt(2 * 9.81 * reach) / (0.6 * double{thickness});
            const SubstepChoice choice = chooseSubsteps(scene, {});
            EXPECT_NEAR(choice.substeps, std::max(16.0, wanted), 1) << count << ", " << thickness;
            EXPECT_EQ(choice.reason, wanted > 15 ? SubstepReason::folds : SubstepReason::fewest);
        }
    Scene slow = sheetOf(0.001f, 31);
    slow.damping = 9.81f; // falls at 1 m/s at most
    EXPECT_NEAR(chooseSubsteps(slow, {}).substeps, double{slow.dt} / (0.6 * 0.001), 1);
    Scene pinned = sheetOf(0.002f, 31), rug = pinned;
    pinned.fixed = {{0}};
    EXPECT_NE(chooseSubsteps(pinned, {}).reason, SubstepReason::folds);
    rug.planes = {{.offset = -0.002f}}; // the largest fall is 2 mm
    EXPECT_NEAR(chooseSubsteps(rug, {}).substeps,
                std::max(16.0, double{rug.dt} * std::sqrt(2 * 9.81 * 0.002) / (0.6 * 0.002)), 1);
}

TEST(Substeps, StayBetweenTheirLimitsAndSaySo) {
    Scene stiff = dampedChain(5, 1e-10f), soft = dampedChain(5, 10);
    EXPECT_EQ(chooseSubsteps(stiff, {}).substeps, 256u);
    EXPECT_EQ(chooseSubsteps(stiff, {}).reason, SubstepReason::most);
    EXPECT_GT(chooseSubsteps(stiff, {}).wanted, 10'000u);
    EXPECT_EQ(chooseSubsteps(soft, {}).substeps, 4u);
    EXPECT_EQ(chooseSubsteps(soft, {}).reason, SubstepReason::fewest);
    EXPECT_EQ(chooseSubsteps(test::particleAt({0, 1, 0}), {}).substeps, 1u);
    EXPECT_EQ(chooseSubsteps({}, {}).substeps, 1u);
    EXPECT_EQ(chooseSubsteps(stiff, {.substeps = 7}).substeps, 7u);
    EXPECT_EQ(chooseSubsteps(stiff, {.substeps = 7}).reason, SubstepReason::asked);
    EXPECT_NE(toText(chooseSubsteps(stiff, {}), {}).find("would keep the tolerance of 5 %"),
              std::string::npos);
}

TEST(Substeps, GiveWhatFallsItsTerminalSpeed) {
    for (const Solver solver : {Solver::split, Solver::gaussSeidel, Solver::jacobi})
        for (const float damping : {10.0f, 20.0f, 60.0f, 200.0f}) {
            Scene scene = test::particleAt({0, 1, 0});
            scene.gravity = {0, -9.81f, 0};
            scene.damping = damping;
            const Settings settings{.solver = solver};
            const SubstepChoice choice = chooseSubsteps(scene, settings);
            EXPECT_EQ(choice.reason, SubstepReason::drag) << damping;
            EXPECT_EQ(choice.substeps, dragSubsteps(scene));
            test::Runner runner(scene, settings);
            runner.run(120);
            const double before = runner.positions()[0].y();
            runner.run(60);
            const double speed = (before - runner.positions()[0].y()) / (60 * double{scene.dt});
            EXPECT_NEAR(speed * double{damping} / 9.81, 1, dragTolerance) << damping;
        }
}

TEST(Substeps, OfZeroAreChosenByCompileAndSimulation) {
    const Scene scene = dampedChain(5, 1e-4f);
    const std::uint32_t chosen = chooseSubsteps(scene, {}).substeps;
    EXPECT_EQ(compile(scene, {}).sweeps, chosen);
    test::Runner automatic(scene, {}), asked(scene, {.substeps = chosen});
    automatic.run(10);
    asked.run(10);
    EXPECT_EQ(automatic.stateHash(), asked.stateHash());
}

TEST(Substeps, OfAPinnedAndAFreeBodyDifferOnlyByWhatHangs) {
    Scene scene = test::sheet(6);
    EXPECT_EQ(chooseSubsteps(scene, {}).reason, SubstepReason::weight);
    scene.fixed.clear();
    EXPECT_EQ(chooseSubsteps(scene, {}).substeps, 4u);
    scene.fixed = {{0}};
    scene.gravity = {0, 0, 0};
    EXPECT_EQ(chooseSubsteps(scene, {}).substeps, 4u);
}

TEST(StepClock, GivesStepsOfOneLengthForFramesOfAny) {
    StepClock clock(0.01, 100);
    double passed = 0;
    std::uint32_t steps = 0;
    for (int frame = 0; frame < 1000; ++frame) {
        const double time = 0.004 + 0.046 * (frame * 37 % 11) / 10;
        passed += time;
        const StepClock::Due due = clock.advance(time);
        steps += due.steps;
        EXPECT_GE(due.ahead, 0);
        EXPECT_LT(due.ahead, 1);
        EXPECT_EQ(due.lostTime, 0);
    }
    EXPECT_NEAR(steps * 0.01, passed, 0.01);
}

TEST(StepClock, DropsWhatADeviceCannotMakeUpAndSaysHowMuch) {
    StepClock clock(0.01, 4);
    const StepClock::Due due = clock.advance(1.005);
    EXPECT_EQ(due.steps, 4u);
    EXPECT_NEAR(due.lostTime, 0.96, 1e-9);
    EXPECT_NEAR(due.ahead, 0.5, 1e-6);
    for (const double none : {-1.0, std::nan(""), 0.0}) EXPECT_EQ(clock.advance(none).steps, 0u);
}

TEST(StepClock, MakesOneStepAFrameOfThatLength) {
    StepClock clock(1.0 / 60, 4);
    for (int frame = 0; frame < 10'000; ++frame) ASSERT_EQ(clock.advance(1.0 / 60).steps, 1u) << frame;
}
