// Pins: what they hold stays where it is while the rest falls, and what is taken out falls after it.
#include "viewer/draw/stage.hpp"
#include "viewer/hands/pins.hpp"
#include "viewer/hands/state_probe.hpp"

#include "sim/bodies.hpp"
#include "support/device.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace sinew::viewer {
namespace {

const Camera fromFront{.distance = 3, .azimuth = 0, .elevation = 0};

Hand handAt(std::uint32_t particle, const Vector3& at) {
    return {.particle = particle, .target = at};
}

TEST(Pins, KeepTheirPlacesAmongTheHands) {
    Pins pins;
    EXPECT_TRUE(pins.add(handAt(3, {0, 0, 0}), 0.1f));
    EXPECT_TRUE(pins.add(handAt(5, {1, 0, 0}), 0.1f));
    EXPECT_TRUE(pins.takeOut(rayThrough(fromFront, Vector2::Zero()), 0.1f)) << "in the middle";
    EXPECT_EQ(pins.count(), 1u);
    EXPECT_TRUE(std::isnan(pins.grabs()[0].target.x)) << "lets go";
    EXPECT_EQ(pins.grabs()[1].particle, 5u);
    while (pins.count() < Pins::most) EXPECT_TRUE(pins.add(handAt(7, {2, 0, 0}), 0.1f));
    EXPECT_EQ(pins.grabs()[1].particle, 5u);
    EXPECT_FALSE(pins.add(handAt(9, {0, 0, 0}), 0.1f)) << "all are in use";
    pins.clear();
    EXPECT_EQ(pins.count(), 0u);
}

TEST(Pins, AreTakenOutFromTheFront) {
    Pins pins;
    pins.add(handAt(1, {0, 0, -1}), 0.1f);
    pins.add(handAt(2, {0.05f, 0, 1}), 0.1f);
    const Ray ray = rayThrough(fromFront, Vector2::Zero());
    EXPECT_FALSE(pins.takeOut(rayThrough(fromFront, {0.3f, 0}), 0.1f)) << "beside them";
    ASSERT_TRUE(pins.takeOut(ray, 0.1f));
    EXPECT_EQ(pins.shown()[0].particle, 1u) << "the one behind is still in";
    ASSERT_TRUE(pins.takeOut(ray, 0.1f));
    EXPECT_FALSE(pins.takeOut(ray, 0.1f));
}

TEST(Pins, HoldABodyAgainstItsWeight) {
    sim::Scene scene;
    sim::addLattice(scene, {.origin = {0, 1, 0}, .cells = {3, 3, 3}, .spacing = 0.1f, .youngModulus = 2e4f});
    Stage stage(test::device(), scene, {.substeps = 16, .grabs = sim::ranges::mostGrabs});
    const auto corner = static_cast<std::uint32_t>(scene.particles.size() - 1);
    const sim::Vec3& x = scene.particles[corner].position;
    const Vector3 at(x.x, x.y, x.z);
    Pins pins;
    pins.add(handAt(corner, at), 0.16f);
    StateProbe probe(test::device(), stage.scene(), stage.settings(), stage.simulation());
    std::array<sim::Grab, sim::ranges::mostGrabs> grabs;
    const auto step = [&](int steps) {
        grabs[0] = emptyHand();
        std::ranges::copy(pins.grabs(), grabs.begin() + 1);
        VkCommandBuffer commands = test::queue().begin();
        if (stage.steps() == 0) stage.recordReset(commands);
        for (int i = 0; i < steps; ++i) stage.recordStep(commands, nullptr, grabs);
        probe.record(commands);
        test::queue().wait(test::queue().submit(commands));
        const sim::layout::vec4& now = probe.positions()[corner];
        return Vector3(now.x, now.y, now.z);
    };
    for (int i = 0; i < 15; ++i) step(3);
    EXPECT_LT((step(3) - at).norm(), 0.02f);
    pins.clear();
    for (int i = 0; i < 9; ++i) step(3);
    EXPECT_LT(step(3).y(), at.y() - 0.5f) << "half a second of a fall of the whole body";
}

} // namespace
} // namespace sinew::viewer
