// Tests of cut links in a body at rest: a through cut leaves no link across it at any orientation to the
// lattice, and a cut can be undone, repeats, and is counted correctly.
#include "common/layout.h"
#include "sim/compile/compile.hpp"
#include "sim/cutting/cut_body.hpp"
#include "sim/lattice/link_masks.hpp"
#include "sim/scenes.hpp"
#include "sinew/bodies.hpp"
#include "sinew/validate.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

using namespace sinew;
using namespace sinew::sim;
using Eigen::Vector3d;
using test::CutBody;
using test::CutPlane;
using test::Sweep;
using test::sweepOf;

namespace {

constexpr float spacing = 0.05f;

struct Material {
    bool hasBodyDiagonals = false;
    float poissonRatio = 0.25f, recovery = 0;
    bool isCuttable = true;
};

// A cube without gravity, at rest.
Scene cube(std::uint32_t cells, const Material& material = {}, std::vector<float> fill = {}) {
    Scene scene{.name = "cube", .gravity = {0, 0, 0}};
    addLattice(scene, {.origin = {0.1f, 0.5f, -0.2f},
                       .cells = {cells, cells, cells},
                       .spacing = spacing,
                       .fill = std::move(fill),
                       .youngModulus = 1e5f,
                       .poissonRatio = material.poissonRatio,
                       .recovery = material.recovery,
                       .hasBodyDiagonals = material.hasBodyDiagonals,
                       .isCuttable = material.isCuttable});
    return scene;
}

Scene sheet(bool isCuttable = true) {
    Scene scene{.name = "sheet", .gravity = {0, 0, 0}};
    addCloth(scene, {.origin = {0, 0.2f, 0},
                     .size = {13, 9},
                     .spacing = spacing,
                     .stretchCompliance = 1e-4f,
                     .shearCompliance = 1e-3f,
                     .isCuttable = isCuttable});
    return scene;
}

Vector3d random(std::mt19937& random) {
    std::uniform_real_distribution<double> uniform(-1, 1);
    const double x = uniform(random), y = uniform(random), z = uniform(random);
    return {x, y, z};
}

std::uint32_t largest(const std::vector<std::uint32_t>& values) {
    return *std::ranges::max_element(values);
}

// A plane between the layers `below` and `below` + 1 along an axis, at `part` of the distance.
CutPlane betweenLayers(const CutBody& body, std::uint32_t below, double part, const Vector3d& normal) {
    return {body.at(body.particleAt(below, below, below)) + part * body.spacing() * normal, normal};
}

} // namespace

// Planes (h, k, l) through particles.
TEST(Cut, LeavesNoLinkAcrossAnyLatticePlaneThroughParticles) {
    CutBody body(cube(6));
    const Vector3d centre = body.at(body.particleAt(3, 3, 3));
    int planes = 0;
    for (int h = -3; h <= 3; ++h)
        for (int k = -3; k <= 3; ++k)
            for (int l = -3; l <= 3; ++l) {
                if (std::gcd(std::gcd(h, k), l) != 1 || std::tuple(h, k, l) < std::tuple(0, 0, 0)) continue;
                const CutPlane plane{centre, Vector3d(h, k, l).normalized()};
                body.runner().reset();
                const Status status = body.cut(sweepOf(plane, 1, 1 + planes % 4));
                ++planes;
                ASSERT_EQ(body.bridges(plane), 0u) << h << " " << k << " " << l;
                ASSERT_EQ(status.pieces, 2u) << h << " " << k << " " << l;
            }
    EXPECT_GE(planes, 74);
}

