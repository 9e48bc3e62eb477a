// Tests the figures of a report on states with known results.
#include "sinew/crossings.hpp"
#include "sinew/measure.hpp"
#include "sinew/overlap.hpp"
#include "sinew/pilot.hpp"
#include "sinew/skin_mesh.hpp"
#include "sinew/statistics.hpp"
#include "sinew/step_times.hpp"

#include "sinew/bodies.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

using namespace sinew;
using tools::State;

namespace {

State stateOf(const sim::Scene& scene) {
    State state;
    for (const sim::Particle& p : scene.particles) {
        state.positions.push_back({p.position.x, p.position.y, p.position.z, p.inverseMass});
        state.velocities.push_back({p.velocity.x, p.velocity.y, p.velocity.z, p.inverseMass});
    }
    return state;
}

sim::Scene twoLinks() {
    sim::Scene scene;
    scene.particles = {{{0, 0, 0}}, {{1, 0, 0}}, {{1, 2, 0}}};
    scene.distances = {{0, 1, 1, 0}, {1, 2, 2, 0}};
    return scene;
}

sim::Scene cube() {
    sim::Scene scene;
    const sim::Lattice lattice{.cells = {2, 2, 2}, .spacing = 0.5f};
    const sim::LatticeCorners corners = sim::addLattice(scene, lattice);
    sim::addLatticeSkin(scene, lattice, corners, {});
    return scene;
}

/// The skins of a scene whose particle positions are scaled by `scale`.
std::vector<mesh::TriangleMesh> skinsOf(sim::Scene scene, float scale) {
    for (sim::Particle& p : scene.particles)
        p.position = {p.position.x * scale, p.position.y * scale, p.position.z * scale};
    std::vector<mesh::TriangleMesh> meshes;
    for (const sim::Skin& skin : scene.skins)
        meshes.push_back(tools::skinMesh(skin, tools::skinVertices(scene, skin)));
    return meshes;
}

} // namespace

TEST(Strain, IsMeanSquareAndLargestMagnitude) {
    const sim::Scene scene = twoLinks();
    State state = stateOf(scene);
    state.positions[0][0] = -0.5f; // 50 % longer
    state.positions[2][1] = 1.8f;  // 10 % shorter
    const tools::Errors errors = tools::measure(scene, state, {}, 0);
    EXPECT_NEAR(errors.strainRms.value(), std::sqrt((0.25 + 0.01) / 2), 1e-6);
    EXPECT_NEAR(errors.strainMax.value(), 0.5, 1e-6);
}

TEST(Strain, HasNoMeaningWithoutConstraints) {
    sim::Scene scene;
    scene.particles.resize(1);
    const tools::Errors errors = tools::measure(scene, stateOf(scene), {}, 0);
    EXPECT_FALSE(errors.strainRms.has_value());
    EXPECT_FALSE(errors.strainMax.has_value());
}

// Two overlapping balls below the floor, linked to a third. Removed fragments are not measured.
TEST(Removed, CountsInNoFigure) {
    sim::Scene scene = twoLinks();
    for (sim::Particle& particle : scene.particles) particle.radius = 0.3f;
    scene.distances = {{0, 1, 1, 0}};
    scene.particles.push_back({.position = {1, 2.5f, 0}, .radius = 0.3f});
    scene.planes.push_back({});
    State state = stateOf(scene);
    state.positions[0][0] = -0.5f;
    state.positions[2][1] = state.positions[3][1] = -1;
    state.velocities[2][1] = state.velocities[3][1] = 2;
    const tools::Errors all = tools::measure(scene, state, {}, 0);
    EXPECT_NEAR(all.strainMax.value(), 0.5, 1e-6);
    EXPECT_NEAR(all.penetrationMax.value(), 1, 1e-6);
    EXPECT_GT(tools::overlapOf(scene, state)->pairs, 0u);
    EXPECT_NEAR(tools::kineticEnergy(state), 4, 1e-6);
    state.isRemoved = {true, false, true, true};
    const tools::Errors left = tools::measure(scene, state, {}, 0);
    EXPECT_FALSE(left.strainMax.has_value());
    EXPECT_NEAR(left.penetrationMax.value(), 0, 1e-6);
    EXPECT_EQ(tools::overlapOf(scene, state)->pairs, 0u);
    EXPECT_EQ(tools::kineticEnergy(state), 0);
}

