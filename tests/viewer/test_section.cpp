// Tests of the section plane: its position, the visible parts of bodies, and picking on it. Pictures are
// drawn under validation (support/device.hpp).
#include "picked.hpp"
#include "scene_shot.hpp"
#include "viewer/layers/inspection.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

namespace sinew::viewer {
namespace {

const Camera fromFront{.distance = 3, .azimuth = 0, .elevation = 0};
const Box unit(Vector3(-0.5f, -0.5f, -0.5f), Vector3(0.5f, 0.5f, 0.5f));

// Blocks 0.4 m wide behind each other along z, the nearest around the origin.
sim::Scene blocks(std::initializer_list<float> depths) {
    sim::Scene scene;
    scene.gravity = {};
    for (const float z : depths) {
        const sim::Lattice lattice{
            .origin = {-0.2f, -0.2f, z - 0.2f}, .cells = {4, 4, 4}, .spacing = 0.1f, .isCuttable = true};
        const sim::LatticeCorners corners = sim::addLattice(scene, lattice);
        sim::addLatticeSkin(scene, lattice, corners, {0.1f, 0.5f, 0.1f});
    }
    return scene;
}

// A vertical sheet in the plane z = 0, visible from both sides.
sim::Scene sheet() {
    sim::Scene scene;
    sim::addMeshCollider(
        scene, {.vertices = {{-0.2f, -0.2f, 0}, {0.2f, -0.2f, 0}, {0.2f, 0.2f, 0}, {-0.2f, 0.2f, 0}},
                .triangles = {{0, 1, 2}, {0, 2, 3}}});
    return scene;
}

// Blocks are drawn as rubber; `isTissue`: as tissue, whose inside has another color.
SceneLight lightOf(const sim::Scene& scene, bool isTissue) {
    SceneLight light = lightFor(scene, fromFront);
    if (isTissue) std::ranges::fill(light.gloss, 1.0f);
    return light;
}

struct Shot {
    explicit Shot(const sim::Scene& scene, VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_4_BIT,
                  bool isTissue = true)
        : light(lightOf(scene, isTissue)), document(test::device(), scene, {}),
          offscreen(test::device(), extent, light,
                    {.shadowSize = 256, .floorSize = 64, .shadowTaps = 8, .skyTaps = 8, .samples = samples}),
          inspection(test::device(), document, 1) {}

    Picture take(const Camera& camera, const Layers& layers) {
        VkCommandBuffer commands = test::queue().begin();
        document.recordReset(commands);
        document.recordSkin(commands);
        offscreen.prepare(layers);
        inspection.prepare(layers);
        if (layers.needsBuffers()) inspection.record(commands, layers, 0);
        offscreen.record(commands, camera, document.simulation(),
                         {.layers = layers, .buffers = inspection.buffers(layers, mapRange(1))});
        test::queue().wait(test::queue().submit(commands));
        Picture picture = offscreen.read();
        if (const char* folder = std::getenv("SINEW_PICTURES")) // to look at
            writePng(std::filesystem::path(folder) / ("section-" + std::to_string(count++) + ".png"), picture,
                     {});
        return picture;
    }

    SceneLight light;
    Document document;
    Offscreen offscreen;
    Inspection inspection;
    inline static int count = 0;
};

bool isGreen(const Color& color) {
    return color[1] > color[0] + 20 && color[1] > color[2] + 20;
}
bool isFlesh(const Color& color) {
    return color[0] > color[1] + 10;
} // inside of a green body
bool isGrey(const Color& color) {
    return std::abs(color[0] - color[1]) < 25 && std::abs(color[1] - color[2]) < 40;
}

std::size_t differences(const Picture& a, const Picture& b) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) count += std::abs(a.pixels[i] - b.pixels[i]) > 2;
    return count;
}

TEST(Section, FacesTheCameraAlongTheNearestAxisAndStaysAtItsBounds) {
    Camera camera = fromFront;
    camera.azimuth = -1.3f;
    const Section section = sectionAcross(camera);
    EXPECT_EQ(section.normal, Vector3(-1, 0, 0));
    EXPECT_FLOAT_EQ(section.offset, 0);
    EXPECT_TRUE(isCutAway(section, {-0.1f, 0, 0}));
    EXPECT_FALSE(isCutAway(section, {0.1f, 0, 0}));
    EXPECT_NEAR(moved(section, 10, unit).offset, 0.2f, 1e-6f);
    EXPECT_NEAR(moved(section, -1000, unit).offset, -0.5f, 1e-6f);
    const Section facing = sectionFacing(camera);
    EXPECT_NEAR(facing.normal.dot((eye(camera) - camera.target).normalized()), 1, 1e-5f);
    Section turning = sectionAcross(fromFront);
    std::vector<Vector3> normals;
    for (int i = 0; i < 6; ++i) {
        turning = turned(turning, {0, 0, 0.1f});
        for (const Vector3& before : normals) EXPECT_NE(turning.normal, before);
        normals.push_back(turning.normal);
    }
    EXPECT_EQ(turning.normal, Vector3(0, 0, 1)) << "and round again";
    EXPECT_FLOAT_EQ(turning.offset, 0.1f);
}

