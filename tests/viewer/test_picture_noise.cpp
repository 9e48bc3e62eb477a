// Tests that pictures of round bodies have neither noise nor shadow acne.
#include "scene_shot.hpp"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <vector>

namespace sinew::viewer {
namespace {

// How far the pixels of a round body differ from the mean of their four neighbours: noise and shadow acne
// show as such differences, even shading does not.
struct Roughness {
    double mean;
    int most; // that one pixel of a hundred exceeds
};
Roughness roughness(const Picture& picture, const Camera& camera, const Vector3& center, float radius) {
    const Eigen::Vector4f clip = clipMatrix(camera, aspect, 100) * center.homogeneous();
    const auto height = static_cast<float>(picture.height), width = static_cast<float>(picture.width);
    const Vector2 middle((0.5f * clip.x() / clip.w() + 0.5f) * width,
                         (0.5f * clip.y() / clip.w() + 0.5f) * height);
    const float reach = 0.9f * radius / pictureHeight(camera) * height;
    const auto at = [&](std::uint32_t x, std::uint32_t y) {
        const std::uint8_t* pixel = &picture.pixels.at(4 * (std::size_t{y} * picture.width + x));
        return pixel[0] + pixel[1] + pixel[2];
    };
    std::vector<int> all;
    double sum = 0;
    for (std::uint32_t y = 1; y + 1 < picture.height; ++y)
        for (std::uint32_t x = 1; x + 1 < picture.width; ++x) {
            if ((Vector2(static_cast<float>(x), static_cast<float>(y)) - middle).norm() > reach) continue;
            all.push_back(std::abs(4 * at(x, y) - at(x - 1, y) - at(x + 1, y) - at(x, y - 1) - at(x, y + 1)) /
                          4);
            sum += all.back();
        }
    std::ranges::sort(all);
    return {sum / static_cast<double>(all.size()), all[all.size() * 99 / 100]};
}

TEST(Picture, OfARoundBodyIsSmoothFromEverySide) {
    sim::Scene scene = block(0, true);
    const Vector3 center(0, 0.55f, 0);
    scene.gravity = {0, 0, 0};
    scene.colliders = {{.radius = 0.3f, .pose = {{0, 0.55f, 0}}, .color = {0.5f, 0.45f, 0.42f}}};
    for (sim::Particle& particle : scene.particles) particle.position.x += 3;
    Camera camera;
    camera.target = center;
    camera.distance = 1.2f;
    SceneShot shot(scene, camera, reducedQuality());
    for (const float azimuth : {0.6f, 1.6f, 2.8f, 4.0f, 5.2f})
        for (const float elevation : {-0.35f, 0.1f, 0.6f, 1.2f}) {
            shot.camera.azimuth = azimuth;
            shot.camera.elevation = elevation;
            const Picture picture = shot.take();
            const Roughness rough = roughness(picture, shot.camera, center, 0.3f);
            EXPECT_LT(rough.mean, 1.5) << "from " << azimuth << ", " << elevation;
            EXPECT_LE(rough.most, 6) << "from " << azimuth << ", " << elevation;
        }
}

// Regression test. The few taps of moving pictures missed small blockers in many pixels:
// the shadow of a lobe on a roll had bright specks.
TEST(Picture, HasNoSpecksInTheShadowOfASmallBody) {
    sim::Scene scene;
    const sim::Lattice lattice{.origin = {-0.05f, 0.04f, -0.05f}, .cells = {1, 1, 1}, .spacing = 0.1f};
    const sim::LatticeCorners corners = sim::addLattice(scene, lattice);
    sim::addLatticeSkin(scene, lattice, corners, {0.70f, 0.12f, 0.10f});
    scene.colliders = {{.shape = sim::ColliderShape::box,
                        .halfExtents = {1, 0.1f, 1},
                        .pose = {{0, -0.1f, 0}},
                        .color = {0.45f, 0.45f, 0.48f}}};
    SceneShot shot(scene, lookingFrom({0.1f, 0.6f, 0.5f}, {0, 0, 0}, 40), reducedQuality());
    const Picture picture = shot.take();
    const auto at = [&](std::uint32_t x, std::uint32_t y) {
        const std::uint8_t* pixel = &picture.pixels[4 * (std::size_t{y} * picture.width + x)];
        return Color{pixel[0], pixel[1], pixel[2]};
    };
    int specks = 0, shadowed = 0;
    for (std::uint32_t y = 1; y + 1 < picture.height; ++y)
        for (std::uint32_t x = 1; x + 1 < picture.width; ++x) {
            const std::array around{at(x - 1, y), at(x + 1, y), at(x, y - 1), at(x, y + 1)};
            if (std::ranges::any_of(around, [](const Color& one) { return redness(one) > 20; })) continue;
            int brightest = 0;
            for (const Color& one : around) brightest = std::max(brightest, brightness(one));
            shadowed += brightest < 300;
            specks += brightest < 300 && brightness(at(x, y)) > brightest + 60;
        }
    EXPECT_GT(shadowed, 300);
    EXPECT_EQ(specks, 0);
}

// Regression test. Where some pixels met a blocker beside them and their neighbours met none, the crease
// between two round parts of a body was speckled.
TEST(Picture, HasNoSpecksInTheCreaseBetweenRoundParts) {
    for (const Quality& quality : {reducedQuality(), Quality{.shadowSize = 2048, .floorSize = 256}}) {
        int specks = 0, seen = 0;
        for (const float turn : {-2.0f, -1.0f, 0.0f, 1.0f, 2.0f}) {
            sim::Scene scene = block(0, true);
            for (sim::Particle& particle : scene.particles) particle.position.x += 3;
            const sim::Vec3 lobe{0.29f * std::sin(turn), 0.50f, 0.29f * std::cos(turn)};
            scene.colliders = {{.radius = 0.3f, .pose = {{0, 0.55f, 0}}, .color = {0.62f, 0.16f, 0.14f}},
                               {.radius = 0.08f, .pose = {lobe}, .color = {0.62f, 0.16f, 0.14f}}};
            SceneShot shot(
                scene, lookingFrom({1.4f * std::sin(turn), 0.8f, 1.4f * std::cos(turn)}, {0, 0.55f, 0}, 30),
                quality);
            const Picture picture = shot.take();
            const auto at = [&](std::uint32_t x, std::uint32_t y) {
                const std::uint8_t* pixel = &picture.pixels[4 * (std::size_t{y} * picture.width + x)];
                return Color{pixel[0], pixel[1], pixel[2]};
            };
            for (std::uint32_t y = 1; y + 1 < picture.height; ++y)
                for (std::uint32_t x = 1; x + 1 < picture.width; ++x) {
                    const std::array around{at(x - 1, y), at(x + 1, y), at(x, y - 1), at(x, y + 1)};
                    if (std::ranges::any_of(around, [](const Color& one) { return redness(one) <= 20; }))
                        continue;
                    const int here = brightness(at(x, y));
                    ++seen;
                    specks += std::ranges::all_of(
                        around, [&](const Color& one) { return brightness(one) > here + 10; });
                }
        }
        EXPECT_GT(seen, 10000);
        EXPECT_EQ(specks, 0) << quality.shadowTaps << " taps";
    }
}

} // namespace
} // namespace sinew::viewer
