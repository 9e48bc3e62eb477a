// Tests of skins after a cut: whole triangles away from cuts, their parts beside cuts, and no gap between
// both.
#include "layout.h"
#include "mesh/generate.hpp"
#include "mesh/to_scene.hpp"
#include "sim/bodies.hpp"
#include "sim/cutting/cut_body.hpp"
#include "sim/hash.hpp"
#include "sim/scenes.hpp"
#include "sim/surface/closed_surface.hpp"
#include "sim/surface/mixed_skins.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <bit>
#include <cstring>
#include <map>
#include <numeric>
#include <set>

using namespace sinew;
using namespace sinew::sim;
using namespace sinew::test;
using Eigen::Vector3d;

namespace {

std::vector<Vector3d> verticesOf(test::Runner& runner) {
    std::vector<Vector3d> places;
    for (const auto& vertex : drawnBy(runner, SkinDetail::all)) places.push_back(placeOf(vertex));
    return places;
}

// Expects all vertices drawn with overlap to equal those of a full update, and a quarter of the others to be
// left out.
void expectMadeWhereDrawn(test::Runner& runner, const std::string& when) {
    SCOPED_TRACE(when);
    constexpr std::uint32_t poison = 0x7fc12345; // a NaN
    const Simulation& simulation = runner.simulation();
    const auto cuts = [&] {
        return test::queue().download<layout::SkinVertex>(simulation.cutSurface().vertices);
    };
    const auto isSame = [](const layout::SkinVertex& a, const layout::SkinVertex& b) {
        return std::memcmp(&a, &b, sizeof(a)) == 0;
    };
    const auto all = drawnBy(runner, SkinDetail::all);
    const auto allCuts = cuts();
    const VkCommandBuffer commands = test::queue().begin();
    vk::Commands(test::device(), commands).fill(simulation.skinVertices(), poison);
    test::queue().wait(test::queue().submit(commands));
    const auto some = drawnBy(runner, SkinDetail::drawn, Overlap::some);
    for (const auto& skin : drawnOf(simulation))
        for (const Triangle& triangle : skin)
            for (const std::uint32_t v : triangle) ASSERT_TRUE(isSame(some[v], all[v])) << "vertex " << v;
    EXPECT_TRUE(std::ranges::equal(cuts(), allCuts, isSame)) << "the surface of cuts";
    const auto unseen = std::ranges::count_if(some, [](const layout::SkinVertex& vertex) {
        return std::bit_cast<std::uint32_t>(vertex.position.x) == poison;
    });
    EXPECT_GT(unseen, static_cast<std::ptrdiff_t>(some.size() / 4)) << "of " << some.size();
}

Vector3d areaOf(const Triangle& triangle, const std::vector<Vector3d>& places) {
    const Vector3d &a = places[triangle[0]], &b = places[triangle[1]], &c = places[triangle[2]];
    return 0.5 * (b - a).cross(c - a);
}

} // namespace

TEST(MixedSkin, KnowsWhatItsPartsArePartsOf) {
    const Scene scene = organScene();
    const Skin& skin = scene.skins[0];
    ASSERT_EQ(skin.wholeOf.size(), skin.triangles.size());
    test::Runner runner(scene, {.substeps = 2});
    const std::vector<Vector3d> places = verticesOf(runner);
    std::vector<Vector3d> areas(skin.wholeTriangles.size(), Vector3d::Zero());
    for (std::size_t t = 0; t < skin.triangles.size(); ++t)
        areas[skin.wholeOf[t]] += areaOf(skin.triangles[t], places);
    for (std::size_t w = 0; w < areas.size(); ++w) {
        const Vector3d whole = areaOf(skin.wholeTriangles[w], places);
        ASSERT_LT((areas[w] - whole).norm(), 1e-3 * whole.norm() + 1e-9) << w;
    }
}

