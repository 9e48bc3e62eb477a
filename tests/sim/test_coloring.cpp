// Tests of colorings without a device: valid on any graph, and with the few colors that regular bodies allow.
#include "sim/compile/compile.hpp"
#include "sim/model/coloring.hpp"
#include "sim/scenes.hpp"
#include "sinew/bodies.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>

using namespace sinew;
using namespace sinew::sim;

namespace {

Coloring colored(const Scene& scene) {
    return colorByParticles(scene, inverseMasses(scene));
}

// Largest number of constraints on a moving particle.
std::uint32_t degreeOf(const Scene& scene) {
    const std::vector<float> inverseMass = inverseMasses(scene);
    std::vector<std::uint32_t> count(scene.particles.size());
    std::uint32_t largest = 0;
    for (const DistanceConstraint& c : scene.distances)
        for (const std::uint32_t end : {c.a, c.b})
            if (inverseMass[end] > 0) largest = std::max(largest, ++count[end]);
    return largest;
}

// Every constraint that can move has one color, and no color uses a moving particle twice.
void expectValid(const Scene& scene, const Coloring& coloring) {
    const std::vector<float> inverseMass = inverseMasses(scene);
    std::vector<int> uses(scene.distances.size());
    std::size_t entries = 0;
    for (std::size_t k = 0; k < coloring.colorCount(); ++k) {
        std::set<std::uint32_t> touched;
        ASSERT_FALSE(coloring.color(k).empty());
        entries += coloring.color(k).size();
        for (const std::uint32_t c : coloring.color(k)) {
            ASSERT_LT(c, scene.distances.size());
            ++uses[c];
            for (const std::uint32_t end : {scene.distances[c].a, scene.distances[c].b})
                EXPECT_TRUE(inverseMass[end] == 0 || touched.insert(end).second)
                    << "color " << k << ", particle " << end;
        }
    }
    EXPECT_EQ(entries, coloring.order.size());
    for (std::size_t c = 0; c < uses.size(); ++c) {
        const bool canMove = inverseMass[scene.distances[c].a] + inverseMass[scene.distances[c].b] > 0;
        EXPECT_EQ(uses[c], canMove ? 1 : 0) << "constraint " << c;
    }
}

// Particles at random places, with constraints between random pairs, some of them double; some particles are
// fixed.
Scene randomGraph(std::uint32_t seed) {
    std::mt19937 random(seed);
    Scene scene;
    const auto particles = static_cast<std::uint32_t>(2 + random() % 60);
    for (std::uint32_t i = 0; i < particles; ++i) {
        const auto coordinate = [&] { return static_cast<float>(random() % 1000) / 1000; };
        scene.particles.push_back({.position = {coordinate(), coordinate(), coordinate()},
                                   .inverseMass = random() % 8 == 0 ? 0.0f : 1.0f});
    }
    const auto constraints = static_cast<std::uint32_t>(random() % (4 * particles));
    for (std::uint32_t c = 0; c < constraints; ++c) {
        const auto a = static_cast<std::uint32_t>(random() % particles);
        const auto b = static_cast<std::uint32_t>((a + 1 + random() % (particles - 1)) % particles);
        scene.distances.push_back({a, b, 0.5f, 0});
    }
    return scene;
}

std::size_t clothColors(std::array<std::uint32_t, 2> size) {
    Scene scene;
    addCloth(scene, {.size = size, .pinned = {0, size[0] - 1}});
    const Coloring coloring = colored(scene);
    expectValid(scene, coloring);
    return coloring.colorCount();
}

std::size_t latticeColors(const Lattice& lattice) {
    Scene scene;
    addLattice(scene, lattice);
    const Coloring coloring = colored(scene);
    expectValid(scene, coloring);
    return coloring.colorCount();
}

} // namespace

TEST(Coloring, OfRandomGraphsIsValidAndNearTheirDegree) {
    for (std::uint32_t seed = 0; seed < 300; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        const Scene scene = randomGraph(seed);
        const Coloring coloring = colored(scene);
        expectValid(scene, coloring);
        const std::uint32_t degree = degreeOf(scene);
        EXPECT_LE(coloring.colorCount(), degree > 0 ? 2 * degree - 1 : 0);
        EXPECT_GE(coloring.colorCount(), degree);
    }
}

