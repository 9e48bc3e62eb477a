// Split skins: which parts a whole triangle has, and the same bits of normals in every form and order.
#include "common/layout.h"
#include "mesh/generate.hpp"
#include "sim/core/hash.hpp"
#include "sim/cutting/cut_body.hpp"
#include "sim/scenes.hpp"
#include "sim/surface/closed_surface.hpp"
#include "sim/surface/split_skins.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <span>

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

using Hashes = std::array<std::uint64_t, 2>;

// Hashes of the triangles that are drawn, and of the vertices of all skins.
Hashes hashesOf(test::Runner& runner) {
    const std::vector<layout::SkinVertex> vertices = drawnBy(runner, SkinDetail::all);
    const std::vector<Triangle> drawn = drawnOf(runner.simulation());
    return {fnv1a(std::as_bytes(std::span(drawn))), fnv1a(std::as_bytes(std::span(vertices)))};
}

Vector3d areaOf(const Triangle& triangle, const std::vector<Vector3d>& places) {
    const Vector3d &a = places[triangle[0]], &b = places[triangle[1]], &c = places[triangle[2]];
    return 0.5 * (b - a).cross(c - a);
}

} // namespace

TEST(SplitSkin, KnowsWhatItsPartsArePartsOf) {
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

// The numbers of vertices and of whole triangles of a skin count from those before it.
TEST(SplitSkin, IsLitBehindOtherBodiesAsAlone) {
    const Sweep sweep = sweepOf({{0.03, 0, 0}, Vector3d::UnitX()}, reach);
    CutBody alone(organScene());
    alone.cut(sweep);
    const std::vector<layout::SkinVertex> expected = drawnBy(alone.runner(), SkinDetail::all);

    Scene scene{.name = "both", .gravity = {0, 0, 0}};
    mesh::TriangleMesh sphere = mesh::generate("sphere", 24);
    for (Vec3& position : sphere.positions) position.y += 3 * static_cast<float>(reach);
    addBody(scene, sphere);
    addOrgan(scene);
    const std::size_t first = scene.skins[0].vertexCount();
    ASSERT_EQ(scene.skins[1].triangles, alone.scene().skins[0].triangles);
    test::Runner both(scene, {.substeps = 2});
    both.cut(sweep.blade());
    const std::vector<layout::SkinVertex> vertices = drawnBy(both, SkinDetail::all);
    ASSERT_EQ(vertices.size(), first + expected.size());
    for (std::size_t v = 0; v < expected.size(); ++v)
        ASSERT_LT((normalOf(vertices[first + v]) - normalOf(expected[v])).norm(), 1e-5) << v;
    const auto ofOrgan = [&](const Triangle& triangle) { return std::ranges::min(triangle) >= first; };
    EXPECT_EQ(std::ranges::count_if(drawnOf(both.simulation()), ofOrgan),
              std::ssize(drawnOf(alone.runner().simulation())));
}

TEST(SplitSkin, DoesNotDependOnOrderOrRoomAndIsTakenOver) {
    const Scene scene = organScene();
    CutBody body(scene), reversed(scene, {.substeps = 2, .isReversed = true});
    const Sweep sweep = sweepOf({{0.03, 0, 0}, Vector3d(1, 0.3, 0.2).normalized()}, reach);
    body.cut(sweep);
    reversed.cut(sweep);
    const Hashes expected = hashesOf(body.runner());
    EXPECT_EQ(hashesOf(reversed.runner()), expected);
    const auto room = static_cast<std::uint32_t>(body.runner().simulation().cutSurface().vertices.size /
                                                 sizeof(layout::SkinVertex));
    test::Runner roomy(scene, {.substeps = 2, .cutSurfaceRoom = 2 * room});
    roomy.takeOver(body.runner());
    EXPECT_EQ(hashesOf(roomy), expected);
    const Sweep second = sweepOf({{-0.05, 0, 0}, Vector3d::UnitX()}, reach);
    body.cut(second);
    roomy.cut(second.blade());
    const Hashes after = hashesOf(body.runner());
    EXPECT_NE(after[0], expected[0]);
    EXPECT_NE(after[1], expected[1]);
    EXPECT_EQ(hashesOf(roomy), after);
}

// The second stroke through one plane finds nothing left to be cut.
TEST(SplitSkin, IsTheSameAfterEveryStrokeHoweverOftenItIsCut) {
    const Scene scene = organScene();
    CutBody once(scene), twice(scene);
    const auto plane = [](double x) { return sweepOf({{x, 0, 0}, Vector3d::UnitX()}, reach); };
    ASSERT_GT(once.cut(plane(0.03)).linksCutInAll, 0u);
    twice.cut(plane(0.03));
    once.runner().run(1);
    twice.cut(plane(0.03));
    EXPECT_EQ(hashesOf(once.runner()), hashesOf(twice.runner()));
    once.cut(plane(-0.05));
    EXPECT_NE(hashesOf(once.runner())[0], hashesOf(twice.runner())[0]);
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

// Kernels of skins and blades either fetch texels or load from buffers.
TEST(SplitSkin, AndSurfaceOfCutsHaveTheSameBitsInBothForms) {
    std::vector<std::uint64_t> hashes[2];
    for (const bool usesTexels : {true, false}) {
        CutBody body(fallingOrgan(), {.substeps = 2, .forms = {.usesTexels = usesTexels}});
        cutInManyWays(body, [&](const char*) {
            hashes[usesTexels ? 1 : 0].push_back(test::ClosedSurface(body).hash());
            for (const std::uint64_t hash : hashesOf(body.runner()))
                hashes[usesTexels ? 1 : 0].push_back(hash);
        });
    }
    EXPECT_EQ(hashes[0].size(), 21u);
    EXPECT_EQ(hashes[0], hashes[1]);
}