TEST(Volume, IsTheRelativeChangeOfAClosedSkin) {
    const sim::Scene scene = cube();
    EXPECT_NEAR(tools::measure(scene, stateOf(scene), skinsOf(scene, 1.1f), 0).volume.value(), 0.331, 1e-5);
    EXPECT_NEAR(tools::measure(scene, stateOf(scene), skinsOf(scene, 0.5f), 0).volume.value(), -0.875, 1e-6);
}

TEST(Volume, HasNoMeaningForCloth) {
    sim::Scene scene;
    sim::addCloth(scene, {.size = {3, 3}, .spacing = 0.1f});
    EXPECT_FALSE(tools::measure(scene, stateOf(scene), skinsOf(scene, 1), 0).volume.has_value());
}

TEST(Momentum, CountsOnlyWhatGravityCannotChange) {
    sim::Scene scene = twoLinks();
    State state = stateOf(scene);
    for (auto& v : state.velocities) v[1] = -3; // falling
    EXPECT_EQ(tools::measure(scene, state, {}, 10).momentum.value(), 0);
    for (auto& v : state.velocities) v[0] = 4;
    EXPECT_NEAR(tools::measure(scene, state, {}, 10).momentum.value(), 0.8, 1e-6);
    for (sim::Particle& p : scene.particles) p.velocity.x = 4;
    EXPECT_NEAR(tools::measure(scene, state, {}, 10).momentum.value(), 0, 1e-6);
}

TEST(Momentum, DecaysWithTheDampingOfTheScene) {
    sim::Scene scene = twoLinks();
    scene.damping = 0.5f;
    scene.dt = 0.1f;
    for (sim::Particle& p : scene.particles) p.velocity.x = 1;
    State state = stateOf(scene);
    for (auto& v : state.velocities) v[0] = static_cast<float>(std::exp(-0.5));
    EXPECT_NEAR(tools::measure(scene, state, {}, 10).momentum.value(), 0, 1e-6);
}

TEST(Momentum, HasNoMeaningWhereSomethingHoldsAParticle) {
    sim::Scene fixed = twoLinks(), plane = twoLinks(), heavy = twoLinks();
    fixed.fixed.push_back({0});
    plane.planes.push_back({});
    heavy.particles[0].inverseMass = 0;
    for (const sim::Scene& scene : {fixed, plane, heavy})
        EXPECT_FALSE(tools::measure(scene, stateOf(scene), {}, 0).momentum.has_value());
}

TEST(Penetration, IsThatOfTheDeepestParticleWithItsOffset) {
    sim::Scene scene = twoLinks();
    EXPECT_FALSE(tools::measure(scene, stateOf(scene), {}, 0).penetrationMax.has_value());
    scene.planes.push_back({.offset = 0.25f});
    scene.particles[1].contactOffset = -0.125f;
    scene.particles[0].inverseMass = 0; // a fixed particle behind a plane does not count
    EXPECT_NEAR(tools::measure(scene, stateOf(scene), {}, 0).penetrationMax.value(), 0.125, 1e-6);
}

TEST(Overlap, IsThatOfEveryPairThatMayTouch) {
    sim::Scene scene;
    // Pairs far from the origin, on both sides of 0 and with different sizes, 0.2 and 0.05 deep.
    scene.particles = {{.position = {-0.45f, 0, 0}, .radius = 0.5f},
                       {.position = {0.35f, 0, 0}, .radius = 0.5f},
                       {.position = {0.35f, 0.7f, 0}, .radius = 0.25f},
                       {.position = {1000, 0, 0}, .radius = 0.5f},
                       {.position = {0, 0, 0}, .radius = 0}};
    const tools::Errors errors = tools::measure(scene, stateOf(scene), {}, 0);
    EXPECT_NEAR(errors.penetrationMax.value(), 0.2, 1e-6);
    EXPECT_NEAR(errors.penetrationRms.value(), std::sqrt((0.04 + 0.0025) / 2), 1e-6);
    EXPECT_EQ(tools::overlapOf(scene, stateOf(scene))->pairs, 2u);
}