TEST(Cut, LeavesNoBridgeAmong26NeighboursAcrossRandomPlanes) {
    for (const bool hasBodyDiagonals : {false, true}) {
        CutBody body(cube(7, {.hasBodyDiagonals = hasBodyDiagonals}));
        std::mt19937 numbers(7);
        for (int trial = 0; trial < 20; ++trial) {
            const Vector3d middle = body.at(body.particleAt(3, 3, 3)) + 2 * body.spacing() * random(numbers);
            const CutPlane plane{middle, random(numbers).normalized()};
            body.runner().reset();
            const std::size_t before = body.links().size();
            const Status status = body.cut(sweepOf(plane, 1, 5));
            EXPECT_EQ(body.bridges(plane), 0u) << "trial " << trial;
            EXPECT_GE(status.pieces, 2u);
            EXPECT_LT(body.links().size(), before);
            EXPECT_EQ(body.oneSided(), 0u) << "both ends of a link agree";
            EXPECT_EQ(body.looseLinks(), 0u) << "rule K";
            EXPECT_EQ(body.pieces(), body.expectedPieces());
        }
    }
}

TEST(Cut, GivesTheSameBitsInReversedOrderAndInEveryForm) {
    const Scene scene = cube(6, {.poissonRatio = 0.4f, .recovery = 2});
    const Settings forms[] = {{.substeps = 3},
                              {.substeps = 3, .isReversed = true},
                              {.substeps = 3, .forms = {.usesTexels = false, .columns = 1, .chunk = 3}},
                              {.substeps = 3, .forms = {.columns = 1, .chunk = 1}},
                              {.substeps = 3, .forms = {.residentBytes = 32768}}};
    std::vector<std::vector<std::uint32_t>> words, pieces, cells;
    std::vector<std::uint64_t> hashes;
    for (const Settings& settings : forms) {
        CutBody body(scene, settings);
        const CutPlane planes[] = {{body.at(body.particleAt(3, 3, 3)), Vector3d(1, 0.3, 0.2)},
                                   {body.at(body.particleAt(2, 3, 4)), Vector3d(-0.2, 1, 0.5)}};
        for (const CutPlane& plane : planes) body.cut(sweepOf(plane, 1, 3));
        body.runner().run(3);
        words.push_back(body.words());
        pieces.push_back(body.pieces());
        cells.push_back(body.wholeCells());
        hashes.push_back(body.runner().stateHash());
        EXPECT_EQ(cells.back(), body.expectedWholeCells());
    }
    for (std::size_t f = 1; f < std::size(forms); ++f) {
        EXPECT_EQ(words[f], words[0]) << "form " << f;
        EXPECT_EQ(pieces[f], pieces[0]) << "form " << f;
        EXPECT_EQ(cells[f], cells[0]) << "form " << f;
        EXPECT_EQ(hashes[f], hashes[0]) << "form " << f;
    }
}

TEST(Cut, OfABodyThatMayBeCutCostsItsMotionNoBit) {
    std::vector<float> fill = test::raggedFill(5 * 5 * 5);
    const std::pair<Scene, Scene> pairs[] = {
        {cube(5), cube(5, {.isCuttable = false})},
        {cube(5, {.hasBodyDiagonals = true}), cube(5, {.hasBodyDiagonals = true, .isCuttable = false})},
        {cube(5, {.poissonRatio = 0.4f, .recovery = 1}, fill),
         cube(5, {.poissonRatio = 0.4f, .recovery = 1, .isCuttable = false}, fill)},
        {sheet(), sheet(false)}};
    for (auto [cuttable, other] : pairs)
        for (const bool isInRoom : {false, true}) {
            for (Scene* scene : {&cuttable, &other}) {
                test::disturb(*scene, 0.005f, 1);
                scene->gravity = {0, -9.81f, 0};
                if (isInRoom) test::addRoom(*scene);
            }
            const std::uint64_t expected = test::hashOfRun(other, {.substeps = 5});
            EXPECT_EQ(test::hashOfRun(cuttable, {.substeps = 5}), expected);
            for (const Scene* scene : {&cuttable, &other})
                EXPECT_EQ(test::hashOfRun(*scene, {.substeps = 5, .forms = {.columns = 1, .chunk = 1}}),
                          expected)
                    << "one node an invocation";
        }
}

