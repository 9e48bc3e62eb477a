// Tests of the pointer's sphere (poke): its path, without a device, its push on a body below it, and its
// picture.
#include "viewer/document/document.hpp"
#include "viewer/input/state_probe.hpp"
#include "viewer/render/offscreen.hpp"
#include "viewer/tools/poke_tool.hpp"

#include "sinew/bodies.hpp"
#include "support/device.hpp"

#include <gtest/gtest.h>

namespace sinew::viewer {
namespace {

const Camera fromFront{.distance = 3, .azimuth = 0, .elevation = 0};

PokeTool takenUp(std::vector<sim::Plane> planes = {}) {
    PokeTool tool(1, std::move(planes));
    tool.toggle();
    return tool;
}

Vector3 centerOf(const PokeTool& tool) {
    const std::optional<sim::HostCollider> poke = tool.poke();
    EXPECT_TRUE(poke);
    const sim::Vec3 at = poke ? poke->pose.position : sim::Vec3{};
    return {at.x, at.y, at.z};
}

TEST(PokeTool, IsNowhereUntilItIsTakenUpPressedAndAnswered) {
    PokeTool tool(1, {});
    tool.press(fromFront, {0, 0});
    EXPECT_FALSE(tool.question());
    tool.toggle();
    tool.press(fromFront, {0, 0});
    ASSERT_TRUE(tool.question());
    EXPECT_FALSE(tool.poke());
    tool.answer(std::nullopt);
    EXPECT_FALSE(tool.question());
    EXPECT_LT(centerOf(tool).norm(), 1e-6f) << "as far away as what is looked at";
    tool.release();
    EXPECT_FALSE(tool.poke());
    tool.press(fromFront, {0, 0});
    tool.release();
    tool.answer(Pick{.point = {0, 0, 1}});
    EXPECT_FALSE(tool.poke()) << "an answer that comes too late";
    tool.press(fromFront, {0, 0});
    tool.answer(Pick{.point = {0, 0, 1}});
    tool.toggle();
    EXPECT_FALSE(tool.poke()) << "put away";
}

TEST(PokeTool, KeepsTheDepthOfWhatWasUnderThePress) {
    PokeTool tool = takenUp();
    const Vector3 point(0.1f, 0.2f, 0.7f);
    const Vector2 pointer(0.06f, -0.12f); // approximately
    tool.press(fromFront, pointer);
    tool.answer(Pick{.point = point});
    EXPECT_NEAR(centerOf(tool).z(), 0.7f, 1e-6f);
    tool.move(fromFront, {-0.3f, 0.1f});
    EXPECT_NEAR(centerOf(tool).z(), 0.7f, 1e-6f);
    const Vector3 way = centerOf(tool) - eye(fromFront);
    EXPECT_LT(way.cross(rayThrough(fromFront, {-0.3f, 0.1f}).direction).norm(), 1e-5f) << "under the pointer";
}

TEST(PokeTool, GrowsWithinWhatMakesSense) {
    PokeTool tool = takenUp();
    const float first = tool.radius();
    tool.grow(1);
    EXPECT_NEAR(tool.radius(), 1.1f * first, 1e-6f);
    tool.press(fromFront, {0, 0});
    tool.answer(std::nullopt);
    EXPECT_EQ(tool.poke()->radius, tool.radius());
    tool.grow(1000);
    EXPECT_LE(tool.radius(), 1);
    tool.grow(-1000);
    EXPECT_GE(tool.radius(), 0.001f);
    tool.putAway();
    EXPECT_EQ(tool.radius(), first);
    EXPECT_FALSE(tool.isOn());
}

TEST(PokeTool, StaysOnTheGround) {
    PokeTool tool = takenUp({{.offset = -0.5f}});
    tool.press(fromFront, {0, 0});
    tool.answer(std::nullopt);
    EXPECT_EQ(centerOf(tool).y(), 0);
    tool.move(fromFront, {0.1f, 0.4f});
    EXPECT_NEAR(centerOf(tool).y(), tool.radius() - 0.5f, 1e-6f);
    EXPECT_GT(centerOf(tool).x(), 0.1f);
}

using Color = std::array<int, 3>;

Color middleOf(const Picture& picture) {
    const std::size_t at = 4 * ((std::size_t{picture.height} / 2) * picture.width + picture.width / 2);
    return {picture.pixels[at], picture.pixels[at + 1], picture.pixels[at + 2]};
}

// A sphere that sweeps through a floating block carries it along and is visible in front of it.
TEST(PokeTool, PushesABlockAndIsSeen) {
    sim::Scene scene;
    const sim::Lattice lattice{
        .origin = {-0.2f, -0.2f, -0.2f}, .cells = {4, 4, 4}, .spacing = 0.1f, .youngModulus = 1e5f};
    sim::addLatticeSkin(scene, lattice, sim::addLattice(scene, lattice), {0.10f, 0.15f, 0.70f});
    scene.gravity = {0, 0, 0};
    Document document(test::device(), scene, {.substeps = 16, .hostColliders = 1});
    StateProbe probe(test::device(), document.scene(), document.settings(), document.simulation());
    Offscreen offscreen(test::device(), {160, 100}, lightFor(scene, fromFront), {});
    PokeTool tool = takenUp();
    const auto run = [&](int steps) {
        VkCommandBuffer commands = test::queue().begin();
        if (document.steps() == 0) document.recordReset(commands);
        for (int i = 0; i < steps; ++i) {
            const std::optional<sim::HostCollider> poke = tool.poke();
            document.recordStep(commands, nullptr, {}, {},
                                poke ? std::span(&*poke, 1) : std::span<const sim::HostCollider>());
        }
        document.recordSkin(commands);
        probe.record(commands);
        offscreen.record(commands, fromFront, document.simulation(), {});
        test::queue().wait(test::queue().submit(commands));
        return middleOf(offscreen.read());
    };
    const auto isBlue = [](const Color& color) { return color[2] > color[0]; };
    EXPECT_TRUE(isBlue(run(1))) << "the block";
    tool.press(fromFront, {0, 0});
    tool.answer(Pick{.point = {0, 0, 0.2f}});
    EXPECT_FALSE(isBlue(run(1))) << "half of the sphere stands out of it";
    for (int i = 1; i <= 20; ++i) {
        tool.move(fromFront, {0.02f * static_cast<float>(i), 0});
        run(1);
    }
    EXPECT_GT(probe.bounds().min().x(), -0.15f) << "it went along";
    tool.release();
    run(1);
    EXPECT_FALSE(document.simulation().hostColliders()[0].isThere);
}

} // namespace
} // namespace sinew::viewer