TEST(Overlap, IsFoundAsByComparingAllPairs) {
    sim::Scene scene;
    sim::addParticles(scene, {.count = {7, 6, 5}, .spacing = 0.1f, .radius = 0.05f});
    State state = stateOf(scene);
    std::mt19937 random(3);
    for (auto& x : state.positions)
        for (std::size_t axis = 0; axis < 3; ++axis)
            x[axis] += static_cast<float>(random() % 1000) * 1e-4f - 0.05f;
    double most = 0, squares = 0;
    std::size_t pairs = 0;
    for (std::size_t i = 0; i < state.positions.size(); ++i)
        for (std::size_t j = 0; j < i; ++j) {
            double square = 0;
            for (std::size_t axis = 0; axis < 3; ++axis)
                square += std::pow(double{state.positions[i][axis]} - double{state.positions[j][axis]}, 2);
            const double depth = 2 * double{0.05f} - std::sqrt(square);
            if (depth <= 0) continue;
            most = std::max(most, depth);
            squares += depth * depth;
            ++pairs;
        }
    ASSERT_GT(pairs, 200u);
    const tools::Overlap overlap = tools::overlapOf(scene, state).value();
    EXPECT_EQ(overlap.pairs, pairs);
    EXPECT_DOUBLE_EQ(overlap.max, most);
    EXPECT_NEAR(overlap.rms, std::sqrt(squares / static_cast<double>(pairs)), 1e-12);
}

TEST(Overlap, LeavesOutLinkedPairsAndNearOnesOfOneBody) {
    sim::Scene scene;
    sim::addLattice(scene, {.cells = {3, 3, 3}, .spacing = 0.1f, .radius = 0.05f});
    State state = stateOf(scene);
    for (auto& x : state.positions) x[0] *= 0.8f; // neighbours approach to 0.08
    EXPECT_EQ(tools::overlapOf(scene, state)->pairs, 0u);
    for (auto& x : state.positions) x[0] = 0; // particles two cells apart may touch
    EXPECT_GT(tools::overlapOf(scene, state)->pairs, 0u);
    EXPECT_FALSE(tools::overlapOf(cube(), stateOf(cube())).has_value()) << "no radius";
}

TEST(Overlap, SurvivesAStateThatIsNoLongerFinite) {
    sim::Scene scene;
    sim::addParticles(scene, {.count = {2, 2, 2}, .radius = 0.05f});
    State state = stateOf(scene);
    state.positions[0][1] = NAN;
    state.positions[1][0] = 1e38f;
    EXPECT_EQ(tools::overlapOf(scene, state)->max, 0);
}

// Compares with a test of all edges and all faces by signs of volumes.
TEST(Crossings, AreThoseOfEveryEdgeThroughEveryFace) {
    using Vector = std::array<double, 3>;
    std::mt19937 random(7);
    std::uniform_real_distribution<float> place(0, 1);
    std::size_t most = 0;
    for (int configuration = 0; configuration < 40; ++configuration) {
        sim::Scene scene;
        const int faces = 1 + configuration % 20;
        for (int f = 0; f < faces; ++f) {
            const float x = place(random), y = place(random), z = place(random), size = 1.5f * place(random);
            for (int k = 0; k < 3; ++k)
                scene.particles.push_back(
                    {{x + size * place(random), y + size * place(random), z + size * place(random)}});
            const auto a = static_cast<std::uint32_t>(3 * f);
            scene.faces.push_back({{a, a + 1, a + 2}, 0.01f});
        }
        const auto at = [&](std::size_t i) {
            const sim::Vec3& p = scene.particles[i].position;
            return Vector{double{p.x}, double{p.y}, double{p.z}};
        };
        const auto volume = [&](std::size_t i, std::size_t j, std::size_t k, std::size_t l) {
            const Vector a = at(i), b = at(j), c = at(k), d = at(l);
            const auto e = [&](const Vector& v, std::size_t axis) { return v[axis] - a[axis]; };
            return e(b, 0) * (e(c, 1) * e(d, 2) - e(c, 2) * e(d, 1)) -
                   e(b, 1) * (e(c, 0) * e(d, 2) - e(c, 2) * e(d, 0)) +
                   e(b, 2) * (e(c, 0) * e(d, 1) - e(c, 1) * e(d, 0));
        };
        std::size_t expected = 0;
        const std::size_t corners = scene.particles.size();
        for (std::size_t f = 0; f < corners; f += 3)
            for (std::size_t i = 0; i < corners; ++i) {
                if (i / 3 == f / 3) continue;
                const std::size_t j = i / 3 * 3 + (i + 1) % 3, a = f, b = f + 1, c = f + 2;
                const bool isAbove = volume(a, b, c, i) > 0;
                if (isAbove == (volume(a, b, c, j) > 0)) continue;
                const bool ab = volume(i, j, a, b) > 0, bc = volume(i, j, b, c) > 0;
                expected += ab == bc && bc == (volume(i, j, c, a) > 0) ? 1 : 0;
            }
        EXPECT_EQ(tools::crossingsOf(scene, stateOf(scene)), expected) << faces;
        most = std::max(most, expected);
    }
    EXPECT_GT(most, 5u);
}

