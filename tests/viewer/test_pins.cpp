// Tests of pins: pinned particles stay in place while the rest falls, and removed pins release them.
#include "mesh/vector3.hpp"
#include "played.hpp"
#include "viewer/document/document.hpp"
#include "viewer/input/inspector.hpp"
#include "viewer/input/state_probe.hpp"
#include "viewer/render/offscreen.hpp"
#include "viewer/tools/pins.hpp"

#include "sinew/bodies.hpp"
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
    Document document(test::device(), scene, {.substeps = 16, .grabs = sim::ranges::mostGrabs});
    const auto corner = static_cast<std::uint32_t>(scene.particles.size() - 1);
    const sim::Vec3& x = scene.particles[corner].position;
    const Vector3 at(x.x, x.y, x.z);
    Pins pins;
    pins.add(handAt(corner, at), 0.16f);
    StateProbe probe(test::device(), document.scene(), document.settings(), document.simulation());
    std::array<sim::Grab, sim::ranges::mostGrabs> grabs;
    const auto step = [&](int steps) {
        grabs[0] = emptyHand();
        std::ranges::copy(pins.grabs(), grabs.begin() + 1);
        VkCommandBuffer commands = test::queue().begin();
        if (document.steps() == 0) document.recordReset(commands);
        for (int i = 0; i < steps; ++i) document.recordStep(commands, nullptr, grabs);
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

// A block whose front is held, or driven to the side.
const std::string heldFront = std::string(block) + R"([[hold]]
name = "clamp"
shape = "half_space"
normal = [0, 0, 1]
offset = 0.15
)";
const std::string drivenFront = heldFront + R"([[hold.keyframe]]
time = 0
[[hold.keyframe]]
time = 0.2
center = [0.4, 0, 0]
)";

std::vector<std::uint32_t> markedIn(const BallList& marks) {
    std::vector<std::uint32_t> marked;
    for (const BallRange& range : marks.ranges)
        for (std::uint32_t i = range.first; i < range.first + range.count; ++i)
            if (marks.radii[i] > 0) marked.push_back(i);
    return marked;
}

TEST(HeldMarks, AreThereForEachHeldParticleAndNoOther) {
    const OpenedScene opening = openText(heldFront);
    ASSERT_EQ(opening.loaded.holds.size(), 1u);
    EXPECT_EQ(opening.loaded.holds[0].particles.size(), 16u);
    EXPECT_EQ(markedIn(opening.light.marks), opening.loaded.holds[0].particles);
    EXPECT_TRUE(openText(block).light.marks.ranges.empty());
}

TEST(HeldMarks, ShowWhatABodyHangsOnButNoBodyThatNeverMoves) {
    sim::Scene scene;
    scene.particles.resize(6, {.inverseMass = 1});
    scene.particles[1].inverseMass = scene.particles[4].inverseMass = scene.particles[5].inverseMass = 0;
    scene.bodies = {{.name = "chain", .firstParticle = 0, .particleCount = 4},
                    {.name = "floor", .firstParticle = 4, .particleCount = 2}};
    scene.distances = {{.a = 1, .b = 2, .restLength = 0.02f}, {.a = 4, .b = 5, .restLength = 0.02f}};
    const BallList hung = marksOf(scene, {}, 0.1f);
    EXPECT_EQ(markedIn(hung), std::vector<std::uint32_t>{1});
    EXPECT_EQ(hung.radii[1], 0.1f) << "there is no mark beside it";
    const std::vector<sim::NamedHold> beside{{"hold", {2}}};
    EXPECT_EQ(marksOf(scene, beside, 0.1f).radii[1], 0.35f * 0.02f) << "there is one";
}

TEST(HeldMarks, AreOneDrawWhereGapsAreShortAndApartWhereTheyAreLong) {
    sim::Scene scene;
    scene.particles.resize(100);
    const std::vector<sim::NamedHold> holds{{"a", {3, 10, 70}}, {"b", {10, 11, 99}}};
    const BallList marks = marksOf(scene, holds, 0.1f);
    EXPECT_EQ(markedIn(marks), (std::vector<std::uint32_t>{3, 10, 11, 70, 99}));
    ASSERT_EQ(marks.ranges.size(), 3u);
    EXPECT_EQ(marks.ranges[0].count, 9u);
    EXPECT_EQ(sim::holdOf(holds, 10)->name, "a") << "the first";
    EXPECT_EQ(sim::holdOf(holds, 99)->name, "b");
    EXPECT_EQ(sim::holdOf(holds, 12), nullptr);
}

TEST(HeldMarks, DoNotHoverBesideASkin) {
    const OpenedScene opening = openText(R"([[mesh]]
name = "ball"
generate = "sphere"
size = 0.2
center = [0, 0, 0]
resolution = 10
[[hold]]
bodies = ["ball"]
shape = "half_space"
normal = [-1, 0, 0]
offset = 0.02)");
    ASSERT_EQ(opening.loaded.holds.size(), 1u);
    const sim::Scene& scene = opening.loaded.scene;
    const std::vector<float>& radii = opening.light.marks.radii;
    int touching = 0, beside = 0;
    for (const std::uint32_t i : opening.loaded.holds[0].particles) {
        const double away = mesh::toVector(scene.particles[i].position).norm() - 0.1; // from the skin
        if (away < 0) {
            EXPECT_GT(radii[i], 0) << "inside, particle " << i;
        }
        if (away > 0.005) {
            EXPECT_EQ(radii[i], 0) << "beside the skin, particle " << i;
        }
        ++(radii[i] > 0 ? touching : beside);
    }
    EXPECT_GT(touching, 50);
    EXPECT_GT(beside, 20);
}

