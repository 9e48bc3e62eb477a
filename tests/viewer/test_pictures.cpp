// Tests of pictures of small scenes, drawn under core, synchronisation and queue-submit validation
// (support/device.hpp turns every message into a failure).
#include "scene_shot.hpp"
#include "viewer/input/state_probe.hpp"
#include "viewer/render/collider_meshes.hpp"

#include "sinew/colliders.hpp"

#include <gtest/gtest.h>

namespace sinew::viewer {
namespace {

TEST(Picture, ShowsTheBodyInItsColorInFrontOfAQuietBackground) {
    const sim::Scene scene = block(0, true);
    SceneShot shot(scene, viewOf(scene));
    const Picture picture = shot.take();
    EXPECT_GT(redness(colorAt(picture, shot.camera, {0, 0.4f, 0})), 60) << "top of the block";
    EXPECT_GT(redness(colorAt(picture, shot.camera, {0, 0.2f, 0.2f})), 40) << "its front";
    const Color corner{picture.pixels[0], picture.pixels[1], picture.pixels[2]};
    EXPECT_LT(std::abs(redness(corner)), 25) << "sky and ground are nearly grey";
    EXPECT_GT(brightness(corner), 300) << "and bright";
}

TEST(Picture, ShowsABodyWithoutASkinAsLitBallsThatCastShadows) {
    const auto ballAt = [](float height) {
        sim::Scene scene;
        sim::addParticles(
            scene,
            {.center = {0, height, 0}, .count = {1, 1, 1}, .radius = 0.3f, .color = {0.70f, 0.12f, 0.10f}});
        scene.planes.push_back({});
        return scene;
    };
    const sim::Scene scene = ballAt(0.3f);
    Camera camera = viewOf(scene);
    camera.distance *= 2;
    SceneShot shot(scene, camera);
    const Picture picture = shot.take();
    EXPECT_GT(redness(colorAt(picture, camera, {0, 0.6f, 0})), 40) << "its top";
    const Vector3 toLight = 0.3f * shot.light.toLight + Vector3(0, 0.3f, 0),
                  away(-toLight.x(), 0.3f, -toLight.z());
    EXPECT_GT(brightness(colorAt(picture, camera, toLight)), brightness(colorAt(picture, camera, away)));
    EXPECT_LT(redness(colorAt(picture, camera, {0.45f, 0.1f, 0})), 25) << "beside it";
    const Vector3 level = Vector3(shot.light.toLight.x(), 0, shot.light.toLight.z()).normalized();
    EXPECT_LT(brightness(colorAt(picture, camera, -0.35f * level)),
              0.75f * static_cast<float>(brightness(colorAt(picture, camera, 1.2f * level))));
    const sim::Scene high = ballAt(1.3f);
    SceneShot falling(high, viewOf(high));
    const Vector3 start(0, 1.4f, 0);
    EXPECT_GT(redness(colorAt(falling.take(), falling.camera, start)), 40);
    for (int i = 0; i < 6; ++i) falling.take(4);
    EXPECT_LT(redness(colorAt(falling.take(), falling.camera, start)), 25) << "drawn where the particle is";
}

TEST(Picture, ShowsWallsBehindWhatTheyContainAndOnlyEdgesInFrontOfIt) {
    const sim::Scene open = block(0, true);
    sim::Scene boxed = open;
    for (const sim::Vec3& normal :
         {sim::Vec3{1, 0, 0}, sim::Vec3{-1, 0, 0}, sim::Vec3{0, 0, 1}, sim::Vec3{0, 0, -1}})
        boxed.planes.push_back({.normal = normal, .offset = -0.5f});
    Camera camera = viewOf(open);
    camera.azimuth = 0; // looks against z
    camera.distance *= 1.6f;
    SceneShot free(open, camera), inside(boxed, camera);
    const Picture without = free.take(), with = inside.take();
    const auto change = [&](const Vector3& at) {
        const Color a = colorAt(with, camera, at), b = colorAt(without, camera, at);
        return std::abs(a[0] - b[0]) + std::abs(a[1] - b[1]) + std::abs(a[2] - b[2]);
    };
    EXPECT_LT(change({0, 0.2f, 0.2f}), 6) << "the front of the block, through the wall before it";
    EXPECT_LT(change({0.3f, 0, 0.4f}), 6) << "the ground before it";
    EXPECT_GT(change({-0.35f, 0.05f, -0.5f}), 15) << "the wall behind it";
    float most = 0; // along a line across the upper edge of the wall in front
    for (float y = 0.1f; y < 0.6f; y += 0.002f)
        most = std::max(most, static_cast<float>(change({0.3f, y, 0.5f})));
    EXPECT_GT(most, 60) << "an edge";
}

TEST(Picture, OfABodyOnTheGroundIsNotBlackBelow) {
    sim::Scene scene = block(0, true);
    scene.colliders = {{.radius = 0.3f, .pose = {{0, 0.3f, 0}}, .color = {0.5f, 0.5f, 0.5f}}};
    for (sim::Particle& particle : scene.particles) particle.position.x += 3;
    Camera camera;
    camera.target = {0, 0.3f, 0};
    camera.distance = 1.6f;
    camera.elevation = 0;
    SceneShot shot(scene, camera);
    const float behind = std::atan2(-shot.light.toLight.x(), -shot.light.toLight.z());
    shot.camera.azimuth = behind; // looks towards the lamp
    const Vector3 out = Vector3(0.8f * std::sin(behind), -0.6f, 0.8f * std::cos(behind));
    const int below = brightness(colorAt(shot.take(), shot.camera, Vector3(0, 0.3f, 0) + 0.3f * out));
    EXPECT_GT(below, 175);
    EXPECT_LT(below, 330) << "but it is shaded";
}

TEST(Picture, IsDarkerOnTheGroundBesideTheBodyThanFarFromIt) {
    const sim::Scene scene = block(0, true);
    Camera camera = viewOf(scene);
    camera.distance *= 2;
    SceneShot shot(scene, camera);
    const Picture picture = shot.take();
    const Vector3 away = Vector3(-shot.light.toLight.x(), 0, -shot.light.toLight.z()).normalized();
    const Color shadow = colorAt(picture, camera, 0.36f * away);
    const Color open = colorAt(picture, camera, -0.8f * away);
    EXPECT_LT(brightness(shadow), 0.75f * static_cast<float>(brightness(open)));
}

TEST(Picture, DarkensTheGroundUnderABodyThatComesNear) {
    // View past the lower edge of a block in the air.
    const auto under = [](float height) {
        const sim::Scene scene = block(height, true);
        Camera camera;
        camera.elevation = 0.3f;
        camera.distance = 3;
        SceneShot shot(scene, camera);
        return brightness(colorAt(shot.take(), camera, {0, 0, 0}));
    };
    EXPECT_LT(under(0.12f) + 30, under(1.0f));
}

TEST(Picture, WithoutAPlaneHasNoGround) {
    const sim::Scene scene = block(0, false);
    SceneShot shot(scene, viewOf(scene));
    const Picture picture = shot.take();
    const Vector3 away = Vector3(-shot.light.toLight.x(), 0, -shot.light.toLight.z()).normalized();
    const int beside = brightness(colorAt(picture, shot.camera, 0.36f * away));
    const int opposite = brightness(colorAt(picture, shot.camera, -0.36f * away));
    EXPECT_LT(std::abs(beside - opposite), 40) << "no shadow falls on the backdrop";
    EXPECT_GT(redness(colorAt(picture, shot.camera, {0, 0.4f, 0})), 60);
}

TEST(Picture, FollowsTheSimulation) {
    const sim::Scene scene = block(0.5f, true);
    SceneShot shot(scene, viewOf(scene));
    const Vector3 start(0, 0.9f, 0.1f), landed(0, 0.1f, 0.2f);
    const Picture before = shot.take();
    EXPECT_GT(redness(colorAt(before, shot.camera, start)), 40);
    EXPECT_LT(redness(colorAt(before, shot.camera, landed)), 25);
    for (int i = 0; i < 5; ++i) shot.take(4);
    const Picture after = shot.take(); // it has just landed, 1/3 s later
    EXPECT_LT(redness(colorAt(after, shot.camera, start)), 25);
    EXPECT_GT(redness(colorAt(after, shot.camera, landed)), 40);
}

TEST(Picture, ShowsACollidersColorWhereItsPathHasLedIt) {
    sim::Scene scene = block(0, true);
    scene.skins[0].color = {0.5f, 0.5f, 0.5f};
    scene.colliders = {{.radius = 0.15f,
                        .path = {{0, {{-0.6f, 0.7f, 0}}}, {0.25f, {{0.6f, 0.7f, 0}}}},
                        .color = {0.8f, 0.05f, 0.05f}}};
    scene.gravity = {0, 0, 0};
    SceneShot shot(scene, viewOf(scene));
    const Vector3 left(-0.6f, 0.7f, 0.15f), right(0.6f, 0.7f, 0.15f);
    const Picture before = shot.take();
    EXPECT_GT(redness(colorAt(before, shot.camera, left)), 60);
    EXPECT_LT(redness(colorAt(before, shot.camera, right)), 25);
    const Picture after = shot.take(15);
    EXPECT_LT(redness(colorAt(after, shot.camera, left)), 25);
    EXPECT_GT(redness(colorAt(after, shot.camera, right)), 60);
}

// Every shape is closed, with vertices on the surface and outward normals.
TEST(ColliderMesh, IsTheSurfaceOfItsShape) {
    const std::array<sim::Collider, 3> colliders{
        sim::Collider{.shape = sim::ColliderShape::sphere, .radius = 0.5f},
        sim::Collider{.shape = sim::ColliderShape::capsule, .radius = 0.2f, .halfLength = 0.7f},
        sim::Collider{.shape = sim::ColliderShape::box, .halfExtents = {0.1f, 0.4f, 0.3f}}};
    const std::array<double, 3> volumes{4 * M_PI / 3 * 0.125, M_PI * 0.04 * (1.4 + 0.8 / 3), 0.8 * 0.12};
    for (std::size_t c = 0; c < 3; ++c) {
        const ColliderMesh mesh = meshOf(colliders[c]);
        for (const auto& vertex : mesh.vertices) {
            const sim::Vec3 x{vertex.position.x, vertex.position.y, vertex.position.z};
            EXPECT_NEAR(sim::gapTo(colliders[c], {}, x), 0, 1e-6);
            const sim::Vec3 out{x.x + 0.1f * vertex.normal.x, x.y + 0.1f * vertex.normal.y,
                                x.z + 0.1f * vertex.normal.z};
            EXPECT_NEAR(sim::gapTo(colliders[c], {}, out), 0.1, 1e-6);
        }
        double volume = 0;
        for (std::size_t t = 0; t < mesh.indices.size(); t += 3) {
            const auto at = [&](std::size_t corner) {
                const auto& p = mesh.vertices[mesh.indices[t + corner]].position;
                return Eigen::Vector3d(double{p.x}, double{p.y}, double{p.z});
            };
            volume += at(0).dot(at(1).cross(at(2))) / 6;
        }
        EXPECT_NEAR(volume / volumes[c], 1, 0.01) << "flat triangles cut off a little";
    }
}

TEST(Picture, IsTheSameTwice) {
    const sim::Scene scene = block(0.1f, true);
    SceneShot shot(scene, viewOf(scene));
    EXPECT_EQ(shot.take().pixels, shot.take().pixels);
}

TEST(Picture, HasSmoothEdgesWithFourSamples) {
    const sim::Scene scene = block(0.3f, true);
    Quality coarse = quick;
    coarse.samples = VK_SAMPLE_COUNT_1_BIT;
    SceneShot smooth(scene, viewOf(scene)), jagged(scene, viewOf(scene), coarse);
    const Picture a = smooth.take(), b = jagged.take();
    // Number of pixels between body and background colors: neither red nor grey.
    const auto between = [](const Picture& picture) {
        int count = 0;
        for (std::size_t i = 0; i < picture.pixels.size(); i += 4) {
            const int red = redness({picture.pixels[i], picture.pixels[i + 1], picture.pixels[i + 2]});
            count += red > 20 && red < 50;
        }
        return count;
    };
    EXPECT_GT(between(a), 2 * between(b) + 50);
}

// The camera rests, moves and rests again, with and without a floor.
TEST(Picture, IsTheSameWithABackdropThatIsKept) {
    for (const VkSampleCountFlagBits samples : {VK_SAMPLE_COUNT_1_BIT, VK_SAMPLE_COUNT_4_BIT})
        for (const bool hasGround : {true, false}) {
            const sim::Scene scene = block(0.3f, hasGround);
            Quality drawn = quick, kept = quick;
            drawn.samples = kept.samples = samples;
            kept.keepsBackdrop = true;
            SceneShot every(scene, viewOf(scene), drawn), once(scene, viewOf(scene), kept);
            std::vector<Picture> pictures;
            for (int picture = 0; picture < 8; ++picture) {
                if (picture == 4) every.camera = once.camera = orbited(every.camera, {0.1f, -0.05f});
                pictures.push_back(once.take(2));
                EXPECT_LE(largestDifference(every.take(2), pictures.back()), 2)
                    << samples << " samples, picture " << picture << (hasGround ? "" : " without a ground");
            }
            EXPECT_GT(largestDifference(pictures[3], pictures[2]), 20) << "the body stands still";
        }
}

double meanDifference(const Picture& a, const Picture& b) {
    EXPECT_EQ(a.pixels.size(), b.pixels.size());
    double sum = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) sum += std::abs(int{a.pixels[i]} - int{b.pixels[i]});
    return sum / static_cast<double>(a.pixels.size());
}

// With a kept backdrop, and with one that is not kept yet.
TEST(Picture, IsLikeItselfWhereItIsDrawnSmallerAndEnlarged) {
    const sim::Scene scene = block(0.3f, true);
    Quality quality = quick;
    quality.samples = VK_SAMPLE_COUNT_1_BIT;
    quality.keepsBackdrop = quality.mayEnlarge = true;
    SceneShot full(scene, viewOf(scene), quality), same(scene, viewOf(scene), quality, 0.99999f),
        half(scene, viewOf(scene), quality, 0.5f), tiny(scene, viewOf(scene), quality, 0.1f);
    for (int picture = 0; picture < 4; ++picture) {
        const Picture wanted = full.take(), small = half.take();
        EXPECT_EQ(small.width, extent.width);
        EXPECT_LE(largestDifference(wanted, same.take()), 1) << "as many pixels: none lies between two";
        const double blur = meanDifference(wanted, small);
        EXPECT_GT(blur, 0.1);
        EXPECT_LT(blur, 3);
        EXPECT_GT(meanDifference(wanted, tiny.take()), 1.5 * blur);
        const Color corner{small.pixels[0], small.pixels[1], small.pixels[2]};
        const Color inside{small.pixels[40], small.pixels[41], small.pixels[42]};
        EXPECT_NEAR(brightness(corner), brightness(inside), 12) << "nothing shines in from beyond";
        EXPECT_GT(redness(colorAt(small, half.camera, {0, 0.7f, 0})), 60) << "and it stands where it stood";
    }
}

TEST(Backdrop, IsMadeInTheSecondPictureFromAPlace) {
    const auto pass = RenderPass::colorMap(test::device(), VK_FORMAT_R8G8B8A8_SRGB, "test");
    Backdrop backdrop(test::device(), pass, VK_FORMAT_R8G8B8A8_SRGB, {16, 16}, std::array<VkImageView, 1>{});
    layout::FrameParams here{}, there{};
    there.eye.x = 1;
    using Use = Backdrop::Use;
    EXPECT_EQ(backdrop.next(here), Use::direct);
    EXPECT_EQ(backdrop.next(here), Use::made);
    EXPECT_EQ(backdrop.next(here), Use::kept);
    here.section.w = 3; // opens bodies only
    EXPECT_EQ(backdrop.next(here), Use::kept);
    EXPECT_EQ(backdrop.next(there), Use::direct);
    EXPECT_EQ(backdrop.next(here), Use::direct);
    EXPECT_EQ(backdrop.next(here), Use::made);
    EXPECT_EQ(backdrop.next(here), Use::kept);
}

// From outside, from inside, and with an inverted skin.
TEST(Picture, IsTheSameWithoutTheBacksThatNobodySees) {
    Quality less = quick;
    less.leavesBacks = true;
    const sim::Scene scene = block(0.3f, true);
    sim::Scene turned = scene;
    for (auto& triangle : turned.skins.front().triangles) std::swap(triangle[1], triangle[2]);
    Camera within = viewOf(scene);
    within.target = {0, 0.5f, 0};
    within.distance = 0.1f;
    for (const sim::Scene& shown : {scene, turned})
        for (const Camera& camera : {viewOf(scene), within}) {
            SceneShot all(shown, camera), some(shown, camera, less);
            EXPECT_EQ(largestDifference(all.take(2), some.take(2)), 0);
        }
}

// The shadow maps cover the volume of the scene at its start. A grab may lift a body partly or fully out of
// it.
TEST(Picture, HasTheShadowOfABodyThatWasLiftedTowardsTheLight) {
    Quality less = quick;
    less.leavesBacks = true;
    const sim::Scene opened = block(0.1f, true);
    const Camera camera = viewOf(opened);
    const auto lifted = [&](float height, const Quality& quality) {
        const sim::Scene scene = block(height, true);
        SceneShot shot(opened, camera, quality);
        Document document(test::device(), scene, {});
        const VkCommandBuffer commands = test::queue().begin();
        document.recordReset(commands);
        document.recordSkin(commands);
        shot.offscreen.record(commands, camera, document.simulation(), {});
        test::queue().wait(test::queue().submit(commands));
        return shot.offscreen.read();
    };
    const Picture high = lifted(100, less);
    std::size_t heights = 0;
    for (const float height : {0.3f, 0.5f, 0.6f, 0.7f, 0.8f}) {
        const Picture all = lifted(height, quick), some = lifted(height, less);
        EXPECT_LE(largestDifference(all, some), 16) << height; // bodies beyond the volume are flat in the map
        const auto isDarker = [&](std::size_t p) { return all.pixels[p] + 40 < high.pixels[p]; };
        std::size_t dark = 0;
        for (std::size_t p = 0; p < all.pixels.size(); p += 4) dark += isDarker(p) && isDarker(p + 1) ? 1 : 0;
        heights += dark > 100 ? 1 : 0;
    }
    EXPECT_EQ(heights, 5u) << "of 5 with a shadow, or a body in its own";
}

TEST(Picture, HasTheLightOfTheFloorEverySecondTimeWhereThatIsEnough) {
    Quality rarely = quick;
    rarely.floorEvery = 2;
    const sim::Scene scene = block(0.3f, true);
    SceneShot always(scene, viewOf(scene)), seldom(scene, viewOf(scene), rarely);
    for (int picture = 0; picture < 6; ++picture) {
        const int largest = largestDifference(always.take(2), seldom.take(2));
        if (picture % 2 == 0)
            EXPECT_EQ(largest, 0) << "picture " << picture;
        else
            EXPECT_GT(largest, 0) << "the block falls, picture " << picture;
    }
}

// An inverted skin is visible where no front face hides it.
TEST(Picture, ShowsBacksWhereNoFrontHidesThem) {
    sim::Scene scene = block(0.3f, true), turned = scene;
    for (auto& triangle : turned.skins.front().triangles) std::swap(triangle[1], triangle[2]);
    SceneShot plain(scene, viewOf(scene)), inverted(turned, viewOf(scene));
    const Vector3 top{0, 0.7f, 0};
    const Color shown = colorAt(inverted.take(), inverted.camera, top);
    EXPECT_GT(redness(shown), 60);
    EXPECT_NEAR(redness(shown), redness(colorAt(plain.take(), plain.camera, top)), 40);
}

TEST(Picture, LightsBothSidesOfCloth) {
    const auto seen = [](float side) {
        sim::Scene scene;
        sim::addCloth(
            scene,
            {.origin = {-0.5f, 0, -0.5f}, .size = {9, 9}, .spacing = 0.125f, .color = {0.7f, 0.1f, 0.1f}});
        Camera camera;
        camera.elevation = side;
        SceneShot shot(scene, camera);
        return colorAt(shot.take(), camera, {0, 0, 0});
    };
    EXPECT_GT(redness(seen(1.0f)), 40) << "from above";
    EXPECT_GT(redness(seen(-1.0f)), 20) << "from below";
}

TEST(Picture, ShowsAHemAndAPalerBackOfCloth) {
    sim::Scene scene;
    sim::addCloth(
        scene, {.origin = {-0.5f, 0, -0.5f}, .size = {9, 9}, .spacing = 0.125f, .color = {0.7f, 0.1f, 0.1f}});
    Camera above, below;
    above.elevation = 1.4f;
    below.elevation = -1.4f;
    above.distance = below.distance = 1.5f;
    SceneShot upper(scene, above), lower(scene, below);
    const Picture face = upper.take(), back = lower.take();
    EXPECT_GT(redness(colorAt(face, above, {0, 0, 0})), redness(colorAt(back, below, {0, 0, 0})) + 10);
    EXPECT_LT(brightness(colorAt(face, above, {0.488f, 0, 0})),
              brightness(colorAt(face, above, {0.44f, 0, 0})) - 5);
}

TEST(Picture, OfASceneWithoutSkinsIsAnEmptyStage) {
    sim::Scene scene;
    scene.particles.push_back({.position = {0, 1, 0}});
    scene.planes.push_back({});
    SceneShot shot(scene, viewOf(scene));
    EXPECT_LT(redness(colorAt(shot.take(), shot.camera, {0, 0.5f, 0})), 25);
}

TEST(StateProbe, FindsTheBodyWhereItIsNow) {
    const sim::Scene scene = block(0.5f, true);
    Document document(test::device(), scene, {});
    StateProbe probe(test::device(), document.scene(), document.settings(), document.simulation());
    VkCommandBuffer commands = test::queue().begin();
    document.recordReset(commands);
    for (int i = 0; i < 4; ++i) document.recordStep(commands);
    document.recordSkin(commands);
    probe.record(commands);
    test::queue().wait(test::queue().submit(commands));
    const float t = 4.0f / 60, fallen = 0.5f - 0.5f * 9.81f * t * t;
    EXPECT_NEAR(probe.bounds().min().y(), fallen, 2e-3f);
    EXPECT_NEAR(probe.bounds().sizes().y(), 0.4f, 1e-3f);
    EXPECT_EQ(probe.positions().size(), scene.particles.size());
    const auto vertices =
        test::queue().download<sim::layout::SkinVertex>(document.simulation().skinVertices());
    ASSERT_EQ(vertices.size(), scene.skins[0].vertexCount());
    float lowest = 1;
    for (const auto& vertex : vertices) lowest = std::min(lowest, vertex.position.y);
    EXPECT_NEAR(lowest, fallen, 2e-3f);
}

TEST(Picture, ShowsTheHandAndItsRope) {
    const sim::Scene scene = block(0, true);
    SceneShot shot(scene, viewOf(scene));
    const Picture without = shot.take();
    const Vector3 hand(0.35f, 0.5f, 0.2f);
    const sim::Vec3& at = scene.particles[124].position;
    const Picture with = shot.take(0, {Hand{.particle = 124, .offset = {0, 0, 0}, .target = hand}, {}});
    const Vector3 middle = 0.5f * (hand + Vector3(at.x, at.y, at.z));
    for (const Vector3& place : {hand, middle}) {
        const Color before = colorAt(without, shot.camera, place), now = colorAt(with, shot.camera, place);
        EXPECT_GT(now[0] - now[2], before[0] - before[2] + 40) << "orange";
    }
}

std::uint32_t sleepers(const Document& document) {
    return document.simulation().status(document.steps()).sleeping;
}

// A heap is drawn paler while all of it sleeps.
TEST(Picture, ShowsWhatSleepsPaler) {
    sim::Scene scene = block(0, true);
    sim::Settings settings{.substeps = 16, .sleeps = true};
    scene.damping = 20;
    const Camera camera = viewOf(scene);
    SceneLight light = lightFor(scene, camera);
    std::array<Color, 2> colors;
    for (const bool isShown : {false, true}) {
        light.showsSleep = isShown;
        Document document(test::device(), scene, settings);
        Offscreen offscreen(test::device(), extent, light, quick);
        for (int s = 0; s < 300 && (s == 0 || sleepers(document) == 0); ++s) {
            VkCommandBuffer commands = test::queue().begin();
            if (s == 0) document.recordReset(commands);
            document.recordStep(commands);
            document.recordSkin(commands);
            offscreen.record(commands, camera, document.simulation());
            test::queue().wait(test::queue().submit(commands));
        }
        EXPECT_EQ(sleepers(document), scene.particles.size());
        colors[isShown] = colorAt(offscreen.read(), camera, {0, 0.2f, 0.2f});
    }
    EXPECT_LT(redness(colors[1]), redness(colors[0]) - 30);
}

TEST(Document, NamesBodyParticleAndStepThatBroke) {
    sim::Scene scene = block(0.5f, false);
    const auto first = static_cast<std::uint32_t>(scene.particles.size());
    sim::addCloth(scene, {.name = "flag", .size = {2, 2}, .spacing = 0.1f});
    scene.distances.clear();
    scene.grids.clear();
    scene.particles[first + 2].position = scene.particles[first + 2].velocity = {3.3e38f, 0, 0};
    scene.dt = 0.1f; // overflows float in the first step
    Document document(test::device(), scene, {});
    VkCommandBuffer commands = test::queue().begin();
    document.recordReset(commands);
    for (int i = 0; i < 2; ++i) document.recordStep(commands);
    test::queue().wait(test::queue().submit(commands));
    const std::optional<Divergence> divergence = document.check(1);
    ASSERT_TRUE(divergence);
    EXPECT_EQ(divergence->firstParticle, first + 2);
    EXPECT_EQ(divergence->particles, 1u);
    EXPECT_EQ(divergence->sentence(), "The simulation became unstable (body \"flag\", step 1).");
    EXPECT_EQ(
        divergence->advice(),
        "The simulation became unstable (body \"flag\", step 1). The last good state is shown. Press R, "
        "then try more substeps or a softer material.");
    EXPECT_EQ(
        divergence->report(),
        "The simulation became unstable (body \"flag\", step 1). 1 particle is not finite, the first of them "
        "number " +
            std::to_string(first + 2) + ". Try more substeps or a softer material.");
}

} // namespace
} // namespace sinew::viewer