TEST(Coloring, OfSheetsTakesEightColors) {
    EXPECT_EQ(clothColors({64, 64}), 8u);
    EXPECT_EQ(clothColors({7, 12}), 8u);
    EXPECT_EQ(clothColors({33, 4}), 8u);
}

TEST(Coloring, OfLatticesTakesEighteenColors) {
    EXPECT_EQ(latticeColors({.cells = {15, 15, 15}}), 18u);
    EXPECT_EQ(latticeColors({.cells = {5, 4, 7}}), 18u);
}

// Holes and steps change the index differences of a full grid, but not its directions.
TEST(Coloring, OfVoxelsOfAnyShapeTakesEighteenColors) {
    Lattice lattice{.origin = {0.3f, -2, 7}, .cells = {9, 8, 10}, .spacing = 0.013f};
    for (std::uint32_t k = 0; k < 10; ++k)
        for (std::uint32_t j = 0; j < 8; ++j)
            for (std::uint32_t i = 0; i < 9; ++i) {
                const bool isHole = i > 5 && j > 4 && k < 3;
                const bool isOutside = (i - 4) * (i - 4) + (j - 4) * (j - 4) + (k - 5) * (k - 5) > 22;
                lattice.fill.push_back(isHole || isOutside ? 0.0f : 1.0f);
            }
    EXPECT_EQ(latticeColors(lattice), 18u);
}

// The links of an index step are solved in the turns from their first to their last color. The ranges of two
// index steps must be nested or disjoint.
TEST(Coloring, NestsTheTurnsOfDirections) {
    for (const std::uint32_t neighbours : {0u, 18u, 26u}) {
        Scene scene;
        if (neighbours == 0)
            addCloth(scene, {.size = {12, 9}, .skipStiffness = 10, .pinned = {0}});
        else
            addLattice(scene, {.cells = {5, 4, 7}, .hasBodyDiagonals = neighbours == 26});
        const Coloring coloring = colored(scene);
        std::map<std::uint32_t, std::set<std::size_t>> turns;
        for (std::size_t turn = 0; turn < coloring.colorCount(); ++turn) {
            const DistanceConstraint& c = scene.distances[coloring.color(turn)[0]];
            turns[std::max(c.a, c.b) - std::min(c.a, c.b)].insert(turn);
        }
        for (const auto& [step, of] : turns)
            for (const auto& [other, inside] : turns) {
                const bool alternate = *of.begin() < *inside.begin() && *inside.begin() < *of.rbegin() &&
                                       *of.rbegin() < *inside.rbegin();
                EXPECT_FALSE(alternate) << neighbours << " neighbours, steps " << step << ", " << other;
            }
    }
}

TEST(Coloring, OfADisturbedSheetStillFindsItsRows) {
    Scene scene = test::sheet(16);
    test::disturb(scene, 0.03f, 0);
    EXPECT_EQ(colored(scene).colorCount(), 8u);
}

TEST(Coloring, OfSeveralBodiesTakesNoMoreThanTheWorstOfThem) {
    Scene scene = test::chain(40);
    addCloth(scene, {.size = {9, 9}, .pinned = {0}});
    addCloth(scene, {.right = {0.8f, 0.6f, 0}, .down = {-0.6f, 0.8f, 0}, .size = {10, 8}});
    addLattice(scene, {.cells = {4, 5, 6}});
    const Coloring coloring = colored(scene);
    expectValid(scene, coloring);
    EXPECT_EQ(coloring.colorCount(), 18u);
}

TEST(Coloring, SharesAParticleThatNeverMoves) {
    Scene scene;
    for (std::uint32_t i = 0; i <= 50; ++i) scene.particles.push_back({});
    for (std::uint32_t i = 1; i <= 50; ++i) scene.distances.push_back({0, i, 1, 0});
    EXPECT_EQ(colored(scene).colorCount(), 50u) << "a hub that moves takes one color a spoke";
    scene.fixed = {{0}};
    EXPECT_EQ(colored(scene).colorCount(), 1u);
    scene.distances.push_back({1, 2, 1, 0});
    EXPECT_EQ(colored(scene).colorCount(), 2u);
    expectValid(scene, colored(scene));
}

