// Tests that removed fragments are invisible everywhere: balls, lines, marks, values, picking and the lines
// of grabs, under validation.
#include "viewer/document/document.hpp"
#include "viewer/input/picker.hpp"
#include "viewer/input/state_probe.hpp"
#include "viewer/layers/inspection.hpp"
#include "viewer/layers/link_lines.hpp"
#include "viewer/render/offscreen.hpp"

#include "sim/compile/compile.hpp"
#include "sinew/bodies.hpp"
#include "support/device.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>

namespace sinew::viewer {
namespace {

constexpr float spacing = 0.1f, radius = 0.04f;
const std::array<std::uint32_t, 4> corner{0, 1, 5, 25}; // particles

enum class Look { bare, skin, stretched };

// A block of 5 x 5 x 5 particles on the floor, for a cut at its corner (0, 0, 0).
sim::Scene block(std::uint32_t debris, Look look = Look::bare, float speed = 0) {
    sim::Scene scene{.name = "block", .gravity = {0, 0, 0}};
    const sim::Lattice lattice{.origin = {0, radius, 0},
                               .cells = {4, 4, 4},
                               .spacing = spacing,
                               .radius = radius,
                               .isCuttable = true};
    const sim::LatticeCorners corners = sim::addLattice(scene, lattice);
    if (look == Look::skin) sim::addLatticeSkin(scene, lattice, corners, {1, 0, 0});
    if (look == Look::stretched) // a triangle at the corner, and one at the other end
        scene.skins.push_back({.name = "patch",
                               .triangles = {{0, 2, 1}, {3, 4, 5}},
                               .particles = {1, 5, 25, 4, 9, 3},
                               .color = {1, 0, 0}});
    scene.bodies[0].color = {1, 0, 0};
    for (sim::Particle& particle : scene.particles) particle.contactOffset = radius;
    for (const std::uint32_t i : corner) scene.particles[i].velocity = {-speed, 0, -speed};
    scene.planes.push_back({});
    scene.debris = debris;
    return scene;
}

using Sweep = std::array<std::array<sim::Vec3, 2>, 2>;

// A cut that separates these four particles from the rest.
constexpr Sweep cornerCut{
    {{{{-1.96f, 0.08f, 2.04f}, {0.04f, -1.92f, 2.04f}}}, {{{0.04f, 2.08f, -1.96f}, {2.04f, 0.08f, -1.96f}}}}};
// A cut into halves.
constexpr Sweep halfCut{{{{{0.17f, 1, -1}, {0.17f, 1, 1}}}, {{{0.17f, -1, -1}, {0.17f, -1, 1}}}}};

struct Cut {
    explicit Cut(const sim::Scene& scene_, const Layers& on = {}, const Sweep& sweep = cornerCut,
                 int more = 1)
        : layers(on), scene(scene_),
          document(
              test::device(), scene,
              {.substeps = 8, .motions = std::ranges::any_of(scene.bodies, &sim::Body::isAbsent) ? 1u : 0u}),
          inspection(test::device(), document, 1),
          probe(test::device(), scene, document.settings(), document.simulation()) {
        inspection.prepare(layers);
        run([&](VkCommandBuffer commands) { document.recordReset(commands); });
        run([&](VkCommandBuffer commands) {
            document.recordStep(commands, nullptr, {}, sim::Blade{.from = sweep[0], .to = sweep[1]});
            for (int i = 0; i < more; ++i) document.recordStep(commands, nullptr, {}, {});
            document.recordSkin(commands);
            inspection.record(commands, layers, 0);
            probe.record(commands);
        });
    }
    void run(const std::function<void(VkCommandBuffer)>& record) {
        VkCommandBuffer commands = test::queue().begin();
        record(commands);
        test::queue().wait(test::queue().submit(commands));
    }
    std::uint32_t contacts() const { return inspection.part<ContactMarks>(layer::contacts).found(0); }
    std::optional<Pick> at(const Ray& ray) {
        const SceneLight light{.isClosed = closedSkins(scene), .balls = ballsOf(scene)};
        const Picker picker(test::device(), document, light, 1);
        run([&](VkCommandBuffer commands) { picker.record(commands, 0, {Picker::Cast{ray}}); });
        return picker.answer(0, 0);
    }