TEST(Crossings, LeaveOutWhatIsCutRemovedOrNeverMoves) {
    sim::Scene scene;
    scene.particles = {{{0, 0, 0}},        {{1, 0, 0}},       {{0, 1, 0}},
                       {{0.2f, 0.2f, -1}}, {{0.2f, 0.2f, 1}}, {{3, 3, 0}}};
    scene.faces = {{{0, 1, 2}, 0.01f}, {{3, 4, 5}, 0.01f}};
    scene.distances = {{0, 1, 1, 0}};
    EXPECT_EQ(tools::crossingsOf(scene, stateOf(scene)), 2u) << "each has an edge through the other";
    EXPECT_EQ(tools::measure(scene, stateOf(scene), {}, 0).crossings, 2u);
    State cut = stateOf(scene);
    cut.isCut = {true};
    EXPECT_EQ(tools::crossingsOf(scene, cut), 0u);
    State removed = stateOf(scene);
    removed.isRemoved = {false, true, false, false, false, false};
    EXPECT_EQ(tools::crossingsOf(scene, removed), 0u);
    State broken = stateOf(scene);
    broken.positions[5][0] = std::nanf("");
    EXPECT_EQ(tools::crossingsOf(scene, broken), 0u);
    for (sim::Particle& particle : scene.particles) particle.inverseMass = 0;
    EXPECT_FALSE(tools::crossingsOf(scene, stateOf(scene)).has_value());
    EXPECT_FALSE(tools::crossingsOf(cube(), stateOf(cube())).has_value()) << "no faces";
}

TEST(Penetration, IsCountedWhereACollidersPathHasLedIt) {
    sim::Scene scene = twoLinks();
    scene.dt = 0.1f;
    scene.colliders = {{.radius = 0.5f, .margin = 0.125f, .path = {{0, {{50, 0, 0}}}, {1, {}}}}};
    const State state = stateOf(scene);
    const sim::Vec3 x{state.positions[0][0], state.positions[0][1], state.positions[0][2]};
    scene.colliders[0].path[1].pose.position = {x.x, x.y + 0.25f, x.z};
    EXPECT_EQ(tools::measure(scene, state, {}, 0).penetrationMax.value(), 0);
    EXPECT_NEAR(tools::measure(scene, state, {}, 10).penetrationMax.value(), 0.375, 1e-6);
    EXPECT_FALSE(tools::measure(scene, state, {}, 0).momentum.has_value());
}

TEST(StateHash, ChangesWithEveryBitAndOrder) {
    const State state = stateOf(twoLinks());
    EXPECT_EQ(tools::stateHash({}), 0xcbf29ce484222325u); // FNV-1a of an empty input
    State other = state;
    other.velocities[2][2] = std::nextafter(0.0f, 1.0f);
    EXPECT_NE(tools::stateHash(other), tools::stateHash(state));
    other = state;
    std::swap(other.positions[0], other.positions[1]);
    EXPECT_NE(tools::stateHash(other), tools::stateHash(state));
}

TEST(SkinMesh, JoinsCreasesAndTheTwoSidesOfACloth) {
    const sim::Scene scene = cube();
    const mesh::TriangleMesh skin = skinsOf(scene, 1)[0];
    EXPECT_EQ(skin.positions.size(), 26u); // 27 corners except the inner one
    EXPECT_EQ(skin.triangles.size(), 48u);
    EXPECT_TRUE(mesh::inspect(skin).defects.isClosed());
    sim::Scene cloth;
    sim::addCloth(cloth, {.size = {3, 3}, .spacing = 0.1f});
    EXPECT_EQ(skinsOf(cloth, 1)[0].positions.size(), 9u);
    EXPECT_EQ(skinsOf(cloth, 1)[0].triangles.size(), 8u);
}

