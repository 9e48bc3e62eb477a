// Tests of picking under the pointer, and of grabs from it.
#include "picked.hpp"
#include "viewer/input/inspector.hpp"
#include "viewer/tools/grab_tool.hpp"

#include "sinew/bodies.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace sinew::viewer {
namespace {

namespace layout = sim::layout;

// A block 0.4 m wide around the origin, and a second one 2 m behind it.
sim::Scene blocks() {
    sim::Scene scene;
    for (const float z : {-0.2f, -2.2f}) {
        const sim::Lattice lattice{.origin = {-0.2f, -0.2f, z}, .cells = {4, 4, 4}, .spacing = 0.1f};
        const sim::LatticeCorners corners = sim::addLattice(scene, lattice);
        sim::addLatticeSkin(scene, lattice, corners, {0.7f, 0.1f, 0.1f});
    }
    return scene;
}

const Camera fromFront{.distance = 3, .azimuth = 0, .elevation = 0};

TEST(Pick, FindsTheNearestBodyAndItsParticleWhereTheRayMeetsIt) {
    Picked seen(blocks());
    const auto found = seen.at({{0.11f, 0.02f, 3}, {0, 0, -1}});
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->point.z(), 0.2f, 1e-5f);
    EXPECT_NEAR(found->distance, 2.8f, 1e-5f);
    const sim::Vec3& particle = seen.scene.particles[found->particle].position;
    EXPECT_NEAR(particle.x, 0.1f, 1e-5f);
    EXPECT_NEAR(particle.y, 0, 1e-5f);
    EXPECT_NEAR(particle.z, 0.2f, 1e-5f);
    EXPECT_LT((found->offset - Vector3(0.01f, 0.02f, 0)).norm(), 1e-5f);
}

TEST(Pick, FindsNothingBesideAndBehind) {
    Picked seen(blocks());
    EXPECT_FALSE(seen.at({{0.21f, 0, 3}, {0, 0, -1}}));
    EXPECT_FALSE(seen.at({{0, 0, 3}, {0, 0, 1}}));
}

TEST(Pick, OfWhatIsFixedHoldsNothing) {
    sim::Scene scene = blocks();
    for (std::uint32_t i = 0; i < 125; ++i) scene.fixed.push_back({i});
    Picked seen(scene);
    EXPECT_FALSE(seen.at({{0.11f, 0.02f, 3}, {0, 0, -1}})) << "nor does it reach through it";
    EXPECT_TRUE(seen.at({{0.11f, 0.02f, 3}, {0, 0, -1}}, Among::all));
}

TEST(Pick, MeetsBalls) {
    sim::Scene scene;
    scene.particles = {{.position = {0, 0, 0}, .radius = 0.1f}, {.position = {0, 0, 1}, .radius = 0.1f}};
    scene.bodies = {{.name = "balls", .firstParticle = 0, .particleCount = 2}};
    Picked seen(scene);
    const auto found = seen.at({{0.06f, 0, 3}, {0, 0, -1}});
    ASSERT_TRUE(found);
    EXPECT_EQ(found->particle, 1u);
    EXPECT_NEAR(found->point.z(), 1.08f, 1e-5f);
    EXPECT_FALSE(seen.at({{0.11f, 0, 3}, {0, 0, -1}}));
    EXPECT_EQ(holdRadius(seen.scene, 1), 0) << "what has no links is held alone";
}

TEST(Pick, HoldsAnEighthOfABodyAround) {
    EXPECT_NEAR(holdRadius(blocks(), 62), 0.15f, 1e-5f) << "1.5 spacings, more than 0.4 sqrt(3) / 8";
}