TEST(MixedSkin, IsWholeAwayFromACutAndItsPartsBesideIt) {
    const Scene scene = organScene();
    const Skin& skin = scene.skins[0];
    CutBody body(scene);
    const std::vector<Vector3d> places = verticesOf(body.runner());
    const vk::Buffer uncut = body.runner().saveTopology();
    const CutPlane plane{{0, 0, 0}, Vector3d(1, 0.2, 0.1).normalized()};
    ASSERT_GT(body.cut(sweepOf(plane, reach)).linksCutInAll, 0u);
    const Mixed mixed(body.runner().simulation(), skin);

    std::size_t hidden = 0, parted = 0;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::uint32_t>> edges; // whole triangles
    for (std::uint32_t w = 0; w < mixed.wholes.size(); ++w) {
        const bool isWhole = isThere(mixed.wholes[w]);
        ASSERT_TRUE(!isWhole || mixed.wholes[w] == skin.wholeTriangles[w]) << w;
        ASSERT_TRUE(isWhole || mixed.hasAllParts(w)) << w << " is not drawn at all";
        parted += isWhole ? 0 : 1;
        for (const std::size_t t : mixed.partsOf.at(w)) {
            ASSERT_TRUE(!isThere(mixed.parts[t]) || mixed.parts[t] == mixed.left[t])
                << "a piece stands for " << t;
            if (isThere(mixed.left[t])) continue;
            ++hidden;
            ASSERT_FALSE(isWhole) << w << " covers what the blade took";
        }
        double nearest = 1e9;
        for (std::size_t n = 0; n < 3; ++n) {
            const std::uint32_t a = skin.wholeTriangles[w][n], b = skin.wholeTriangles[w][(n + 1) % 3];
            edges[{std::min(a, b), std::max(a, b)}].push_back(w);
            nearest = std::min(nearest, std::abs(plane.normal.dot(places[a] - plane.point)));
        }
        if (nearest < 4 * body.spacing()) continue;
        ASSERT_TRUE(isWhole) << w;
        for (const std::size_t t : mixed.partsOf.at(w)) ASSERT_FALSE(isThere(mixed.parts[t])) << w;
    }
    EXPECT_GT(hidden, 50u);
    EXPECT_GT(parted, 50u);
    for (const auto& [edge, both] : edges) {
        ASSERT_EQ(both.size(), 2u);
        for (std::size_t n = 0; n < 2; ++n)
            ASSERT_TRUE(isThere(mixed.wholes[both[n]]) || mixed.hasAllParts(both[1 - n]))
                << "a gap may open beside " << both[n];
    }
    EXPECT_LT(mixed.count(), 0.6 * static_cast<double>(skin.triangles.size()));

    body.runner().loadTopology(uncut);
    const Mixed undone(body.runner().simulation(), skin);
    EXPECT_EQ(undone.wholes, skin.wholeTriangles);
    EXPECT_EQ(undone.count(), skin.wholeTriangles.size());
}

TEST(MixedSkin, OfSeveralBodiesIsOneBehindTheOther) {
    const Sweep sweep = sweepOf({{0.03, 0, 0}, Vector3d::UnitX()}, reach);
    CutBody alone(organScene());
    alone.cut(sweep);
    const Mixed expected(alone.runner().simulation(), alone.scene().skins[0]);

    Scene scene{.name = "both", .gravity = {0, 0, 0}};
    mesh::TriangleMesh sphere = mesh::generate("sphere", 24);
    for (Vec3& position : sphere.positions) position.y += 3 * static_cast<float>(reach);
    addBody(scene, sphere);
    addOrgan(scene);
    const auto firstVertex = static_cast<std::uint32_t>(scene.skins[0].vertexCount());
    ASSERT_EQ(scene.skins[1].triangles, alone.scene().skins[0].triangles);
    test::Runner both(scene, {.substeps = 2});
    both.cut(sweep.blade());
    const std::vector<std::vector<Triangle>> drawn = drawnOf(both.simulation());
    ASSERT_EQ(drawn.size(), 2u);
    EXPECT_EQ(drawn[0], scene.skins[0].wholeTriangles) << "what is not cut is whole";
    std::vector<Triangle> ofOrgan;
    for (const std::vector<Triangle>& some : {expected.wholes, expected.parts})
        std::ranges::copy_if(some, std::back_inserter(ofOrgan), isThere);
    for (Triangle& triangle : ofOrgan)
        for (std::uint32_t& corner : triangle) corner += firstVertex;
    EXPECT_EQ(drawn[1], ofOrgan);
}

TEST(MixedSkin, DoesNotDependOnOrderOrRoomAndIsTakenOver) {
    const Scene scene = organScene();
    CutBody body(scene), reversed(scene, {.substeps = 2, .isReversed = true});
    const auto all = [](test::Runner& runner) { return drawnOf(runner.simulation()); };
    const Sweep sweep = sweepOf({{0.03, 0, 0}, Vector3d(1, 0.3, 0.2).normalized()}, reach);
    body.cut(sweep);
    reversed.cut(sweep);
    const auto expected = all(body.runner());
    EXPECT_EQ(all(reversed.runner()), expected);
    const auto room = static_cast<std::uint32_t>(body.runner().simulation().cutSurface().vertices.size /
                                                 sizeof(layout::SkinVertex));
    test::Runner roomy(scene, {.substeps = 2, .cutSurfaceRoom = 2 * room});
    roomy.takeOver(body.runner());
    EXPECT_EQ(all(roomy), expected);
    const Sweep second = sweepOf({{-0.05, 0, 0}, Vector3d::UnitX()}, reach);
    body.cut(second);
    roomy.cut(second.blade());
    EXPECT_NE(all(body.runner()), expected);
    EXPECT_EQ(all(roomy), all(body.runner()));
}

TEST(MixedSkin, IsTheSameAfterEveryStrokeHoweverOftenItIsCut) {
    const Scene scene = organScene();
    CutBody once(scene), twice(scene);
    const auto plane = [](double x) { return sweepOf({{x, 0, 0}, Vector3d::UnitX()}, reach); };
    ASSERT_GT(once.cut(plane(0.03)).linksCutInAll, 0u);
    twice.cut(plane(0.03));
    twice.cut(plane(0.03)); // the second cut meets no link
    const auto all = [](CutBody& body) { return drawnOf(body.runner().simulation()); };
    EXPECT_EQ(all(once), all(twice));
    once.cut(plane(-0.05));
    EXPECT_NE(all(once), all(twice));
}