TEST(Cut, WithDepthLeavesOnePieceAndOnlyLinksOnItsWay) {
    CutBody body(cube(6));
    const CutPlane plane = betweenLayers(body, 2, 0.4, Vector3d::UnitZ());
    Sweep sweep = sweepOf(plane, 1);
    const Vector3d origin = body.at(body.particleAt(0, 0, 0));
    const double depth = origin.y() + 3.5 * body.spacing(); // from above
    for (Vec3* p : {&sweep.from[0], &sweep.from[1], &sweep.to[0], &sweep.to[1]})
        p->y = std::max(p->y, static_cast<float>(depth));
    const Status status = body.cut(sweep);
    EXPECT_EQ(status.pieces, 1u);
    EXPECT_GT(status.linksCut, 0u);
    for (const test::LiveLink& link : body.links()) {
        const Vector3d a = body.at(link.a), b = body.at(link.b);
        const bool isAcross = (a.z() < plane.point.z()) != (b.z() < plane.point.z());
        EXPECT_FALSE(isAcross && std::min(a.y(), b.y()) > depth) << link.a << " to " << link.b;
    }
}

TEST(Cut, StoresWhereALinkWasHitFirst) {
    CutBody body(cube(4));
    body.cut(sweepOf(betweenLayers(body, 1, 0.3, Vector3d::UnitZ()), 1));
    body.cut(sweepOf(betweenLayers(body, 1, 0.8, Vector3d::UnitZ()), 1));
    for (std::uint32_t x = 0; x < 5; ++x)
        for (std::uint32_t y = 0; y < 5; ++y) {
            EXPECT_NEAR(body.hit(body.particleAt(x, y, 1), {0, 0, 1}), 0.3 * 255, 1);
            EXPECT_EQ(body.hit(body.particleAt(x, y, 2), {0, 0, 1}), 0u) << "of a link that is alive";
            if (x < 4 && y < 4) {
                EXPECT_NEAR(body.hit(body.particleAt(x, y, 1), {1, 1, 1}), 0.3 * 255, 1);
            }
        }
}

TEST(Cut, CountsLinksAndPieces) {
    CutBody body(cube(4));
    const std::uint32_t particles = 125;
    Status status = body.runner().run(1);
    EXPECT_EQ(status.pieces, 1u);
    EXPECT_EQ(status.linksCut, 0u);
    const std::size_t stiff = body.scene().distances.size();
    // Between two layers of 5 x 5 nodes: edges, and two face diagonals of each of 4 x 5 squares along x and
    // along y.
    const std::uint32_t across = 25 + 2 * (20 + 20);
    status = body.cut(sweepOf(betweenLayers(body, 1, 0.5, Vector3d::UnitX()), 1));
    EXPECT_EQ(status.linksCut, across);
    EXPECT_EQ(status.pieces, 2u);
    status = body.cut(sweepOf(betweenLayers(body, 1, 0.5, Vector3d::UnitX()), 1));
    EXPECT_EQ(status.linksCut, 0u) << "the same cut again finds nothing";
    status = body.cut(sweepOf(betweenLayers(body, 2, 0.5, Vector3d::UnitX()), 1));
    EXPECT_EQ(status.linksCutInAll, 2 * across);
    EXPECT_EQ(status.pieces, 3u);
    std::vector<std::uint32_t> sizes = body.pieceSizes();
    EXPECT_EQ(std::accumulate(sizes.begin(), sizes.end(), 0u), particles);
    std::erase(sizes, 0u);
    EXPECT_EQ(sizes, (std::vector<std::uint32_t>{50, 25, 50}));
    status = body.runner().run(1);
    EXPECT_EQ(status.linksCut, 0u) << "in a step without a blade";
    EXPECT_EQ(status.linksCutInAll, 2 * across);
    std::size_t alive = 0;
    for (const test::LiveLink& link : body.links())
        alive += lattice::stiffLinks(body.scene().grids[0]) >> link.bit & 1;
    EXPECT_EQ(alive, stiff - 2 * across);
}