    Layers layers;
    sim::Scene scene;
    Document document;
    Inspection inspection;
    StateProbe probe;
};

bool isOfCorner(std::uint32_t particle) {
    return std::ranges::count(corner, particle) > 0;
}

TEST(Removed, IsCutOffInTheSceneOfTheseTests) {
    EXPECT_EQ(Cut(block(0)).document.simulation().status(2).pieces, 2u);
    const sim::Status status = Cut(block(5)).document.simulation().status(2);
    EXPECT_EQ(status.pieces, 1u);
    EXPECT_EQ(status.debrisParticles, 4u);
}

TEST(Removed, HasNoLines) {
    for (const std::uint32_t debris : {0u, 5u}) {
        Cut cut(block(debris), shown({"links"}));
        const auto ends =
            test::queue().download<std::uint32_t>(cut.inspection.part<LinkLines>(layer::links).indices());
        std::size_t inside = 0;
        for (std::size_t i = 0; i < ends.size(); i += 2)
            inside += ends[i] != ends[i + 1] && isOfCorner(ends[i]) ? 1 : 0;
        EXPECT_EQ(inside, debris > 0 ? 0u : 6u);
    }
}

TEST(Removed, HasNoMarks) {
    for (const int more : {0, 2}) { // the step after the cut rebuilds lists
        EXPECT_EQ(Cut(block(0), shown({"contacts"}), cornerCut, more).contacts(), 25u);
        EXPECT_EQ(Cut(block(5), shown({"contacts"}), cornerCut, more).contacts(), 25u - 3);
    }
}

TEST(Removed, HasNoValues) {
    for (const char* map : {"strain", "speed", "sleep"})
        for (const std::uint32_t debris : {0u, 5u}) {
            Cut cut(block(debris, Look::bare, 2), shown({map}));
            std::array<float, 125> values{};
            test::queue().download(cut.inspection.buffers(cut.layers).particles, values.data(),
                                   sizeof values);
            for (std::uint32_t i = 0; i < values.size(); ++i)
                EXPECT_EQ(values[i]<0, debris> 0 && isOfCorner(i)) << i;
            if (map != std::string_view("speed")) continue;
            const float largest = cut.inspection.reading(indexOf(layer::colors), 0).values.largest;
            EXPECT_EQ(largest<1, debris> 0) << "the corner flies off at 2.8 m/s";
        }
}

TEST(Removed, IsNotUnderThePointer) {
    const Vector3 along = Vector3(1, 1, 1).normalized();
    const Ray ray{Vector3(0, radius, 0) - along, along};
    for (const Look look : {Look::bare, Look::skin}) {
        const auto kept = Cut(block(0, look)).at(ray), left = Cut(block(5, look)).at(ray);
        ASSERT_TRUE(kept);
        EXPECT_TRUE(isOfCorner(kept->particle));
        ASSERT_TRUE(left) << "what lies behind";
        EXPECT_FALSE(isOfCorner(left->particle));
        EXPECT_GT(left->distance, kept->distance + 0.5f * spacing);
    }
    const auto kept = Cut(block(0, Look::stretched)).at(ray);
    ASSERT_TRUE(kept);
    EXPECT_TRUE(isOfCorner(kept->particle));
    EXPECT_FALSE(Cut(block(5, Look::stretched)).at(ray)) << "a triangle that nothing clips";
}

TEST(Removed, IsNotInThePicture) {
    const float wide = Cut(block(0, Look::bare, 2), {}, cornerCut, 30).probe.bounds().diagonal().norm();
    const float narrow = Cut(block(5, Look::bare, 2), {}, cornerCut, 30).probe.bounds().diagonal().norm();
    const float all = std::sqrt(3.0f) * 4 * spacing;
    EXPECT_GT(wide, 1.5f * all);
    EXPECT_NEAR(narrow, all, 0.1f * all);
}

// Nor are bodies that are absent.
TEST(Removed, AbsentBodiesAreNotInThePicture) {
    for (const bool isCuttable : {false, true}) {
        sim::Scene scene = block(0);
        scene.grids[0].isCuttable = isCuttable;
        const std::size_t first = scene.distances.size();
        sim::addLattice(scene, {.origin = {1, 0, 0}, .cells = {2, 2, 2}, .spacing = spacing});
        scene.bodies.back().isAbsent = true;
        Cut cut(scene);
        EXPECT_LT(cut.probe.bounds().diagonal().norm(), 1);
        const auto isLive = cut.probe.liveLinks();
        for (std::size_t d = 0; d < scene.distances.size(); ++d)
            if (d >= first || !isCuttable) { // the cut parts others
                EXPECT_EQ(isLive(d), d < first) << d;
            }
    }
}

struct Photo {
    explicit Photo(Cut& taken) : cut(taken) {
        camera = framing({}, sceneBounds(cut.scene), 1.6f);
        offscreen.emplace(test::device(), VkExtent2D{320, 200}, lightFor(cut.scene, camera),
                          Quality{.shadowSize = 256,
                                  .floorSize = 128,
                                  .shadowTaps = 4,
                                  .skyTaps = 4,
                                  .samples = VK_SAMPLE_COUNT_1_BIT});
    }
    Picture take(Overlay overlay = {}) {
        overlay.layers = cut.layers;
        overlay.buffers = cut.inspection.buffers(cut.layers);
        offscreen->prepare(overlay.layers);
        cut.run([&](VkCommandBuffer commands) {
            cut.document.recordSkin(commands);
            offscreen->record(commands, camera, cut.document.simulation(), overlay);
        });
        return offscreen->read();
    }