TEST(Section, KnowsWhatIsClosed) {
    EXPECT_EQ(closedSkins(blocks({0, -1})), (std::vector{true, true}));
    EXPECT_EQ(closedSkins(sheet()), (std::vector{false}));
    sim::Scene holed = blocks({0});
    holed.skins[0].triangles.pop_back();
    EXPECT_EQ(closedSkins(holed), (std::vector{false}));
    EXPECT_EQ(outwardSkins(holed), (std::vector{false}));
}

TEST(Section, KnowsWhatFacesOutwards) {
    sim::Scene scene = blocks({0, -1});
    EXPECT_EQ(outwardSkins(scene), (std::vector{true, true}));
    for (auto& triangle : scene.skins[1].triangles) std::swap(triangle[0], triangle[1]);
    EXPECT_EQ(outwardSkins(scene), (std::vector{true, false}));
    EXPECT_EQ(closedSkins(scene), (std::vector{true, true}));
}

TEST(Section, LaysOpenTheInsideOfABodyAsASolid) {
    Shot shot(blocks({0}));
    const Vector3 middle(0.03f, 0.05f, 0);
    EXPECT_TRUE(isGreen(colorAt(shot.take(fromFront, {}), fromFront, {0.03f, 0.05f, 0.2f})));
    Layers layers{.section = Section{Vector3::UnitZ(), 0}};
    Camera camera = fromFront;
    camera.azimuth = 0.5f;
    camera.elevation = 0.4f;
    const Picture opened = shot.take(camera, layers);
    for (const Vector3& at : {middle, Vector3(-0.15f, -0.15f, 0), Vector3(0.15f, 0.15f, 0)})
        EXPECT_TRUE(isFlesh(colorAt(opened, camera, at))) << at.transpose();
    EXPECT_TRUE(isGreen(colorAt(opened, camera, {0, 0.2f, -0.1f}))) << "its top, behind the plane";
    EXPECT_TRUE(isGrey(colorAt(opened, camera, {0, -0.19f, 0.19f}))) << "what was before it is gone";
    layers.section->normal = -Vector3::UnitZ();
    EXPECT_TRUE(isGreen(colorAt(shot.take(camera, layers), camera, {0, 0, 0.2f})))
        << "seen from behind there is the skin";
    layers.section = Section{Vector3::UnitZ(), -0.3f};
    EXPECT_TRUE(isGrey(colorAt(shot.take(camera, layers), camera, middle)))
        << "all of it is before the plane";
}

TEST(Section, ShowsThatRubberIsInsideLikeItsSurface) {
    Shot shot(blocks({0}), VK_SAMPLE_COUNT_4_BIT, false);
    const Picture opened = shot.take(fromFront, {.section = Section{Vector3::UnitZ(), 0}});
    for (const Vector3& at : {Vector3(0.03f, 0.05f, 0), Vector3(-0.15f, -0.15f, 0)})
        EXPECT_TRUE(isGreen(colorAt(opened, fromFront, at))) << at.transpose();
}

TEST(Section, LooksTheSameWithOneSampleAPixel) {
    Shot one(blocks({0}), VK_SAMPLE_COUNT_1_BIT), four(blocks({0}));
    const Layers layers{.section = Section{Vector3(0.6f, 0, 0.8f), 0.05f}};
    const Picture rough = one.take(fromFront, layers), smooth = four.take(fromFront, layers);
    EXPECT_TRUE(isFlesh(colorAt(rough, fromFront, {0, 0, 0.0625f})));
    EXPECT_LT(differences(rough, smooth), std::size_t{4 * 320 * 200 / 20}) << "but for edges and shadows";
}

TEST(Section, OpensEachOfSeveralBodiesAndNothingBehindThem) {
    const sim::Scene scene = blocks({0, -0.6f});
    Shot shot(scene);
    Camera camera = fromFront;
    camera.elevation = 0.6f;
    const Picture first = shot.take(camera, {.section = Section{Vector3::UnitZ(), 0}});
    EXPECT_TRUE(isFlesh(colorAt(first, camera, {0, 0, 0})));
    EXPECT_TRUE(isGreen(colorAt(first, camera, {0, 0.2f, -0.6f}))) << "the one behind is whole";
    const Picture both = shot.take(camera, {.section = Section{Vector3::UnitX(), 0}});
    EXPECT_TRUE(isGreen(colorAt(both, camera, {-0.1f, 0.2f, 0})));
    Camera fromSide = fromFront;
    fromSide.azimuth = 1.2f;
    const Picture sides = shot.take(fromSide, {.section = Section{Vector3::UnitX(), 0}});
    for (const float z : {0.0f, -0.6f}) EXPECT_TRUE(isFlesh(colorAt(sides, fromSide, {0, 0, z}))) << z;
    EXPECT_TRUE(isGrey(colorAt(sides, fromSide, {0, 0, -0.3f}))) << "between them there is nothing";
}