// Hard case 22.
TEST(Cut, OfEveryLinkLeavesFreeParticlesThatFall) {
    Scene scene = cube(3);
    scene.gravity = {0, -9.81f, 0};
    CutBody body(scene);
    const Status status = body.runner().cut({}, {.from = {-5, 0.5f, 0}, .to = {5, 0.5f, 0}, .radius = 10});
    EXPECT_EQ(status.pieces, 64u);
    EXPECT_EQ(status.linksCutInAll, scene.distances.size());
    EXPECT_TRUE(body.links().empty());
    EXPECT_EQ(largest(body.pieceSizes()), 1u);
    body.runner().run(20);
    Scene free = scene;
    free.distances.clear();
    free.grids.clear();
    test::Runner expected(free, {.substeps = 2});
    expected.run(21);
    const auto x = body.runner().positions(), y = expected.positions();
    for (std::size_t i = 0; i < x.size(); ++i) EXPECT_LE((x[i] - y[i]).norm(), 1e-6) << "particle " << i;
}

// Hard case 21.
TEST(Cut, OfASingleParticleLetsItFallFreelyFromABodyThatIsHeld) {
    Scene scene = cube(3);
    scene.gravity = {0, -9.81f, 0};
    for (std::uint32_t i = 0; i < scene.particles.size(); ++i)
        if (i != 0) scene.fixed.push_back({i});
    CutBody body(scene);
    const Vector3d start = body.at(0);
    const Vec3 at = test::toFloats(start);
    const Status status =
        body.runner().cut({}, {.from = at, .to = {at.x, at.y - 0.001f, at.z}, .radius = 0.3f * spacing});
    EXPECT_EQ(status.pieces, 2u);
    EXPECT_EQ(status.linksCut, 3u + 3u);
    EXPECT_EQ(body.pieceSizes()[0], 1u);
    body.runner().run(29);
    EXPECT_NEAR(start.y() - body.runner().positions()[0].y(), 9.81 / 2 * 0.5 * 0.5, 1e-4);
}

// The ray of a pointer cuts the links within its radius, and no others.
TEST(RayCut, CutsTheLinksThatComeNearerThanItsRadius) {
    CutBody body(cube(5, {.hasBodyDiagonals = true}));
    const Vector3d from = body.at(body.particleAt(2, 2, 0)) + Vector3d(0.3, 0.4, -9) * body.spacing(),
                   to = from + Vector3d(0.7, 0.2, 12) * body.spacing();
    const double radius = 0.4 * body.spacing();
    const auto before = body.links();
    body.runner().cut(
        {}, {.from = test::toFloats(from), .to = test::toFloats(to), .radius = static_cast<float>(radius)});
    std::vector<bool> isAlive(before.size());
    const auto after = body.links();
    for (std::size_t l = 0, m = 0; l < before.size() && m < after.size(); ++l)
        if (before[l].a == after[m].a && before[l].bit == after[m].bit) isAlive[l] = true, ++m;
    std::size_t cut = 0;
    for (std::size_t l = 0; l < before.size(); ++l) {
        double nearest = std::numeric_limits<double>::infinity(); // by samples on both segments
        const Vector3d a = body.at(before[l].a), b = body.at(before[l].b), e = to - from;
        for (int s = 0; s <= 400; ++s) {
            const Vector3d p = a + s / 400.0 * (b - a);
            const double t = std::clamp((p - from).dot(e) / e.squaredNorm(), 0.0, 1.0);
            nearest = std::min(nearest, (p - from - t * e).norm());
        }
        cut += nearest < radius ? 1 : 0;
        if (nearest < 0.99 * radius) {
            EXPECT_FALSE(isAlive[l]) << nearest / radius;
        }
        const bool isEdge = lattice::isKuhn(lattice::directionOf(before[l].bit));
        if (nearest > 1.01 * radius && isEdge) {
            EXPECT_TRUE(isAlive[l]) << nearest / radius; // rule K may cut others, too
        }
    }
    EXPECT_GT(cut, 20u);
}