// A box has the outer faces of its cells as a skin, which cannot be reduced.
TEST(MixedSkin, LeavesOtherSkinsAsTheyAre) {
    Scene scene{.name = "both", .gravity = {0, 0, 0}};
    const std::array<std::uint32_t, 3> cells{4, 4, 4};
    Lattice lattice{.name = "box",
                    .origin = {-0.2f, -0.2f, -0.2f},
                    .cells = cells,
                    .spacing = 0.1f,
                    .fill = std::vector<float>(64, 1.0f),
                    .youngModulus = 1e5f,
                    .density = 1000,
                    .isCuttable = true};
    lattice.origin.y += 5;
    addLatticeSkin(scene, lattice, addLattice(scene, lattice), {0.7f, 0.2f, 0.1f});
    const std::size_t ofBox = scene.skins[0].triangles.size();
    addOrgan(scene);
    test::Runner runner(scene, {.substeps = 2});
    runner.cut(sweepOf({{0.03, 0, 0}, Vector3d::UnitX()}, 8).blade());
    const Simulation& simulation = runner.simulation();
    std::vector<Triangle> left = download(simulation.skinIndices());
    left.resize(ofBox);
    std::erase_if(left, [](const Triangle& triangle) { return !isThere(triangle); });
    EXPECT_LT(left.size(), ofBox);
    EXPECT_EQ(drawnOf(simulation)[0], left);
    const Mixed mixed(simulation, scene.skins[1], static_cast<std::uint32_t>(scene.skins[0].vertexCount()));
    EXPECT_GT(std::ranges::count_if(mixed.parts, isThere), 0);
    EXPECT_LT(mixed.count(), scene.skins[1].triangles.size());
    for (const Triangle& whole : mixed.wholes)
        ASSERT_TRUE(!isThere(whole) || std::ranges::min(whole) >= scene.skins[0].vertexCount());
}

namespace {

// Cuts the organ while it falls apart: a fast stroke, a slow one carried over some steps, and one after
// loading an older topology. Calls `look` after each.
template <typename Look> void cutInManyWays(CutBody& body, const Look& look) {
    test::Runner& runner = body.runner();
    const vk::Buffer uncut = runner.saveTopology();
    ASSERT_GT(body.cut(sweepOf({{0.03, 0, 0}, Vector3d(1, 0.2, 0.1).normalized()}, reach)).linksCutInAll, 0u);
    look("after a cut");
    runner.run(10);
    look("ten steps later");
    const Vector3d along = 0.15 * Vector3d::UnitZ();
    for (int s = 0; s < 8; ++s) {
        const Vector3d top(-0.05, 0.2 - 0.04 * s, 0);
        Sweep slow;
        for (const double end : {-1.0, 1.0}) {
            slow.from.push_back(test::toFloats(top + end * along));
            slow.to.push_back(test::toFloats(top - Vector3d(0, 0.04, 0) + end * along));
        }
        slow.isCarried = s > 0;
        body.cut(slow);
        if (s % 3 == 1) look("in a slow stroke");
    }
    runner.loadTopology(uncut);
    look("undone");
    body.cut(sweepOf({{0, 0, 0}, Vector3d(0.3, 1, 0.4).normalized()}, reach));
    look("cut again");
}

Scene fallingOrgan() {
    Scene scene = organScene();
    scene.gravity = {0, -9.81f, 0};
    return scene;
}

} // namespace

// While a body gapes, and within a slow stroke.
TEST(MixedSkin, IsMadeWhereItIsDrawnAlone) {
    for (const bool usesTexels : {true, false}) {
        CutBody body(fallingOrgan(), {.substeps = 2, .forms = {.usesTexels = usesTexels}});
        cutInManyWays(body, [&](const char* when) { expectMadeWhereDrawn(body.runner(), when); });
    }
}

// Kernels of skins and blades either fetch texels or load from buffers.
TEST(MixedSkin, AndSurfaceOfCutsHaveTheSameBitsInBothForms) {
    std::vector<std::uint64_t> hashes[2];
    for (const bool usesTexels : {true, false}) {
        CutBody body(fallingOrgan(), {.substeps = 2, .forms = {.usesTexels = usesTexels}});
        cutInManyWays(body, [&](const char*) {
            hashes[usesTexels ? 1 : 0].push_back(test::ClosedSurface(body).hash());
            const std::vector<Triangle> drawn = drawnOf(body.runner().simulation())[0];
            hashes[usesTexels ? 1 : 0].push_back(fnv1a(std::as_bytes(std::span(drawn))));
        });
    }
    EXPECT_EQ(hashes[0].size(), 14u);
    EXPECT_EQ(hashes[0], hashes[1]);
}
