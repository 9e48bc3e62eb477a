// Tests of pictures of layers, drawn under validation like those of test_pictures.
#include "scene_shot.hpp"
#include "viewer/layers/inspection.hpp"

#include "mesh/generate.hpp"
#include "mesh/to_scene.hpp"

#include <gtest/gtest.h>

namespace sinew::viewer {
namespace {

// A scene with layers, whose color map has its range from the start.
struct LayerShot : SceneShot {
    LayerShot(const sim::Scene& scene, const Layers& on, const Quality& quality = quick)
        : SceneShot(scene, viewOf(scene), quality), layers(on), inspection(test::device(), document, 1) {
        offscreen.prepare(layers);
        inspection.prepare(layers);
    }
    Picture take(float range = 0, const sim::Blade& blade = {}) {
        VkCommandBuffer commands = test::queue().begin();
        if (document.steps() == 0) document.recordReset(commands);
        if (!blade.from.empty()) document.recordStep(commands, nullptr, {}, blade);
        document.recordSkin(commands);
        inspection.record(commands, layers, 0);
        offscreen.record(commands, camera, document.simulation(),
                         {.layers = layers, .buffers = inspection.buffers(layers, mapRange(range))});
        test::queue().wait(test::queue().submit(commands));
        return offscreen.read();
    }
    Layers layers;
    Inspection inspection;
};

sim::Scene stretchedBlock(float stretch) {
    sim::Scene scene = block(0.1f, true);
    for (sim::DistanceConstraint& link : scene.distances) link.restLength /= 1 + stretch;
    for (float& length : scene.grids[0].restLength) length /= 1 + stretch;
    return scene;
}

const Vector3 front(0, 0.3f, 0.2f);

TEST(Layers, ColorSkinsByTheirStrain) {
    constexpr float range = 0.1f;
    std::array<Color, 3> seen;
    for (std::size_t i = 0; i < 3; ++i) {
        LayerShot shot(stretchedBlock(0.5f * range * static_cast<float>(i)), shown({"strain"}));
        seen[i] = colorAt(shot.take(range), shot.camera, front);
    }
    EXPECT_GT(seen[0][2], seen[0][0]) << "blue without strain";
    EXPECT_GT(brightness(seen[1]), brightness(seen[0]) + 40);
    EXPECT_GT(brightness(seen[2]), brightness(seen[1]) + 40);
    EXPECT_GT(seen[2][0], seen[2][2] + 20) << "yellow at the end of the range";
    LayerShot unknown(stretchedBlock(range), shown({"strain"}));
    const Color grey = colorAt(unknown.take(), unknown.camera, front);
    EXPECT_LT(std::abs(grey[0] - grey[2]), 12) << "no range is known yet";
}

TEST(Layers, ColorTheSurfaceOfCutsAsWell) {
    sim::Scene scene = stretchedBlock(0);
    scene.gravity = {0, 0, 0};
    scene.grids[0].isCuttable = true;
    const std::array<sim::Vec3, 2> from{{{0.01f, 1, -1}, {0.01f, 1, 1}}},
        to{{{0.01f, -1, -1}, {0.01f, -1, 1}}};
    LayerShot shot(scene, shown({"strain"}));
    const Picture cut = shot.take(0.1f, {.from = from, .to = to});
    for (const float x : {-0.05f, 0.05f}) { // the cut surface draws the cells along the cut
        const Color color = colorAt(cut, shot.camera, {x, 0.3f, 0.2f});
        EXPECT_GT(color[2], color[0]) << x;
    }
}

TEST(Layers, ColorTheSkinOfACutSheetAsWell) {
    sim::Scene scene;
    sim::addCloth(scene,
                  {.origin = {-0.5f, 0, -0.5f}, .size = {9, 9}, .spacing = 0.125f, .isCuttable = true});
    scene.gravity = {0, 0, 0};
    const std::array<sim::Vec3, 2> from{{{0.06f, 1, -1}, {0.06f, 1, 1}}},
        to{{{0.06f, -1, -1}, {0.06f, -1, 1}}};
    LayerShot shot(scene, shown({"strain"}));
    const Picture cut = shot.take(0.1f, {.from = from, .to = to});
    EXPECT_GT(shot.document.simulation().status(1).linksCut, 0u);
    for (const float x : {-0.2f, 0.02f, 0.11f, 0.3f}) {
        const Color color = colorAt(cut, shot.camera, {x, 0, 0.05f});
        EXPECT_GT(color[2], color[0] + 20) << "no strain, and not grey, at " << x;
    }
}

sim::Scene smallOrgan() {
    sim::Scene scene{.name = "organ", .gravity = {0, 0, 0}};
    mesh::MeshBody body{.name = "organ", .youngModulus = 1e5f, .density = 1050, .isCuttable = true};
    body.voxels.resolution = 12;
    mesh::addMesh(scene, mesh::generate("organ", 32), body);
    return scene;
}

constexpr std::array<sim::Vec3, 2> from{{{0, 1, -1}, {0, 1, 1}}}, to{{{0, -1, -1}, {0, -1, 1}}};

sim::Scene ball() {
    sim::Scene scene{.name = "ball", .gravity = {0, 0, 0}};
    mesh::MeshBody body{.name = "ball", .youngModulus = 1e5f, .density = 1050, .isCuttable = true};
    body.voxels.resolution = 12;
    mesh::addMesh(scene, mesh::generate("sphere", 32), body);
    return scene;
}

// A cut of limited depth in a body at rest has no gap: its lip alone shows it. The cut runs over the top of a
// ball, along x = 0.
TEST(Cuts, AreSeenWhereTheyDoNotGape) {
    const sim::Scene scene = ball();
    const float radius = 0.5f * sceneBounds(scene).sizes().y();
    const Vector3 center = sceneBounds(scene).center();
    for (const Quality& quality : {quick, reducedQuality()}) {
        LayerShot shot(scene, {}, quality);
        shot.camera.azimuth = 0;
        shot.camera.elevation = 0.6f;
        const float bottom = center.y() + 0.4f * radius;
        const std::array<sim::Vec3, 2> end{{{center.x(), bottom, -1}, {center.x(), bottom, 1}}},
            start{{{center.x(), 1, -1}, {center.x(), 1, 1}}};
        const Picture picture = shot.take(0, {.from = start, .to = end});
        const auto at = [&](float x, float angle) {
            const Vector3 out(x, std::cos(angle), std::sin(angle));
            return brightness(colorAt(picture, shot.camera, center + radius * out.normalized()));
        };
        int places = 0, seen = 0;
        for (float angle = 0; angle < 1; angle += 0.02f, ++places) {
            int darkest = at(0, angle);
            for (float x = -0.03f; x <= 0.03f; x += 0.005f) darkest = std::min(darkest, at(x, angle));
            seen += darkest < 0.35 * (at(-0.15f, angle) + at(0.15f, angle)) ? 1 : 0;
        }
        EXPECT_GE(seen, 0.95 * places) << "darker by 30 % than beside it";
    }
}

// A blade cuts from one side of a ball to a place beyond its middle, in planes that contain the eye and are
// therefore seen as lines.
TEST(Cuts, DarkenNothingBesideTheirLip) {
    const sim::Scene scene = ball();
    const float radius = 0.5f * sceneBounds(scene).sizes().y();
    for (const float angle : {0.2f, 0.7f, 1.2f, 1.7f, 2.2f, 2.7f}) {
        LayerShot shot(scene, {});
        shot.camera.target = sceneBounds(scene).center();
        shot.camera.distance *= 0.6f;
        const Picture whole = shot.take();
        const Vector3 ahead = rayThrough(shot.camera, {0, 0}).direction;
        const Vector3 right = ahead.cross(Vector3::UnitY()).normalized(), up = right.cross(ahead);
        const Vector3 way = std::cos(angle) * right + std::sin(angle) * up;
        const auto edgeAt = [&](float place) { // of the blade, in radii from the middle
            const Vector3 a = shot.camera.target + place * radius * way - ahead, b = a + 2 * ahead;
            return std::array<sim::Vec3, 2>{{{a.x(), a.y(), a.z()}, {b.x(), b.y(), b.z()}}};
        };
        const std::array<sim::Vec3, 2> start = edgeAt(-1.5f), end = edgeAt(0.3f);
        const Picture cut = shot.take(0, {.from = start, .to = end});
        int near = 0, beside = 0;
        for (std::uint32_t y = 0; y < whole.height; ++y)
            for (std::uint32_t x = 0; x < whole.width; ++x) {
                const auto sum = [&](const Picture& picture) {
                    const std::uint8_t* at = &picture.pixels[4 * (std::size_t{y} * picture.width + x)];
                    return at[0] + at[1] + at[2];
                };
                if (sum(cut) > 0.85 * sum(whole)) continue;
                const Vector2 place(static_cast<float>(x) + 0.5f - 0.5f * static_cast<float>(whole.width),
                                    0.5f * static_cast<float>(whole.height) - static_cast<float>(y) - 0.5f);
                const float away = std::abs(std::cos(angle) * place.y() - std::sin(angle) * place.x());
                ++(away < 4 ? near : beside);
            }
        EXPECT_GT(near, 100) << angle;
        EXPECT_EQ(beside, 0) << "pixels at least 4 pixels away from a cut at an angle of " << angle;
    }
}

// Regression test. The front of a cut, where its two sides meet, has no normal. Any normal there turned
// through a wide angle within a small triangle, so that the end of an incision had a highlight from most
// places.
TEST(Cuts, AreNotLitByTheNormalsOnTheirFront) {
    sim::Scene scene = ball();
    for (sim::Particle& particle : scene.particles)
        particle.velocity = {particle.position.x < 0 ? -4.0f : 4.0f, 0, 0};
    const std::array<sim::Vec3, 2> end{{{0, 0, -1}, {0, 0, 1}}}, start{{{0, 1, -1}, {0, 1, 1}}};
    for (const Quality& quality : {quick, reducedQuality()}) {
        LayerShot shot(scene, {}, quality);
        shot.camera.azimuth = 0;
        shot.camera.elevation = 1.4f;
        shot.take(0, {.from = start, .to = end});
        const Picture expected = shot.SceneShot::take(1);
        const vk::BufferView view = shot.document.simulation().cutSurface().vertices;
        const auto vertices = test::queue().download<sim::layout::SkinVertex>(view);
        const auto pictureWith = [&](float w, const sim::layout::vec4& normal) {
            auto turned = vertices;
            for (sim::layout::SkinVertex& vertex : turned)
                if (vertex.normal.w == w) vertex.normal = normal;
            test::queue().upload(view, turned.data(), turned.size() * sizeof(turned[0]));
            const VkCommandBuffer commands = test::queue().begin();
            shot.offscreen.record(commands, shot.camera, shot.document.simulation(), {});
            test::queue().wait(test::queue().submit(commands));
            return shot.offscreen.read();
        };
        EXPECT_GT(std::ranges::count(vertices, 1.0f, [](const auto& vertex) { return vertex.normal.w; }), 20);
        EXPECT_EQ(largestDifference(pictureWith(1, {0, 0, -1, 1}), expected), 0);
        EXPECT_EQ(largestDifference(pictureWith(1, {0, 1, 0, 1}), expected), 0);
        EXPECT_GT(largestDifference(pictureWith(0, {0, 0, -1, 0}), expected), 20)
            << "the other normals light it";
    }
}

// Normals and materials are rounded on their way to the shading: a color may change by a step, and a few
// pixels in a penumbra by more.
TEST(Cuts, LookTheSameWhereEachPixelIsShadedOnce) {
    sim::Scene scene = smallOrgan();
    scene.planes.push_back({.normal = {0, 1, 0}, .offset = -0.3f});
    scene.colliders = {{.radius = 0.1f, .pose = {{0.25f, 0, 0}}, .color = {0.5f, 0.45f, 0.42f}}};
    Quality direct = reducedQuality();
    direct.shadesOnce = false;
    LayerShot once(scene, {}, reducedQuality()), often(scene, {}, direct);
    const auto compare = [&](const char* what, const sim::Blade& blade = {}) {
        const Picture a = once.take(0, blade), b = often.take(0, blade);
        std::size_t differing = 0;
        for (std::size_t i = 0; i < a.pixels.size(); ++i)
            differing += std::abs(int{a.pixels[i]} - int{b.pixels[i]}) > 2;
        EXPECT_LE(differing, a.pixels.size() / 10'000) << what;
    };
    compare("whole");
    compare("cut", {.from = from, .to = to});
    for (LayerShot* shot : {&once, &often}) shot->camera.azimuth += 2;
    compare("from the other side");
    for (LayerShot* shot : {&once, &often}) {
        shot->camera.target = sceneBounds(smallOrgan()).center();
        shot->camera.distance = 0.02f;
    }
    compare("from inside");
}

// After a cut all vertices are computed for every picture, with any layers: a picture after all vertices were
// filled with NaN must equal the one before.
TEST(Layers, HaveMadeWhatTheyDrawOnceAMeshIsCut) {
    constexpr std::uint32_t poison = 0x7fc12345; // a NaN
    const sim::Scene scene = smallOrgan();
    for (const Layers& layers : {Layers{}, shown({"glass"}), shown({"wires"}), Layers{.section = Section{}},
                                 shown({"strain"}), shown({"hidden", "particles"})}) {
        LayerShot shot(scene, layers);
        const Picture expected = shot.take(0.1f, {.from = from, .to = to});
        const VkCommandBuffer commands = test::queue().begin();
        vk::Commands(test::device(), commands).fill(shot.document.simulation().skinVertices(), poison);
        test::queue().wait(test::queue().submit(commands));
        EXPECT_EQ(largestDifference(shot.take(0.1f), expected), 0)
            << "skin " << static_cast<int>(layers.skin()) << (layers.has(layer::wires) ? ", wires" : "")
            << (layers.section ? ", section" : "");
    }
}

// Pictures of a scene with all faces in the shadow maps, and with only those that face the light.
struct ShadowTwins {
    explicit ShadowTwins(const sim::Scene& scene) : all(scene, {}, quick), facing(scene, {}, facingAlone()) {
        EXPECT_TRUE(facing.light.areSolidsOutward());
    }
    static Quality facingAlone() {
        Quality quality = quick;
        quality.leavesBacks = true;
        return quality;
    }
    void cut(const sim::Blade& blade) {
        for (LayerShot* shot : {&all, &facing}) shot->take(0, blade);
        EXPECT_EQ(all.document.simulation().status(1).pieces, 2u);
    }
    // Number of pixels that differ after a step.
    int differing() {
        const Picture a = static_cast<SceneShot&>(all).take(1), b = static_cast<SceneShot&>(facing).take(1);
        int count = 0;
        for (std::size_t i = 0; i < a.pixels.size(); i += 4)
            count += std::equal(&a.pixels[i], &a.pixels[i] + 4, &b.pixels[i]) ? 0 : 1;
        return count;
    }
    LayerShot all, facing;
};

// A light first meets the faces of a closed solid that face it, also after a cut into two pieces. At
// silhouettes the finite resolution of the map may select another face: up to 27 of 64,000 pixels differ in
// some states, and none in most.
void expectTheSameShadows(const sim::Scene& scene) {
    constexpr int steps = 20, mostOfOne = 64, mostOnAverage = 8;
    ShadowTwins twins(scene);
    twins.cut({.from = from, .to = to});
    int all = 0;
    for (int step = 0; step < steps; ++step) {
        const int differing = twins.differing();
        EXPECT_LE(differing, mostOfOne) << step << " steps after the cut";
        all += differing;
    }
    EXPECT_LE(all, steps * mostOnAverage);
}

TEST(Layers, ThrowTheSameShadowsWithoutFacesThatLookAway) {
    sim::Scene organ = smallOrgan();
    organ.gravity = {0, -9.81f, 0};
    organ.planes.push_back({.offset = -0.6f});
    expectTheSameShadows(organ);
    sim::Scene cube = block(0.6f, true);
    cube.grids[0].isCuttable = true;
    for (sim::Particle& particle : cube.particles) // the halves separate and rotate
        particle.velocity = {particle.position.x > 0 ? 0.6f : -0.6f, 4 * particle.position.z, 1.5f};
    expectTheSameShadows(cube);
}

TEST(Layers, ShowParticlesInAHiddenAndThroughATranslucentSkin) {
    const sim::Scene scene = block(0.1f, true);
    const auto seen = [&](const Layers& layers) {
        LayerShot shot(scene, layers);
        return shot.take();
    };
    const Camera camera = viewOf(scene);
    const Vector3 between(0.05f, 0.35f, 0.2f); // four balls around it
    const Picture solid = seen({}), hidden = seen(shown({"hidden"})), glass = seen(shown({"glass"})),
                  balls = seen(shown({"hidden", "particles"}));
    EXPECT_LT(redness(colorAt(hidden, camera, between)), 25) << "nothing is left";
    const int through = redness(colorAt(glass, camera, between));
    EXPECT_GT(through, redness(colorAt(hidden, camera, between)));
    EXPECT_LT(through, redness(colorAt(solid, camera, between)));
    EXPECT_GT(redness(colorAt(balls, camera, {0, 0.3f, 0.22f})),
              redness(colorAt(hidden, camera, {0, 0.3f, 0.22f})) + 20)
        << "a particle";
}

TEST(Layers, DrawEdgesOverASkin) {
    const sim::Scene scene = block(0.1f, true);
    LayerShot with(scene, shown({"wires"})), without(scene, {});
    const Picture a = with.take(), b = without.take();
    std::size_t darker = 0, other = 0;
    for (std::size_t i = 0; i < a.pixels.size(); i += 4) {
        const int change = a.pixels[i] - b.pixels[i];
        darker += change < -30;
        other += change > 30;
    }
    EXPECT_GT(darker, 300u);
    EXPECT_EQ(other, 0u);
}

TEST(Layers, MarkContactsThroughTheBody) {
    const sim::Scene scene = block(0, true);
    LayerShot with(scene, shown({"contacts"})), without(scene, {});
    const Picture a = with.take(), b = without.take();
    EXPECT_EQ(with.inspection.part<ContactMarks>(layer::contacts).found(0), 25u);
    const Vector3 hidden(0, 0, 0);
    EXPECT_NE(colorAt(a, with.camera, hidden), colorAt(b, with.camera, hidden))
        << "in the middle, below the body";
}

} // namespace
} // namespace sinew::viewer