// In a block of which each particle is as fast as it is far to the right.
TEST(Section, CarriesTheValuesOfAColorMap) {
    sim::Scene scene = blocks({0});
    for (sim::Particle& particle : scene.particles)
        particle.velocity = {0, 2.5f * (particle.position.x + 0.2f), 0};
    const Layers whole = shown({"speed"}), opened = shown({"speed"}, Section{Vector3::UnitZ(), 0.03f});
    for (const VkSampleCountFlagBits samples : {VK_SAMPLE_COUNT_4_BIT, VK_SAMPLE_COUNT_1_BIT}) {
        Shot shot(scene, samples);
        const Picture skin = shot.take(fromFront, whole), cap = shot.take(fromFront, opened);
        int last = 0;
        for (const float x : {-0.15f, -0.07f, 0.02f, 0.09f, 0.15f}) {
            const Color inside = colorAt(cap, fromFront, {x, 0.04f, 0.03f}),
                        outside = colorAt(skin, fromFront, {x, 0.04f, 0.2f});
            for (const std::size_t c : {0u, 1u, 2u}) EXPECT_NEAR(inside[c], outside[c], 25) << x << ' ' << c;
            EXPECT_GT(brightness(inside), last + 8) << "from dark blue to light yellow, at " << x;
            last = brightness(inside);
        }
    }
}

TEST(Section, GivesAnOpenSheetNoInside) {
    Shot shot(sheet());
    for (const float azimuth : {0.0f, 3.1f}) {
        Camera camera = fromFront;
        camera.azimuth = azimuth;
        const float side = azimuth < 1 ? 1.0f : -1.0f;
        Layers layers{.section = Section{Vector3(0, 0, side), 0.1f}};
        camera.elevation = 0.5f;
        EXPECT_LT(differences(shot.take(camera, {}), shot.take(camera, layers)), 300u);
    }
}

TEST(Section, OpensBallsAndLeavesOfLinksAndEdgesWhatIsBehindIt) {
    Shot shot(blocks({0}));
    Layers layers = shown({"hidden", "particles"}, Section{Vector3::UnitZ(), 0});
    const Picture balls = shot.take(fromFront, layers);
    EXPECT_TRUE(isGreen(colorAt(balls, fromFront, {0, 0, 0})));
    addLayer("strain", layers);
    shot.take(fromFront, layers);
    Camera camera = fromFront; // a line along the view has no length on screen
    camera.azimuth = 0.5f;
    camera.elevation = 0.4f;
    layers = shown({"hidden", "links"}, Section{Vector3::UnitZ(), -0.3f});
    Layers nothing = shown({"hidden"});
    EXPECT_EQ(differences(shot.take(camera, layers), shot.take(camera, nothing)), 0u)
        << "all links are before the plane";
    layers = shown({"glass", "wires"}, Section{Vector3::UnitZ(), -0.3f});
    EXPECT_EQ(differences(shot.take(camera, layers), shot.take(camera, nothing)), 0u);
}

TEST(Section, IsNotThereWhereItIsOff) {
    Shot shot(blocks({0}));
    const Picture before = shot.take(fromFront, {});
    shot.take(fromFront, {.section = Section{}});
    EXPECT_EQ(differences(before, shot.take(fromFront, {})), 0u);
}

TEST(Section, HandsReachWhatItHasLaidOpenAndNothingBefore) {
    Picked picked(blocks({0, -0.6f}));
    const Ray ray{{0.03f, 0.02f, 3}, -Vector3::UnitZ()};
    const auto at = [&](const Section& section) { return picked.at(ray, Among::moving, section); };
    const auto inside = at({Vector3::UnitZ(), 0.02f});
    ASSERT_TRUE(inside);
    EXPECT_NEAR(inside->point.z(), 0.02f, 1e-5f) << "on the plane";
    EXPECT_LT(inside->offset.norm(), 0.09f) << "a particle within the body";
    const auto behind = at({Vector3::UnitZ(), -0.3f});
    ASSERT_TRUE(behind);
    EXPECT_NEAR(behind->point.z(), -0.4f, 1e-5f) << "the front of the one behind";
    EXPECT_FALSE(at({Vector3::UnitZ(), -1}));
    const auto fromBehind = at({-Vector3::UnitZ(), 0.3f}); // the eye is on the side that is not cut away
    ASSERT_FALSE(fromBehind && fromBehind->point.z() < -0.3f);
}

} // namespace
} // namespace sinew::viewer