TEST(Coloring, OfNothingHasNoColor) {
    EXPECT_EQ(colored({}).colorCount(), 0u);
    Scene scene = test::chain(3);
    scene.fixed = {{0}, {1}, {2}};
    EXPECT_EQ(colored(scene).colorCount(), 0u);
    EXPECT_TRUE(colored(scene).order.empty());
}

TEST(Coloring, SortsEachColorByParticle) {
    const Scene scene = test::block(5, 0.1f, 1e5f);
    const Coloring coloring = colored(scene);
    const auto lower = [&](std::uint32_t c) { return std::min(scene.distances[c].a, scene.distances[c].b); };
    for (std::size_t k = 0; k < coloring.colorCount(); ++k)
        EXPECT_TRUE(std::ranges::is_sorted(coloring.color(k), {}, lower)) << "color " << k;
}

namespace {

void expectValidBends(const Scene& scene) {
    const std::vector<float> inverseMass = inverseMasses(scene);
    const Coloring coloring = colorBends(scene, inverseMass);
    std::vector<int> uses(scene.bends.size());
    for (std::size_t k = 0; k < coloring.colorCount(); ++k) {
        std::set<std::uint32_t> touched;
        ASSERT_FALSE(coloring.color(k).empty());
        for (const std::uint32_t index : coloring.color(k)) {
            ++uses.at(index);
            const BendConstraint& bend = scene.bends[index];
            for (const std::uint32_t i : {bend.a, bend.b, bend.c})
                EXPECT_TRUE(inverseMass[i] == 0 || touched.insert(i).second)
                    << "color " << k << ", particle " << i;
        }
    }
    for (std::size_t c = 0; c < uses.size(); ++c) {
        const BendConstraint& bend = scene.bends[c];
        EXPECT_EQ(uses[c], inverseMass[bend.a] + inverseMass[bend.b] + inverseMass[bend.c] > 0 ? 1 : 0) << c;
    }
}

std::size_t bendColors(const Scene& scene) {
    return colorBends(scene, inverseMasses(scene)).colorCount();
}

} // namespace

TEST(ColoringOfBends, IsValidOnAnyGraph) {
    for (std::uint32_t seed = 0; seed < 10; ++seed) {
        std::mt19937 random(seed);
        Scene scene;
        scene.particles.resize(60);
        for (int k = 0; k < 200; ++k) {
            std::uint32_t ends[3] = {};
            do
                for (std::uint32_t& end : ends) end = static_cast<std::uint32_t>(random() % 60);
            while (ends[0] == ends[1] || ends[1] == ends[2] || ends[0] == ends[2]);
            scene.bends.push_back({ends[0], ends[1], ends[2], 1});
        }
        for (int k = 0; k < 8; ++k) scene.fixed.push_back({static_cast<std::uint32_t>(random() % 60)});
        expectValidBends(scene);
    }
}

TEST(ColoringOfBends, TakesAsManyColorsAsAnInnerParticleHasBends) {
    Scene sheet;
    addCloth(sheet, {.size = {9, 7}, .spacing = 0.1f, .bendingStiffness = 1, .pinned = {0}});
    EXPECT_EQ(bendColors(sheet), 6u);
    expectValidBends(sheet);
    Scene row = test::chain(20);
    for (std::uint32_t i = 2; i < 20; ++i) row.bends.push_back({i - 2, i - 1, i, 1});
    EXPECT_EQ(bendColors(row), 3u);
    EXPECT_EQ(bendColors({}), 0u);
}

TEST(ColoringOfBends, TakesOneColorEachAtAHubThatMoves) {
    Scene hub;
    hub.particles.resize(20'001);
    for (std::uint32_t k = 0; k < 10'000; ++k) hub.bends.push_back({2 * k + 1, 0, 2 * k + 2, 1});
    EXPECT_EQ(bendColors(hub), 10'000u);
    hub.fixed = {{0}};
    EXPECT_EQ(bendColors(hub), 1u);
}