    Cut& cut;
    Camera camera;
    std::optional<Offscreen> offscreen;
};

std::size_t redPixels(const Picture& picture) {
    std::size_t count = 0;
    for (std::size_t at = 0; at < picture.pixels.size(); at += 4)
        count += picture.pixels[at] > 2 * picture.pixels[at + 1] + 20 ? 1 : 0;
    return count;
}

// Both halves of a block are fragments, so that nothing of it is drawn.
TEST(Removed, IsNotDrawn) {
    for (const Look look : {Look::bare, Look::skin})
        for (const bool hasBalls : {false, true}) {
            const Layers layers = hasBalls ? shown({"hidden", "particles"}) : Layers{};
            Cut kept(block(0, look), layers, halfCut), removed(block(200, look), layers, halfCut);
            EXPECT_GT(redPixels(Photo(kept).take()), 500u);
            EXPECT_EQ(redPixels(Photo(removed).take()), 0u);
        }
}

std::size_t differences(const Picture& a, const Picture& b) {
    std::size_t count = 0;
    for (std::size_t at = 0; at < a.pixels.size(); at += 4)
        count += std::memcmp(&a.pixels[at], &b.pixels[at], 4) != 0 ? 1 : 0;
    return count;
}

TEST(Removed, HangsOnNoRope) {
    std::array<std::size_t, 2> drawn{};
    for (const std::uint32_t debris : {0u, 5u}) {
        Cut cut(block(debris));
        Photo photo(cut);
        Overlay holding;
        holding.hand = Hand{0, Vector3::Zero(), Vector3(0, 0.55f, 0)};
        drawn[debris > 0] = differences(photo.take(holding), photo.take());
    }
    EXPECT_GT(drawn[1], 0u) << "the hand itself";
    EXPECT_LT(drawn[1], drawn[0] / 2);
}

} // namespace
} // namespace sinew::viewer