TEST(Cut, ThroughASheetLeavesTwoPieces) {
    CutBody body(sheet());
    const CutPlane plane{Vector3d(0.31, 0.2, 0.2), Vector3d(1, 0, 0.4)};
    EXPECT_EQ(body.cut(sweepOf(plane, 2)).pieces, 2u);
    EXPECT_EQ(body.bridges(plane), 0u);
    EXPECT_EQ(body.oneSided(), 0u);
    EXPECT_EQ(body.looseLinks(), 0u);
}

// One dispatch serves several consecutive bodies and skips others between them.
TEST(Cut, MeetsAllBodiesThatMayBeCutAndNoOther) {
    Scene scene{.name = "row", .gravity = {0, 0, 0}};
    for (int i = 0; i < 5; ++i)
        addLattice(scene, {.origin = {static_cast<float>(i), 0, 0},
                           .cells = {3, i < 2 ? 3u : 4u, 3},
                           .spacing = 0.1f,
                           .youngModulus = 1e5f,
                           .isCuttable = i != 3});
    test::Runner runner(scene, {.substeps = 2});
    const Sweep sweep = sweepOf({Vector3d(2, 0.15, 0.15), Vector3d::UnitY()}, 9);
    EXPECT_EQ(runner.run(1).pieces, 4u);
    const Status status = runner.cut(sweep.blade());
    EXPECT_EQ(status.pieces, 8u);
    const auto pieces = test::queue().download<std::uint32_t>(runner.simulation().pieces());
    const Body& uncut = scene.bodies[3];
    for (std::uint32_t i = 0; i < scene.particles.size(); ++i)
        EXPECT_EQ(pieces[i] == NO_PARTICLE,
                  i >= uncut.firstParticle && i < uncut.firstParticle + uncut.particleCount);
}

TEST(Cut, OfAStepThatIsUndoneIsUndoneWithIt) {
    CutBody body(cube(5, {.poissonRatio = 0.4f}));
    const Sweep first = sweepOf(betweenLayers(body, 1, 0.5, Vector3d::UnitX()), 1),
                second = sweepOf(betweenLayers(body, 3, 0.5, Vector3d::UnitX()), 1);
    body.cut(first);
    const auto words = body.words(), pieces = body.pieces(), cells = body.wholeCells();
    body.runner().writePosition(3, std::numeric_limits<float>::quiet_NaN());
    Status status = body.cut(second);
    EXPECT_GT(status.nonFinite, 0u);
    EXPECT_EQ(status.linksCut, 0u);
    EXPECT_EQ(status.pieces, 2u);
    EXPECT_EQ(body.words(), words);
    EXPECT_EQ(body.pieces(), pieces);
    EXPECT_EQ(body.wholeCells(), cells);
    status = body.cut(second);
    EXPECT_EQ(status.nonFinite, 0u);
    EXPECT_EQ(status.pieces, 3u) << "and may be repeated";
}

TEST(Topology, CanBeSavedRestoredAndReset) {
    CutBody body(cube(5, {.poissonRatio = 0.4f}));
    const auto uncut = body.words();
    body.cut(sweepOf(betweenLayers(body, 1, 0.5, Vector3d::UnitX()), 1));
    const auto words = body.words(), pieces = body.pieces(), cells = body.wholeCells();
    const vk::Buffer topology = body.runner().saveTopology();
    EXPECT_EQ(body.cut(sweepOf(betweenLayers(body, 3, 0.5, Vector3d::UnitY()), 1)).pieces, 4u);
    body.runner().loadTopology(topology);
    EXPECT_EQ(body.words(), words);
    EXPECT_EQ(body.pieces(), pieces);
    EXPECT_EQ(body.wholeCells(), cells);
    EXPECT_EQ(body.runner().run(1).pieces, 2u);
    body.runner().reset();
    EXPECT_EQ(body.words(), uncut);
    EXPECT_EQ(body.runner().run(1).pieces, 1u);
}