TEST(Inspector, SaysWhatAStateSaysOfAParticle) {
    sim::Scene scene = blocks();
    scene.bodies[1].name = "behind";
    const std::uint32_t first = scene.bodies[1].firstParticle;
    std::vector<layout::vec4> positions;
    for (const sim::Particle& p : scene.particles) // stretched
        positions.push_back({1.1f * p.position.x, p.position.y, p.position.z, p.inverseMass});
    std::vector<layout::vec4> velocities(positions.size(), layout::vec4{3, 4, 0, 0});
    const auto all = [](std::size_t) { return true; };
    const Found found = foundAt(scene, first, positions, velocities, all);
    EXPECT_EQ(found.body, "behind");
    EXPECT_FLOAT_EQ(found.speed.value(), 5);
    ASSERT_TRUE(found.strain);
    EXPECT_NEAR(found.strain->largest, 0.1, 1e-5) << "along x";
    EXPECT_GT(found.strain->rms, 0.01);
    EXPECT_LT(found.strain->rms, found.strain->largest);
    EXPECT_FALSE(foundAt(scene, first, positions, {}, all).speed);
    const auto none = [](std::size_t) { return false; };
    EXPECT_FALSE(foundAt(scene, first, positions, {}, none).strain) << "all of them are cut";
    std::size_t held = scene.distances.size();
    for (std::size_t d = held; d-- > 0;)
        if (scene.distances[d].a == first) held = d;
    const Found one = foundAt(scene, first, positions, {}, [&](std::size_t d) { return d == held; });
    EXPECT_EQ(one.links, 1u) << "the others are cut";
    ASSERT_TRUE(one.strain);
    EXPECT_EQ(one.strain->rms, one.strain->largest);
    EXPECT_FALSE(found.isAsleep);
    positions[first].w = 0;
    EXPECT_TRUE(foundAt(scene, first, positions, {}, all).isAsleep);
    scene.particles[first].inverseMass = 0;
    const Found fixed = foundAt(scene, first, positions, {}, all);
    EXPECT_TRUE(fixed.isFixed);
    EXPECT_FALSE(fixed.isAsleep);
}

TEST(Ray, GoesThroughThePlaceThatThePictureShows) {
    Camera camera = lookingFrom({1.2f, 0.8f, 1.6f}, {0.1f, 0.3f, -0.2f}, 40);
    const float aspect = 1.6f;
    const Vector3 place(0.2f, 0.1f, 0.3f);
    const Eigen::Vector4f clip = clipMatrix(camera, aspect, 100) * place.homogeneous();
    const Vector2 pointer(0.5f * aspect * clip.x() / clip.w(), 0.5f * clip.y() / clip.w());
    const Ray ray = rayThrough(camera, pointer);
    const Vector3 way = place - ray.origin;
    EXPECT_LT(way.cross(ray.direction).norm(), 1e-5f);
    EXPECT_GT(way.dot(ray.direction), 0);
}

TEST(GrabTool, HoldsAtTheDepthAtWhichItTook) {
    GrabTool tool;
    tool.press(fromFront, {0, 0});
    ASSERT_TRUE(tool.question());
    EXPECT_TRUE(tool.grabs().empty()) << "it has to ask first";
    tool.answer(Pick{7, {0, 0, 0.2f}, {0, 0, 0.01f}, 2.8f}, 0.15f);
    ASSERT_EQ(tool.grabs().size(), 1u);
    EXPECT_EQ(tool.grabs()[0].particle, 7u);
    const Vector2 aside(0.1f, -0.05f);
    tool.move(fromFront, aside);
    const sim::Vec3& target = tool.grabs()[0].target;
    EXPECT_NEAR(target.z, 0.2f, 1e-5f);
    const float height = 2 * 2.8f * std::tan(fromFront.fieldOfView / 2);
    EXPECT_NEAR(target.x, 0.1f * height, 1e-5f);
    EXPECT_NEAR(target.y, 0.05f * height, 1e-5f);
    EXPECT_TRUE(tool.drag(aside).isZero()) << "what is held does not turn the camera";
    tool.release();
    EXPECT_TRUE(tool.grabs().empty());
    EXPECT_FALSE(tool.hand());
}

TEST(GrabTool, TurnsTheCameraByAllOfADragBesideBodies) {
    GrabTool tool;
    tool.press(fromFront, {0.5f, 0});
    EXPECT_TRUE(tool.drag({0.1f, 0}).isZero()) << "not known yet";
    tool.answer(std::nullopt, 0);
    EXPECT_EQ(tool.drag({0.2f, 0.1f}), Vector2(0.1f + 0.2f, 0.1f));
    EXPECT_EQ(tool.drag({0.1f, 0}), Vector2(0.1f, 0));
    tool.release();
    EXPECT_TRUE(tool.drag({0.1f, 0}).isZero());
}

TEST(GrabTool, AnAnswerThatComesAfterTheReleaseHoldsNothing) {
    GrabTool tool;
    tool.press(fromFront, {0, 0});
    tool.release();
    tool.answer(Pick{}, 1);
    EXPECT_FALSE(tool.isHolding());
}

} // namespace
} // namespace sinew::viewer