// Pixels as blue as a pin, and their mean column.
struct Blue {
    std::size_t count = 0;
    double column = 0;
};
Blue blueIn(Scene& scene, int steps) {
    Offscreen offscreen(test::device(), {320, 200}, scene.opening.light, reducedQuality());
    scene.run([&](VkCommandBuffer commands) {
        for (int i = 0; i < steps; ++i) scene.step(commands);
        scene.document.recordSkin(commands);
        offscreen.record(commands, scene.controller.camera, scene.document.simulation());
    });
    const Picture picture = offscreen.read();
    Blue blue;
    for (std::size_t i = 0; i < picture.pixels.size(); i += 4) {
        if (picture.pixels[i + 2] < picture.pixels[i] + 60) continue;
        ++blue.count;
        blue.column += static_cast<double>(i / 4 % picture.width);
    }
    if (blue.count > 0) blue.column /= static_cast<double>(blue.count);
    return blue;
}

TEST(HeldMarks, AreSeenAndGoAlongTheirPath) {
    Scene plain, held(heldFront), driven(drivenFront);
    EXPECT_EQ(blueIn(plain, 1).count, 0u);
    const Blue still = blueIn(held, 1), begun = blueIn(driven, 1);
    EXPECT_GT(still.count, 50u);
    const Blue later = blueIn(held, 20), moved = blueIn(driven, 20);
    EXPECT_NEAR(later.column, still.column, 1);
    EXPECT_GT(moved.column, begun.column + 25) << "0.4 m of a picture that is 2.3 m wide";
}

TEST(HeldParticle, SaysTheNameOfItsHold) {
    Found found{.isFixed = true, .hold = "clamp"};
    EXPECT_EQ(stateText(found), "held by clamp");
    found.hold.clear();
    EXPECT_EQ(stateText(found), "fixed");
    found.isFixed = false;
    found.speed = 0.5f;
    EXPECT_EQ(stateText(found), "0.5 m/s");
}

TEST(HeldParticle, IsFoundByTheInspectorWithItsHold) {
    Played played(heldFront);
    Inspector inspector(played.document, played.opening.loaded.holds, 1);
    inspector.toggle();
    const auto under = [&](const Vector2& at) {
        played.run([&](VkCommandBuffer commands) {
            played.document.recordSkin(commands);
            const Ray ray = rayThrough(played.controller.camera, at);
            inspector.record(commands, 0, ray, nullptr);
            played.probe.record(commands);
            played.picker.record(commands, 0, {Picker::Cast{ray, Among::all}});
        });
        inspector.settle(0, played.picker.answer(0, 0), played.probe, nullptr);
        return inspector.found();
    };
    ASSERT_TRUE(under({0, 0}));
    EXPECT_EQ(stateText(*under({0, 0})), "held by clamp");
}

TEST(HeldParticle, IsNoPinAndNSaysSo) {
    Played played(heldFront);
    played.turn({});
    played.turn({.actions = {actionOf(tool::pins)}, .pointer = {0, 0}});
    played.turn({.pointer = {0, 0}});
    played.turn({.pointer = {0, 0}});
    EXPECT_EQ(played.tools.overlay().pins.size(), 0u);
    EXPECT_EQ(played.tools.takeNote(),
              "The scene already holds this point (\"clamp\"), so N can neither pin nor release it.");
}

TEST(HeldParticle, StaysHeldAfterACutAndItsUndo) {
    Played played(heldFront);
    const std::vector<std::uint32_t> held = played.opening.loaded.holds[0].particles;
    const auto largestMove = [&] {
        float largest = 0;
        for (const std::uint32_t i : held) {
            const sim::Vec3& from = played.document.scene().particles[i].position;
            const sim::layout::vec4& now = played.probe.positions()[i];
            largest = std::max(largest, std::hypot(now.x - from.x, now.y - from.y, now.z - from.z));
        }
        return largest;
    };
    played.turn({}, 4);
    played.turn({.actions = {actionOf(tool::blade)}}, 0);
    played.dragFrom({-0.5f, 0.1f}, {1, 0}, 6);
    played.pressAt({0.5f, 0.1f}, false);
    played.turn({}, 10);
    ASSERT_EQ(played.document.simulation().status(played.document.steps()).pieces, 2u);
    EXPECT_EQ(largestMove(), 0) << "cut";
    played.turn({.actions = {Action::undo}}, 0);
    played.turn({}, 20);
    EXPECT_EQ(played.document.simulation().status(played.document.steps()).pieces, 1u);
    EXPECT_EQ(largestMove(), 0) << "undone";
}

} // namespace
} // namespace sinew::viewer
