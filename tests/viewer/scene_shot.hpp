// A small scene with its picture, and measures of pictures.
#pragma once

#include "viewer/document/document.hpp"
#include "viewer/render/offscreen.hpp"

#include "sinew/bodies.hpp"
#include "support/device.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace sinew::viewer {

constexpr VkExtent2D extent{320, 200};
constexpr float aspect = 1.6f;
constexpr Quality quick{.shadowSize = 512, .floorSize = 256, .shadowTaps = 16, .skyTaps = 24};

inline sim::Scene block(float height, bool hasGround) {
    sim::Scene scene;
    const sim::Lattice lattice{.origin = {-0.2f, height, -0.2f}, .cells = {4, 4, 4}, .spacing = 0.1f};
    const sim::LatticeCorners corners = sim::addLattice(scene, lattice);
    sim::addLatticeSkin(scene, lattice, corners, {0.70f, 0.12f, 0.10f});
    if (hasGround) scene.planes.push_back({});
    return scene;
}

// A scene whose picture is taken after some steps.
struct SceneShot {
    SceneShot(const sim::Scene& scene, Camera view, const Quality& quality = quick, float scale = 1)
        : camera(view), light(lightFor(scene, view)), document(test::device(), scene, {}),
          offscreen(test::device(), extent, light, quality, scale) {}

    Picture take(int steps = 0, const Overlay& overlay = {}) {
        VkCommandBuffer commands = test::queue().begin();
        if (document.steps() == 0) document.recordReset(commands);
        for (int i = 0; i < steps; ++i) document.recordStep(commands);
        document.recordSkin(commands);
        offscreen.record(commands, camera, document.simulation(), overlay);
        test::queue().wait(test::queue().submit(commands));
        return offscreen.read();
    }

    Camera camera;
    SceneLight light;
    Document document;
    Offscreen offscreen;
};

inline Camera viewOf(const sim::Scene& scene) {
    Camera camera;
    camera.elevation = 0.5f;
    return framing(camera, sceneBounds(scene), aspect);
}

using Color = std::array<int, 3>;

// The color of the pixel that shows a place.
inline Color colorAt(const Picture& picture, const Camera& camera, const Vector3& place) {
    const Eigen::Vector4f clip = clipMatrix(camera, aspect, 100) * place.homogeneous();
    const auto pixel = [](float ndc, std::uint32_t size) {
        return static_cast<std::uint32_t>(std::lround((0.5f * ndc + 0.5f) * static_cast<float>(size) - 0.5f));
    };
    const std::uint32_t x = pixel(clip.x() / clip.w(), picture.width),
                        y = pixel(clip.y() / clip.w(), picture.height);
    const std::uint8_t* at = &picture.pixels.at(4 * (std::size_t{y} * picture.width + x));
    return {at[0], at[1], at[2]};
}

inline int brightness(const Color& color) {
    return color[0] + color[1] + color[2];
}

inline int redness(const Color& color) {
    return color[0] - std::max(color[1], color[2]);
}

inline int largestDifference(const Picture& a, const Picture& b) {
    EXPECT_EQ(a.pixels.size(), b.pixels.size());
    int largest = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i)
        largest = std::max(largest, std::abs(int{a.pixels[i]} - int{b.pixels[i]}));
    return largest;
}

} // namespace sinew::viewer