TEST(SkinMesh, PlacesVerticesInsideCells) {
    sim::Scene scene;
    for (int i = 0; i < 8; ++i)
        scene.particles.push_back({{static_cast<float>(i & 1), static_cast<float>(2 * (i >> 1 & 1)),
                                    static_cast<float>(4 * (i >> 2))}});
    const sim::Skin skin{.cells = {{{0, 1, 2, 3, 4, 5, 6, 7}, {0.25f, 0.5f, 0.75f}}}};
    const sim::Vec3 vertex = tools::skinVertices(scene, skin)[0];
    EXPECT_FLOAT_EQ(vertex.x, 0.25f);
    EXPECT_FLOAT_EQ(vertex.y, 1);
    EXPECT_FLOAT_EQ(vertex.z, 3);
}

TEST(Statistics, TakePercentilesByNearestRank) {
    std::vector<double> values;
    for (int i = 100; i >= 1; --i) values.push_back(i);
    const tools::Statistics hundred = tools::summarise(values).value();
    EXPECT_EQ(hundred.p50, 50);
    EXPECT_EQ(hundred.p99, 99);
    EXPECT_EQ(hundred.mean, 50.5);
    EXPECT_NEAR(hundred.stddev, 29.011492, 1e-6);
    const tools::Statistics one = tools::summarise({7}).value();
    EXPECT_EQ(one.p50, 7);
    EXPECT_EQ(one.p99, 7);
    EXPECT_EQ(one.stddev, 0);
    EXPECT_FALSE(tools::summarise({}).has_value());
}

TEST(StepTimes, AreThoseBetweenEndsThatTheHostSeesOneByOne) {
    tools::StepTimes times;
    times.start(0, 100);
    for (const auto& [step, now] : {std::pair{0u, 110.0}, {1u, 113.0}}) {
        ASSERT_TRUE(times.awaits(step));
        times.see(step, step + 1, now);
        EXPECT_EQ(times.take(), step == 0 ? 10 : 3);
    }
}

TEST(StepTimes, ShareTheTimeOfStepsThatTheHostSeesTogether) {
    tools::StepTimes times;
    times.start(0, 0);
    times.see(0, 4, 2684); // four short runs have one median, and it is not 0
    for (std::uint64_t step = 0; step < 4; ++step) {
        EXPECT_FALSE(times.awaits(step)) << step;
        EXPECT_EQ(times.take(), 671);
    }
    EXPECT_TRUE(times.awaits(4));
    times.see(4, 5, 2690);
    EXPECT_EQ(times.take(), 6);
    times.start(5, 9000); // a pause belongs to no step
    times.see(5, 6, 9002);
    EXPECT_EQ(times.take(), 2);
}

TEST(StepTimes, GiveAStepThatIsRepeatedTheTimeOfBoth) {
    tools::StepTimes times;
    times.start(0, 0);
    times.see(0, 3, 30);
    EXPECT_EQ(times.take(), 10);
    times.undo(1); // steps 1 and 2 come again
    ASSERT_TRUE(times.awaits(1));
    times.see(1, 2, 50);
    EXPECT_EQ(times.take(), 40) << "20 of the undone steps, 20 more";
}

TEST(Extrapolate, FindsOrderAndErrorOfAPowerLaw) {
    for (const double order : {1.0, 2.0, 4.0}) {
        const auto error = [&](double substeps) { return std::pow(substeps, -order); };
        const auto limit = tools::extrapolate(error(16) - error(32), error(32) - error(64));
        ASSERT_TRUE(limit.has_value());
        EXPECT_NEAR(limit->order, order, 1e-9);
        EXPECT_NEAR(limit->finest, error(64), 1e-12);
    }
    EXPECT_EQ(tools::extrapolate(1, 0)->finest, 0) << "the finer runs are equal";
}

TEST(Extrapolate, RefusesDifferencesThatDoNotShrink) {
    EXPECT_FALSE(tools::extrapolate(1, 0.8).has_value());
    EXPECT_FALSE(tools::extrapolate(1, 2).has_value());
    EXPECT_FALSE(tools::extrapolate(0, 0).has_value() && tools::extrapolate(0, 0)->finest != 0);
    EXPECT_FALSE(tools::extrapolate(1, NAN).has_value());
    tools::ErrorEstimate chaos{.steps = 30, .substeps = {32, 64, 128}, .chosen = 64, .difference = 0.2};
    EXPECT_NE(tools::toText(chaos).find("not known"), std::string::npos);
    chaos.order = 2, chaos.ofMotion = 0.004;
    EXPECT_NE(tools::toText(chaos).find("about 0.4 % of the motion, estimated with order 2"),
              std::string::npos);
    EXPECT_NE(tools::toText(chaos).find("64 and 128 substeps differ by 20 %"), std::string::npos);
}