TEST(Blade, ThatIsNoneCutsNothing) {
    CutBody body(cube(3));
    const auto words = body.words();
    const Sweep whole = sweepOf(betweenLayers(body, 1, 0.5, Vector3d::UnitX()), 1);
    std::vector<Sweep> none(5, whole);
    none[0].to.pop_back();
    none[1] = {.from = {whole.from[0]}, .to = {whole.to[0]}};
    none[2].from[1].y = std::numeric_limits<float>::quiet_NaN();
    none[3].to[0].z = std::numeric_limits<float>::infinity();
    none[4] = {.from = std::vector<Vec3>(257, whole.from[0]), .to = std::vector<Vec3>(257, whole.to[0])};
    for (const Sweep& sweep : none) EXPECT_EQ(body.cut(sweep).linksCut, 0u);
    const RayCut rays[] = {{.from = {0, 0, 0}, .to = {1, 1, 1}, .radius = -1},
                           {.from = {0, NAN, 0}, .to = {1, 1, 1}, .radius = 9},
                           {.from = {0, 0, 0}, .to = {1, 1, 1}, .radius = NAN}};
    for (const RayCut& ray : rays) EXPECT_EQ(body.runner().cut({}, ray).linksCut, 0u);
    EXPECT_EQ(body.words(), words);
    EXPECT_EQ(body.cut({.from = std::vector<Vec3>(256, whole.from[0]), .to = whole.to}).linksCut, 0u);
    EXPECT_GT(body.cut(whole).linksCut, 0u);
}

TEST(Cuttable, IsRefusedWhereNoLinksAreComputed) {
    const auto complaint = [](Scene scene, const Settings& settings) {
        const auto complaints = validate(scene, settings);
        return complaints.empty() ? std::string("none") : complaints.front();
    };
    Scene tied = cube(2);
    tied.particles.push_back({.position = {1, 1, 1}});
    tied.distances.push_back({0, static_cast<std::uint32_t>(tied.particles.size() - 1), 1, 1e-3f});
    EXPECT_EQ(complaint(cube(2), {}), "none");
    EXPECT_NE(complaint(cube(2), {.solver = Solver::jacobi})
                  .find("may be cut, which solver jacobi does not support"),
              std::string::npos);
    EXPECT_NE(complaint(cube(2), {.forms = {.usesGrids = false}}).find("usesGrids"), std::string::npos);
    EXPECT_NE(complaint(tied, {}).find("may be cut, but distance[" +
                                       std::to_string(tied.distances.size() - 1) +
                                       "] holds it beside its own links: leave that out"),
              std::string::npos)
        << complaint(tied, {});
    Scene bent = cube(2);
    addCloth(bent, {.name = "curtain", .origin = {3, 0, 0}, .size = {4, 4}, .bendingStiffness = 1});
    EXPECT_NE(complaint(bent, {}).find("may be cut, but body \"curtain\" has a bending stiffness (bends), "
                                       "beside which split does not support that: make it 0"),
              std::string::npos)
        << complaint(bent, {});
    EXPECT_THROW(addLattice(tied, {.origin = {1e6f, 0, 0}, .spacing = 0.01f, .isCuttable = true}),
                 std::domain_error);
}

TEST(Cuttable, BuffersAndPassesAreInNoOtherScene) {
    const StepProgram plain = compile(cube(4, {.isCuttable = false}), {.substeps = 4}),
                      cuttable = compile(cube(4), {.substeps = 4});
    for (const BufferSpec& buffer : plain.buffers) EXPECT_EQ(buffer.label.find("cut."), std::string::npos);
    const auto recorded = [](const StepProgram& program) { // a step without a blade
        return std::ranges::count(program[List::step], false, &Pass::isOfCut);
    };
    EXPECT_EQ(std::ranges::count(plain[List::step], true, &Pass::isOfCut), 0);
    EXPECT_EQ(recorded(plain), recorded(cuttable)) << "a step without a blade has no pass more";
    const auto barriers = [](const StepProgram& program, Recording recording) {
        return std::ranges::count_if(program[List::step],
                                     [&](const Pass& p) { return hasBarrier(recording, p); });
    };
    EXPECT_EQ(barriers(plain, {}), barriers(cuttable, plainStep));
}
